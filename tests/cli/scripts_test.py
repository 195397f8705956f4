"""./run and ./test on machines made up of stand-ins for dpkg-query, apt-get, cmake, ninja and ctest."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# Utilities of every Unix system that the scripts use; nothing else of the real machine is in their PATH.
UTILITIES = ["awk", "bash", "cat", "cksum", "dirname", "env", "flock", "grep", "mkdir", "mktemp", "readlink", "rm", "tee", "tr"]

STAND_INS = {
    "id": "echo 0",
    # Has every package installed but the one in the file `missing`.
    "dpkg-query": 'for name in "${@:3}"; do [ "$name" = "$(cat "$MACHINE/missing")" ] || echo "installed $name"; done',
    "apt-get": ': > "$MACHINE/missing"',
    "cmake": 'mkdir -p build/release build/asan; : > build/release/build.ninja; : > build/asan/build.ninja',
    "ninja": 'cat "$MACHINE/ninja-says"; exit $(cat "$MACHINE/ninja-code")',
    "glad": "",
    "cpack": 'mkdir -p "${@: -1}"; : > "${@: -1}/tessera_1.deb"; exit $(cat "$MACHINE/cpack-code")',
    "ctest": 'case " $* " in *" -N "*) echo "  Test #7: Slow.thing" ;; *) echo "100% tests passed"; exit $(cat "$MACHINE/ctest-code") ;; esac',
}


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.machine = pathlib.Path(folder.name)
        self.root = self.machine / "tessera"
        self.root.mkdir()
        for name in ("run", "test"):
            shutil.copy(REPOSITORY / name, self.root)
        shutil.copytree(REPOSITORY / "tools", self.root / "tools")
        (self.machine / "bin").mkdir()
        for name in UTILITIES:
            (self.machine / "bin" / name).symlink_to(shutil.which(name))
        for name, text in STAND_INS.items():
            self.script(self.machine / "bin" / name, f'echo "{name} $*" >> "$MACHINE/log"\n{text}')
        self.script(self.root / "build/release/apps/tessera", 'echo "$PWD: tessera $*"')
        self.write("missing", "")
        self.ninja("ninja: Entering directory\nninja: no work to do.\n", 0)
        self.write("log", "")
        self.write("ctest-code", "0")
        self.write("cpack-code", "0")

    def write(self, name, text):
        (self.machine / name).write_text(text)

    def ninja(self, says, code):
        self.write("ninja-says", says)
        self.write("ninja-code", str(code))

    def script(self, path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!{shutil.which('bash')}\n{text}\n")
        path.chmod(0o755)

    def run_(self, *command):
        """Runs a script of the repository from another folder; what it called is in self.calls."""
        self.write("log", "")
        result = subprocess.run([self.root / command[0], *command[1:]], cwd=self.machine, text=True, capture_output=True,
                                env={"PATH": str(self.machine / "bin"), "MACHINE": str(self.machine)}, timeout=60)
        self.calls = (self.machine / "log").read_text().splitlines()
        return result

    def called(self, program):
        return [call for call in self.calls if call.startswith(program + " ")]

    def testExactlyTheMissingPackagesAreInstalled(self):
        self.write("missing", "libfmt-dev")
        result = self.run_("run", "scenes")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([call.split("--yes ")[1] for call in self.called("apt-get")], ["libfmt-dev"])
        self.assertIn("Installing Debian packages: libfmt-dev", result.stderr)

    def testTheSecondRunNeedsNoAnswerAndPrintsOnlyTheOutputOfTheProgram(self):
        self.run_("run", "scenes")
        self.ninja("ninja: Entering directory\n[0/1] Re-checking globbed directories...\n"
                   "[1/1] cd apps && cmake -P cmake/write_commit.cmake\n", 0)
        result = self.run_("run", "render", "a b.gltf")
        self.assertEqual(result.stderr, "")
        self.assertEqual(result.stdout, f"{self.machine}: tessera render a b.gltf\n")
        self.assertEqual([call.split()[0] for call in self.calls], ["ninja"])

    def testRunAloneIsAlwaysTheDemonstration(self):
        self.assertEqual(self.run_("run").stdout, f"{self.machine}: tessera demo -o {self.root}/out\n")

    def testPackagesAreAlwaysMadeAnewFromAFinishedBuildAndNamed(self):
        self.script(self.root / "build/packages/old_0.deb", "")
        self.write("missing", "dpkg-dev")
        result = self.run_("run", "package")
        self.assertEqual((result.returncode, result.stdout), (0, f"{self.root}/build/packages/tessera_1.deb\n"))
        self.assertEqual([call.split("--yes ")[1] for call in self.called("apt-get")], ["dpkg-dev"])
        (build,) = self.called("ninja")
        self.assertTrue(build.endswith(" tessera_program tessera_texts"), build)
        self.assertEqual(self.called("cpack"), [f"cpack --config {self.root}/build/release/CPackConfig.cmake "
                                                f"-B {self.root}/build/packages"])
        self.write("cpack-code", "1")
        result = self.run_("run", "package")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.ninja("FAILED: A.o\n", 1)
        self.assertEqual((self.run_("run", "package").returncode, self.called("cpack")), (1, []))

    def testThePythonModuleIsBuiltByItselfAndItsPackagesAreOnlyInstalledForIt(self):
        self.write("missing", "pybind11-dev")
        self.run_("run", "scenes")
        self.assertEqual(self.called("apt-get"), [])
        result = self.run_("run", "python")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([call.split("--yes ")[1] for call in self.called("apt-get")], ["pybind11-dev"])
        self.assertIn("cmake --preset python", self.calls)
        self.assertTrue(self.called("ninja")[0].endswith("build/python tessera_python"), self.calls)
        self.assertIn(f"export PYTHONPATH={self.root}/build/python\n", result.stdout)

    def testTheTestsOfThePythonModuleAreRunWithItAndOtherwiseWithoutIt(self):
        self.script(self.machine / "bin" / "ctest", 'echo "ctest $* of $TESSERA_PYTHON_MODULE" >> "$MACHINE/log"')
        self.run_("test")
        self.assertEqual([call.endswith(" of ") for call in self.called("ctest")], [True, True])
        self.assertEqual(len(self.called("ninja")), 1)
        for option in ("--python", "--all"):
            self.run_("test", option)
            self.assertTrue(self.called("ctest")[0].endswith(f" of {self.root}/build/python"), self.calls)
            self.assertIn("tessera_python", self.called("ninja")[1])

    def testWithoutAptTheTestsOfThePythonModuleAreOnlyRunOnRequest(self):
        (self.machine / "bin/apt-get").unlink()
        self.script(self.machine / "bin" / "ctest", 'echo "ctest $* of $TESSERA_PYTHON_MODULE" >> "$MACHINE/log"')
        result = self.run_("test", "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("without --python", result.stderr)
        self.assertTrue(self.called("ctest")[0].endswith(" of "), self.calls)
        self.assertEqual(self.run_("test", "--all", "--python").stderr.count("--python"), 0)
        self.assertTrue(self.called("ctest")[0].endswith(f" of {self.root}/build/python"), self.calls)

    def testWhatOnlyTheSlowTestsNeedIsOnlyInstalledForThem(self):
        for name in ("slurmctld", "slurmd", "slurm-client", "munge", "parallel", "python3-venv"):
            with self.subTest(name):
                shutil.rmtree(self.root / "build")
                self.write("missing", name)
                self.run_("test")
                self.assertEqual(self.called("apt-get"), [])
                self.run_("test", "--all")
                self.assertEqual([call.split("--yes ")[1] for call in self.called("apt-get")], [name])

    def testAChangedPackageTableIsAlwaysCheckedAgain(self):
        self.run_("run")
        with (self.root / "tools/packages.txt").open("a") as table:
            table.write("libnew-dev build - something new\n")
        self.write("missing", "libnew-dev")
        self.run_("run")
        self.assertEqual(len(self.called("apt-get")), 1)

    def testAFailedBuildAlwaysShowsWhatTheCompilerSaidAndNeverRuns(self):
        self.ninja("[1/2] Building A.o\nFAILED: A.o\nA.cpp:3:1: error: what\n", 1)
        result = self.run_("run", "scenes")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("A.cpp:3:1: error: what\n", result.stderr)
        self.assertNotIn("[1/2]", result.stderr)

    def testWithoutAptTheMessageAlwaysNamesWhatToInstall(self):
        for name in ("apt-get", "ninja"):
            (self.machine / "bin" / name).unlink()
        result = self.run_("run")
        self.assertEqual(result.returncode, 1)
        self.assertIn("(ninja)", result.stderr)
        self.assertIn("vcpkg.json", result.stderr)

    def testEverydayTestsNeverIncludeTheSlowOnesAndPassArgumentsOn(self):
        result = self.run_("test", "-R", "Graph")
        self.assertIn("100% tests passed", result.stdout)
        call = self.called("ctest")[0]
        self.assertTrue(call.endswith("-LE slow -R Graph"), call)
        self.assertIn("--no-tests=error", call)
        self.run_("test", "--all", "--asan")
        (call,) = self.called("ctest")
        self.assertNotIn("slow", call)
        self.assertIn(f"--test-dir {self.root}/build/asan", call)

    def testWhatTheEverydayTestsLeaveOutIsAlwaysListedAtTheirEnd(self):
        result = self.run_("test")
        self.assertTrue(result.stdout.endswith("(./test --all runs them):\n  Slow.thing\n"), result.stdout)
        self.assertNotIn("Left out", self.run_("test", "--all").stdout)
        self.write("ctest-code", "8")
        self.assertEqual(self.run_("test").returncode, 8)

    def testAPieceIsAlwaysEveryNthTestAndNothingElseIsTaken(self):
        self.run_("test", "--all", "--piece", "2/4")
        (call,) = self.called("ctest")
        self.assertTrue(call.endswith("-I 2,,4"), call)
        for wrong in ("5/4", "0/4", "half", ""):
            result = self.run_("test", "--piece", wrong)
            self.assertEqual((result.returncode, self.called("ctest")), (1, []))
            self.assertIn("I/N", result.stderr)

    def testAnotherDriverIsAlwaysInstalledSetAndHeldToWhatNeedsOpenGl(self):
        self.write("missing", "mesa-vulkan-drivers")
        self.script(self.machine / "bin/ctest", 'echo "ctest $* $MESA_LOADER_DRIVER_OVERRIDE" >> "$MACHINE/log"')
        self.assertEqual(self.run_("test", "--driver", "zink").returncode, 0)
        self.assertEqual([call.split("--yes ")[1] for call in self.called("apt-get")], ["mesa-vulkan-drivers"])
        self.assertTrue(self.called("ctest")[0].endswith("-LE slow -L gpu|image|cli zink"), self.calls)
        result = self.run_("test", "--driver", "nix")
        self.assertEqual((result.returncode, self.called("ctest")), (1, []))
        self.assertIn("zink", result.stderr)


if __name__ == "__main__":
    unittest.main()
