"""The Debian packages of a finished build: what they hold, what they depend on, and that a picture can be rendered from them.

    package_test.py CPACK CMAKE BUILD_DIR WORK_DIR

They are unpacked into empty folders below WORK_DIR, never installed.
"""

import json
import os
import pathlib
import re
import shutil
import sys
import unittest

from installed_files import REPOSITORY, checkDesktop, checkTexts, filesOf, run

CPACK, CMAKE, BUILD, WORK = sys.argv[1:3] + [pathlib.Path(word).resolve() for word in sys.argv[3:5]]
NAMES = ("tessera", "tessera-dev")
SKIPPED = 77


def packagesIn(field):
    """The names in a field such as Depends, without versions."""
    return [re.match(r"\S+", entry.strip()).group() for entry in field.split(",")]


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        (WORK / "made").mkdir(parents=True)
        run(CPACK, "--config", BUILD / "CPackConfig.cmake", "-B", WORK / "made")
        cls.files, cls.fields = {}, {}
        for name in NAMES:
            (cls.files[name],) = (WORK / "made").glob(name + "_*.deb")
            run("dpkg-deb", "--extract", cls.files[name], WORK / name)
            lines = run("dpkg-deb", "--field", cls.files[name]).splitlines()
            cls.fields[name] = dict(line.split(": ", 1) for line in lines if line and line[0] != " ")
        cls.usr = WORK / "tessera/usr"
        cls.environment = dict(os.environ, XDG_CACHE_HOME=str(WORK / "cache"), GALLIVM_PERF="nopt")

    def tessera(self, *words, **variables):
        """The unpacked program, in a folder of its own."""
        (WORK / "pictures").mkdir(exist_ok=True)
        return run(self.usr / "bin/tessera", *words, cwd=WORK / "pictures", env=dict(self.environment, **variables))

    def testTheyHoldWhatIsInstalledEachFileOnce(self):
        run(CMAKE, "--install", BUILD, "--prefix", WORK / "prefix")
        program, dev = (filesOf(WORK / name / "usr") for name in NAMES)
        licences = {f"share/doc/{name}/copyright" for name in NAMES}
        self.assertEqual(program & dev, set())
        self.assertEqual((program | dev) - licences, filesOf(WORK / "prefix"))
        self.assertLessEqual(licences, program | dev)
        for path in dev - licences:
            self.assertRegex(path, r"^include/tessera/|^lib/libtessera_\w+\.a$|^lib/cmake/tessera/")
        for path in program:
            self.assertNotRegex(path, r"^include/|\.a$|\.cmake$")
        for name in NAMES:
            self.assertEqual(filesOf(WORK / name), {"usr/" + path for path in filesOf(WORK / name / "usr")})
            self.assertEqual((WORK / name / f"usr/share/doc/{name}/copyright").read_text(), (REPOSITORY / "LICENSE").read_text())

    def testTheyDependOnTheLibrariesThatTheyAreLinkedWith(self):
        version = self.fields["tessera"]["Version"]
        self.assertEqual(self.tessera("--version").splitlines()[0], f"tessera {version}")
        needed = packagesIn(self.fields["tessera"]["Depends"])
        for start in ("libc6", "libembree3", "libopenimageio", "libegl1", "libglfw3"):
            self.assertTrue(any(name.startswith(start) for name in needed), f"{start} of {needed}")
        self.assertFalse([name for name in needed if name.endswith("-dev")])
        table = [line.split() for line in (REPOSITORY / "tools/packages.txt").read_text().splitlines() if line and line[0] != "#"]
        built = {fields[0] for fields in table if fields[1] == "build"}
        libraries = packagesIn(self.fields["tessera-dev"]["Depends"])
        self.assertTrue(self.fields["tessera-dev"]["Depends"].startswith(f"tessera (= {version}), "))
        self.assertLessEqual(set(libraries[1:]), built)
        required = re.findall(r"^find_dependency\((\w+)", (REPOSITORY / "cmake/tesseraConfig.cmake.in").read_text(), re.MULTILINE)
        for name in set(required) - {"Threads", "OpenGL", "OpenSSL"}:
            word = name.lower().replace("_", "-")[:6]
            self.assertTrue(any(word in library for library in libraries), f"{name} of {libraries}")
        self.assertLessEqual({"libegl-dev", "libopengl-dev", "libimgui-dev", "libssl-dev", "libstb-dev", "libtinygltf-dev", "libwebp-dev"},
                             set(libraries))
        self.assertIn("libgl1-mesa-dri", packagesIn(self.fields["tessera"]["Recommends"]))

    @unittest.skipUnless(shutil.which("apt-get"), "needs apt-get")
    def testDebianHasAllTheirDependencies(self):
        said = run("apt-get", "--simulate", "--no-install-recommends", "-o", "Debug::NoLocking=1", "install", *self.files.values())
        for name in NAMES:
            self.assertRegex(said, rf"(?m)^Inst {name} ")

    def testThePictureOfTheUnpackedProgramIsThatOfTheBuild(self):
        commit = re.search("(?m)^commit .*", run(BUILD / "apps/tessera", "--version")).group()
        self.assertIn(commit, self.tessera("--version").splitlines())
        size = ("--size", "64x36", "--technique", "deferred")
        self.tessera("render", "hall", "-o", "hall.exr", *size)
        self.tessera("render", "hall", "-o", "hall.png", *size)
        run(BUILD / "apps/tessera", "render", "hall", "-o", WORK / "pictures/built.exr", *size, env=self.environment)
        self.assertEqual((WORK / "pictures/hall.exr").read_bytes(), (WORK / "pictures/built.exr").read_bytes())
        self.assertTrue((WORK / "pictures/hall.png").read_bytes().startswith(b"\x89PNG"))
        # Reading the image needs the module, which must be the package's.
        said = self.tessera("compare", "hall", "--against", "hall.exr", "--json", "-", *size, LD_DEBUG="libs",
                            LD_DEBUG_OUTPUT=str(WORK / "loaded"))
        (pair,) = json.loads(said)["pairs"]
        self.assertTrue(pair["ok"])
        self.assertEqual(pair["bitEqual"], 1)
        self.assertGreater(pair["litShare"], 0.5)
        loaded = "".join(path.read_text(errors="replace") for path in WORK.glob("loaded.*"))
        modules = {os.path.normpath(path) for path in re.findall(r"calling init: (\S+tessera-openimageio\.so)", loaded)}
        self.assertEqual(modules, {str(self.usr / "lib/tessera/tessera-openimageio.so")})

    def testManualAndCompletionAreWhatTheProgramSays(self):
        checkTexts(self.usr, self.tessera)

    def testTheDesktopFindsTheProgramItsIconAndItsTypes(self):
        checkDesktop(self.usr)

    def testAnotherProjectFindsTheUnpackedLibrary(self):
        for name in NAMES:
            shutil.copytree(WORK / name, WORK / "both", dirs_exist_ok=True)
        run(CMAKE, "-S", REPOSITORY / "tests/cli/consumer", "-B", WORK / "consumer", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={WORK / 'both/usr'}")
        cache = (WORK / "consumer/CMakeCache.txt").read_text()
        self.assertIn(f"tessera_DIR:PATH={WORK / 'both/usr/lib/cmake/tessera'}\n", cache)


if __name__ == "__main__":
    for tool in ("dpkg-deb", "dpkg-shlibdeps", "file"):
        if not shutil.which(tool):
            print(f"skipped: there is no {tool} (tools/packages.txt, package)")
            sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
