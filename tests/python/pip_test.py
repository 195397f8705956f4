"""pip installs the module from the source tree into a virtual environment, by the commands of docs/python.md and without a
network, and it draws there by itself.

    pip_test.py PROGRAM

CMake's build folder is that of the module under test, so that nothing is left to compile; what pip writes besides goes to a
temporary folder. Exits with 77 (skipped) where that module is missing, or what Debian's python3-venv and python3-wheel bring.
"""

import importlib.util
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

from find_module import FOLDER, REPOSITORY, skip, tessera

# Build folders of setuptools, in the configuration format of distutils.
BUILD = """
[build]
build_base = {folder}/made
[build_ext]
build_temp = {build}
[egg_info]
egg_base = {folder}/made
"""

# Run by the environment's Python. Reading an image needs OpenImageIO, so its module must be installed too.
SCRIPT = """
import importlib.metadata, json, pathlib, tessera
picture = tessera.render("spheres", size=(48, 27), technique="deferred")
picture.save("picture.png")
picture.save("picture.exr")
(pair,) = tessera.compare("spheres", size=(48, 27), techniques=["deferred"], against="picture.exr")["pairs"]
loaded = {line.split(maxsplit=5)[5] for line in pathlib.Path("/proc/self/maps").read_text().splitlines() if "/tessera" in line}
print(json.dumps({"pair": pair, "loaded": [path for path in loaded if path.endswith(".so")], "file": tessera.__file__,
                  "versions": [tessera.__version__, importlib.metadata.version("tessera")]}))
"""


class Pip(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()
        (self.folder / "made").mkdir()
        # pip's build writes its own Python into the folder's CMake cache, which later builds would keep. The restored
        # cache is newer than the build files, so the next build configures again.
        cache = pathlib.Path(FOLDER) / "CMakeCache.txt"
        self.addCleanup(cache.write_text, cache.read_text())
        (self.folder / "python").symlink_to(REPOSITORY / "python")
        (self.folder / "build.cfg").write_text(BUILD.format(folder=self.folder, build=pathlib.Path(FOLDER).resolve()))

    def run_(self, *command, **variables):
        """Runs it with nothing that the machine says to pip or to Python; what it printed."""
        own = {name: value for name, value in os.environ.items() if not name.startswith(("PIP_", "PYTHON"))}
        result = subprocess.run([str(word) for word in command], cwd=self.folder, env={**own, **variables},
                                capture_output=True, text=True, timeout=1700)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def testTheDocumentedCommandsInstallAModuleThatDrawsByItself(self):
        page = (REPOSITORY / "docs/python.md").read_text()
        (commands,) = re.findall(r"```console\npython3( -m venv .*?)```", page, re.DOTALL)
        self.run_("sh", "-e", "-c", shlex.quote(sys.executable) + commands, PIP_NO_INDEX="1", PIP_CONFIG_FILE=os.devnull,
                  DIST_EXTRA_CONFIG=str(self.folder / "build.cfg"))
        said = json.loads(self.run_(self.folder / "env/bin/python", "-I", "-c", SCRIPT))
        (site,) = (self.folder / "env").glob("lib/python3*/site-packages")
        self.assertEqual(set(said["loaded"]), {said["file"], str(site / "tessera.modules/tessera-openimageio.so")})
        self.assertEqual(pathlib.Path(said["file"]).parent, site)
        self.assertEqual((site / "tessera.pyi").read_text(), (REPOSITORY / "python/tessera.pyi").read_text())
        self.assertEqual(said["versions"], [tessera.__version__] * 2)
        self.assertTrue(said["pair"]["ok"], said["pair"])
        built = tessera.render("spheres", size=(48, 27), technique="deferred")
        self.assertEqual((self.folder / "picture.png").read_bytes(), built.png())


if __name__ == "__main__":
    # From Python 3.12 on, a new environment contains no setuptools.
    needed = ["ensurepip", "wheel", *(["setuptools"] if sys.version_info >= (3, 12) else [])]
    missing = [name for name in needed if not importlib.util.find_spec(name)]
    if missing:
        skip(f"Python lacks {', '.join(missing)} (tools/packages.txt, python)")
    unittest.main(argv=sys.argv[:1])
