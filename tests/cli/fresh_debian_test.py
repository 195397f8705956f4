"""Installs the Debian packages of a finished build on a Debian that has nothing else, and renders there.

    fresh_debian_test.py CPACK BUILD_DIR WORK_DIR

mmdebstrap makes that Debian in a folder and takes it away again; it loads some hundred packages. Where that is not
possible, the test is skipped: nothing of it is the packages' fault.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

from installed_files import TEXTS, checkDesktop, checkTexts, filesOf

SKIPPED = 77
READY = "This Debian is ready."

# Run there as root. $1 and $2 are the packages, $3 the recommendations of the first. Checks that all files that dpkg
# lists exist after the installation, and none after the removal.
SCRIPT = """
set -e
export DEBIAN_FRONTEND=noninteractive GALLIVM_PERF=nopt
cd /root
apt-get --yes -qq --no-install-recommends install ./"$1" $3
mkdir out
dpkg --listfiles tessera > list
while read -r path; do [ -d "$path" ] || echo "$path"; done < list > files
tar --create --file out/installed.tar --files-from files
tessera --version > out/version
tessera render hall -o hall.exr --size 64x36 --technique deferred
tessera compare hall --against hall.exr --size 64x36 --technique deferred --json out/compare.json
TEXTS
apt-get --simulate --no-install-recommends install ./"$2" > out/simulated
apt-get --yes -qq remove tessera
while read -r path; do [ ! -e "$path" ] || { echo "left behind: $path"; exit 1; }; done < files
""".replace("TEXTS", "\n".join(f"tessera {' '.join(words)} > out/{'-'.join(words)}" for words in TEXTS))


def fail(text):
    print(text)
    sys.exit(1)


def skip(why):
    print("skipped: " + why)
    sys.exit(SKIPPED)


def run(*command):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL)


def checkFiles(package, out, work):
    """What was installed is what the package holds, and of use: `out` is the folder that SCRIPT filled."""
    for command in (("dpkg-deb", "--extract", package, work / "unpacked"),
                    ("tar", "--extract", "--one-top-level=" + str(work / "installed"), "--file", out / "installed.tar")):
        done = run(*command)
        if done.returncode != 0:
            fail(done.stdout)
    held, there = (filesOf(work / name) for name in ("unpacked", "installed"))
    if held != there:
        fail(f"held by the package and not installed, or the reverse: {sorted(held ^ there)}")
    for path in sorted(held):
        if (work / "unpacked" / path).read_bytes() != (work / "installed" / path).read_bytes():
            fail(f"/{path} is not that of the package")
    usr = work / "installed/usr"
    checkTexts(usr, lambda *words: (out / "-".join(words)).read_text())
    checkDesktop(usr)


def main():
    cpack, build, work = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
    for tool in ("mmdebstrap", "dpkg-shlibdeps", "file"):
        if not shutil.which(tool):
            skip(f"there is no {tool} (tools/packages.txt)")
    system = pathlib.Path("/etc/os-release")
    release = re.search("(?m)^VERSION_CODENAME=(\\w+)$", system.read_text() if system.exists() else "")
    if not release or not pathlib.Path("/etc/debian_version").exists():
        skip("packages are for the Debian that they were built on")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    made = run(cpack, "--config", build / "CPackConfig.cmake", "-B", work)
    if made.returncode != 0:
        fail(made.stdout)
    (program,), (dev,) = work.glob("tessera_*.deb"), work.glob("tessera-dev_*.deb")
    recommended = run("dpkg-deb", "--field", program, "Recommends").stdout.strip().replace(",", " ")
    (work / "script.sh").write_text(SCRIPT)
    out = work / "out"
    hooks = [f'echo "{READY}"', f"copy-in '{program}' '{dev}' '{work}/script.sh' /root",
             f'chroot "$1" sh /root/script.sh {program.name} {dev.name} "{recommended}"',
             f"copy-out /root/out '{work}'"]
    result = run("mmdebstrap", "--variant=apt", *[f"--customize-hook={hook}" for hook in hooks],
                 release.group(1), "/dev/null")
    if READY not in result.stdout:
        skip("no Debian can be made here:\n" + result.stdout[-2000:])
    if result.returncode != 0:
        fail(result.stdout[-8000:])
    checkFiles(program, out, work)
    version = (out / "version").read_text()
    if not re.search(r"(?m)^OpenGL     4\.", version):
        fail("no driver came with the package:\n" + version)
    (pair,) = json.loads((out / "compare.json").read_text())["pairs"]
    if not pair["ok"] or pair["litShare"] < 0.5:
        fail(f"the picture is not the one that was read back, or dark: {pair}")
    if not re.search(r"(?m)^Inst tessera-dev ", (out / "simulated").read_text()):
        fail("tessera-dev cannot be installed:\n" + (out / "simulated").read_text())


if __name__ == "__main__":
    main()
