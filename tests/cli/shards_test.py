"""tools/cluster/shards.py: what it would run, what it runs by GNU parallel and xargs, and what it refuses.

    shards_test.py PROGRAM
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TOOL = REPOSITORY / "tools/cluster/shards.py"
SCHEDULERS = ["xargs", *(["parallel"] if shutil.which("parallel") else [])]

# Logs its arguments. Writes a record with a separate case for a shard of stress, and a file for an image. Fails once
# for the shard or scene that `fails-once` names.
STAND_IN = '''#!/usr/bin/env python3
import json, os, pathlib, sys
words = sys.argv[1:]
pathlib.Path("calls").open("a").write(json.dumps(words) + "\\n")
def after(word):
    return words[words.index(word) + 1] if word in words else None
once = pathlib.Path("fails-once")
if once.exists() and once.read_text() in (after("--shard"), words[1]):
    once.unlink()
    sys.exit(1)
if after("--json"):
    number = int(after("--shard").split("/")[0])
    case = {"name": f"case{number}", "technique": None, "ok": number != 9, "missed": ["off"]}
    pathlib.Path(after("--json")).write_text(json.dumps({"schema": 1, "renderer": "A", "effort": "full", "ok": number != 9, "cases": [case]}))
elif words[0] == "render":
    pathlib.Path(after("-o").replace("%05d", after("--shard").replace("/", "_") if "--shard" in words else "")).write_text("x")
'''

# Stands in for ssh: runs its words in a shell elsewhere, without this environment, and logs the name of the machine.
SSH = """#!/bin/sh
while :; do case $1 in -*) shift ;; *) break ;; esac; done
echo "$1" >> {hosts}
shift
[ "$1" != -- ] || shift
cd / && exec env -i HOME=/ SHELL=/bin/sh PATH={path} /bin/sh -c "$*"
"""

DRY_SLURM = """\
# 2 of bench, the lines of {here}/out put/commands.txt
cd '{here}' && '{here}/stand in' bench 'a b.json' hall --frames 3 --shard 1/2 --resume -o '{here}/out put/shards/1-of-2'
cd '{here}' && '{here}/stand in' bench 'a b.json' hall --frames 3 --shard 2/2 --resume -o '{here}/out put/shards/2-of-2'
# scheduled by
sbatch --parsable --job-name=tessera-bench '--output={here}/out put/logs/shard-%a.log' --open-mode=append --requeue \
'--chdir={here}' --array=1-2%1 --exclusive --partition=gpu '{job}' '{here}/out put/commands.txt'
sbatch --parsable --job-name=tessera-bench '--output={here}/out put/logs/merge.log' --open-mode=append --requeue \
'--chdir={here}' --partition=gpu '--dependency=afterok:{{job}}' --kill-on-invalid-dep=yes '{job}' '{here}/out put/merge.txt'
# put together by, in {here}/out put/merge.txt
cd '{here}' && '{here}/stand in' bench -o '{here}/out put/merged' --merge '{here}/out put/shards/1-of-2' \
'{here}/out put/shards/2-of-2'
"""
DRY_PARALLEL = """\
# 2 of pictures, the lines of {here}/truth/commands.txt
cd '{here}' && {{ test -s '{here}/truth/hall.exr' || '{here}/stand in' render hall --technique reference -o \
'{here}/truth/hall.exr'; }}
cd '{here}' && {{ test -s '{here}/truth/my room.exr' || '{here}/stand in' render 'my room.json' --technique reference -o \
'{here}/truth/my room.exr'; }}
# scheduled by
parallel --will-cite --jobs 1 --sshloginfile=hosts.txt --arg-file '{here}/truth/commands.txt'
"""


class Shards(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="shards 'of' {} %a $x ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(os.path.realpath(folder.name))
        self.standIn = self.folder / "stand in"
        self.standIn.write_text(STAND_IN)
        self.standIn.chmod(0o755)

    def tool(self, *words, folder=None, **variables):
        return subprocess.run([sys.executable, "-B", TOOL, *map(str, words)], cwd=folder or self.folder, text=True,
                              capture_output=True, timeout=120, env={**os.environ, **variables})

    def runGood(self, *words):
        result = self.tool(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def refused(self, part, *words):
        result = self.tool(*words)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn(part, result.stderr)
        self.assertNotIn("Traceback", result.stderr)

    def calls(self):
        """How the stand-in was called since the last time, in any order."""
        file = self.folder / "calls"
        calls = sorted(json.loads(line) for line in file.read_text().splitlines()) if file.exists() else []
        file.unlink(missing_ok=True)
        return calls

    def testADryRunPrintsEveryCommandAndWritesNothing(self):
        with tempfile.TemporaryDirectory(prefix="dry run ") as name:
            here = pathlib.Path(os.path.realpath(name))
            shutil.copy(self.standIn, here)
            job = TOOL.with_name("job.sh")
            quoted = shlex.quote(str(job))
            for expected, words in ((DRY_SLURM, ["slurm", "-o", "out put", "--shards", "2", "--jobs", "1", "--with=--partition=gpu"]),
                                    (DRY_PARALLEL, ["parallel", "-o", "truth", "--with=--sshloginfile=hosts.txt"])):
                command = ["bench", "a b.json", "hall", "--frames", "3"] if words[0] == "slurm" else [
                    "render", "hall", "my room.json", "--technique", "reference"]
                result = self.tool(*words, "--program", "./stand in", "--dry-run", "--", *command, folder=here)
                self.assertEqual(result.stderr, "")
                self.assertEqual(result.stdout, expected.replace("'{job}'", quoted).format(here=here))
            self.assertEqual([entry.name for entry in here.iterdir()], ["stand in"])

    def testEveryShardRunsOnceWithItsWordsAsTheyAreAndIsPutTogether(self):
        for by in SCHEDULERS:
            words = [by, "-o", f"by {by}", "--shards", "3", "--jobs", "2", "--program", self.standIn, "--", "stress",
                     "--case", "a 'b' {} {#} $x \"c\" \\ *"]
            self.runGood(*words)
            out = self.folder / f"by {by}"
            self.assertEqual(self.calls(), [[*words[10:], "--shard", f"{i}/3", "--json", f"{out}/shards/{i}-of-3.json"]
                                            for i in (1, 2, 3)], by)
            record = json.loads((out / "stress.json").read_text())
            self.assertEqual([case["name"] for case in record["cases"]], ["case1", "case2", "case3"])
            self.assertEqual((record["ok"], record["renderer"]), (True, "A"))
            # Again: all results exist.
            self.runGood(*words)
            self.assertEqual(self.calls(), [])

    @unittest.skipUnless("parallel" in SCHEDULERS, "needs GNU parallel (tools/packages.txt, cluster)")
    def testTheDocumentedCommandRunsEveryShardOnceOnTheMachinesOfItsFile(self):
        page = (REPOSITORY / "docs/clusters.md").read_text()
        (command,) = re.findall(r"```console\n(tools/cluster/shards\.py parallel .*?)```", page, re.DOTALL)
        (self.folder / "bin").mkdir()
        shutil.copy(self.standIn, self.folder / "bin/tessera")
        hosts = self.folder / "hosts"
        ssh = self.folder / "bin/ssh"
        ssh.write_text(SSH.format(hosts=shlex.quote(str(hosts)),
                                  path=shlex.quote(f"{os.path.dirname(sys.executable)}:/usr/bin:/bin")))
        ssh.chmod(0o755)
        (self.folder / "hosts.txt").write_text("one\ntwo\n")
        (self.folder / "matrix.json").write_text(json.dumps(
            {"technique": ["forward"], "lights": [4, 8, 16, 32], "size": ["16x9", "32x18", "64x36", "128x72"]}))
        result = self.tool(*shlex.split(command.replace("\\\n", " "))[1:],
                           PATH=os.pathsep.join([str(self.folder / "bin"), os.environ["PATH"]]))
        self.assertEqual(result.returncode, 0, result.stderr)
        parts = [f"{self.folder}/results/shards/{i}-of-16" for i in range(1, 17)]
        self.assertEqual(self.calls(), sorted(
            [["bench", "hall", "--matrix", "matrix.json", "--shard", f"{i}/16", "--resume", "-o", part]
             for i, part in enumerate(parts, 1)] + [["bench", "-o", f"{self.folder}/results/merged", "--merge", *parts]]))
        self.assertEqual(set(hosts.read_text().split()), {"one", "two"})

    def testWhatFailedIsReportedAndTheNextRunDoesWhatIsMissing(self):
        for by in SCHEDULERS:
            words = [by, "-o", by, "--program", self.standIn, "--", "render", "hall", "room", "--technique", "reference"]
            (self.folder / "fails-once").write_text("room")
            self.refused("run this again", *words)
            self.assertEqual(len(self.calls()), 2)
            self.runGood(*words)
            self.assertEqual([call[1] for call in self.calls()], ["room"])
            self.assertTrue((self.folder / by / "hall.exr").exists())
            stress = [by, "-o", f"{by} stress", "--shards", "2", "--program", self.standIn, "--", "stress"]
            (self.folder / "fails-once").write_text("2/2")
            result = self.tool(*stress)
            self.assertEqual(result.returncode, 2)
            self.assertIn("2-of-2.json: No such file or directory; that shard is not finished", result.stderr)
            self.calls()
            self.runGood(*stress)
            self.assertEqual([call[2] for call in self.calls()], ["2/2"])

    def testAMissedToleranceIsTheExitCodeOfTheWhole(self):
        result = self.tool("xargs", "-o", "out", "--shards", "9", "--program", self.standIn, "--", "stress")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("missed: case9: off\n1 of 9 missed", result.stdout)

    def testResultsOfSeveralTechniquesStayTogetherAndRenderersAreReported(self):
        def record(renderer, *cases):
            return {"schema": 1, "renderer": renderer, "effort": "full", "ok": True,
                    "cases": [{"name": name, "technique": technique, "ok": True, "missed": []} for name, technique in cases]}

        files = {"1": record("A", ("a", "forward"), ("a", "deferred"), ("c", None)), "2": record("B", ("b", None)),
                 "3": {**record("A"), "effort": "quick"}}
        for name, content in files.items():
            (self.folder / name).write_text(json.dumps(content))
        self.runGood("join", "-o", "whole", "1", "2")
        whole = json.loads((self.folder / "whole").read_text())
        self.assertEqual([(case["name"], case["technique"], case["renderer"]) for case in whole["cases"]],
                         [("a", "forward", "A"), ("a", "deferred", "A"), ("b", None, "B"), ("c", None, "A")])
        self.assertEqual(whole["renderer"], "A; B")
        self.refused("different effort", "join", "-o", "whole", "1", "3")
        (self.folder / "half").write_text('{"schema": 1, "cas')
        self.refused("half: is no record of tessera stress", "join", "-o", "whole", "1", "half")

    def testWhatMakesNoSenseIsRefusedInOneLine(self):
        start = ["xargs", "-o", "out", "--program", self.standIn, "--shards", "2", "--"]
        self.refused("'compare' cannot be divided", *start, "compare", "hall")
        self.refused("'' cannot be divided", *start)
        for option in (["--shard", "1/2"], ["--resume"], ["-oelsewhere"], ["--output=elsewhere"]):
            self.refused("is given by this tool", *start, "bench", "hall", *option)
        self.refused("at least one", *start[:-1], "--jobs", "0", "--", "stress")
        self.refused("leave --shards out", *start, "render", "hall")
        self.refused("line break", *start, "bench", "a\nb")
        start[5:7] = []
        self.refused("say with --shards", *start, "bench", "hall")
        self.refused("two scenes are named hall", *start, "render", "hall", "mine/hall.json")
        self.refused("place {scene}", *start[:-1], "--name", "one.exr", "--", "render", "hall", "room")
        self.refused("name a scene", *start, "render", "--size", "64x36")
        self.refused("no such program", "xargs", "-o", "out", "--program", "./nix", "--", "render", "hall")
        self.assertFalse((self.folder / "out").exists())
        self.runGood(*start, "render", "hall")
        self.refused("holds other work", *start, "render", "room")

    def testABenchIsDividedIntoNoMoreShardsThanItHasGroups(self):
        (self.folder / "sizes.json").write_text('{"technique": ["forward"], "lights": [4, 8], "size": ["32x18", "64x36", "16x9"]}')
        (self.folder / "broken.json").write_text('{"lights": [4')

        def words(shards, *command):
            return ["xargs", "-o", "out", "--dry-run", "--program", self.standIn, "--shards", shards, "--", "bench", *command]

        for most, command in ((1, ["hall"]), (2, ["hall", "room", "--frames", "3"]), (6, ["hall", "--matrix", "sizes.json"]),
                              (12, ["hall", "room", "--matrix=sizes.json", "--tile", "8"])):
            self.runGood(*words(most, *command))
            self.refused(f"in one size): {most}; give fewer", *words(most + 1, *command))
        # It leaves to the program whatever it cannot check.
        for command in (["hall", "--matrix", "broken.json"], ["hall", "--matrix", "missing.json"], ["--frames", "3", "hall"],
                        ["hall", "--tile=8", "room"]):
            self.runGood(*words(9, *command))

    def testWithoutAMeansOfSchedulingTheOthersAreNamed(self):
        (self.folder / "bin").mkdir()
        (self.folder / "bin/xargs").symlink_to(shutil.which("xargs"))
        result = subprocess.run([sys.executable, "-B", TOOL, "slurm", "-o", "out", "--program", self.standIn, "--", "render", "hall"],
                                cwd=self.folder, text=True, capture_output=True, env={"PATH": str(self.folder / "bin")})
        self.assertEqual(result.returncode, 2)
        self.assertIn("Slurm (Debian: slurm-client) is not installed; here are: xargs", result.stderr)

    def testTheHelpTeachesByExamples(self):
        text = self.runGood("--help")
        for part in ("Slurm cluster", "--sshloginfile", "--dry-run", "  bench ", "  stress ", "  frames ", "  pictures "):
            self.assertIn(part, text)
        for by in ("slurm", "parallel", "xargs"):
            self.assertIn("--shards N", self.runGood(by, "--help"))

    def testTwoShardsOfTheProgramAreTheFramesAndTheBenchOfOneRun(self):
        for by in SCHEDULERS:
            frames = ["render", "lattice", "--frames", "3", "--size", "32x18", "--lights", "4"]
            self.runGood(by, "-o", f"{by} film", "--shards", "2", "--program", PROGRAM, "--", *frames)
            subprocess.run([PROGRAM, *frames, "-o", f"{by}_%05d.png"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
            for i in range(3):
                self.assertEqual((self.folder / f"{by} film/frame_{i:05}.png").read_bytes(),
                                 (self.folder / f"{by}_{i:05}.png").read_bytes())
            (self.folder / "matrix.json").write_text('{"technique": ["forward"], "lights": [2, 4]}')
            self.runGood(by, "-o", f"{by} bench", "--shards", "2", "--program", PROGRAM, "--", "bench", "lattice", "--frames",
                         "1", "--size", "32x18", "--matrix", "matrix.json")
            record = json.loads((self.folder / f"{by} bench/merged/bench.json").read_text())
            self.assertEqual((record["complete"], len(record["points"])), (True, 2))


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
