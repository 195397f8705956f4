"""tools/cluster/shards.py on a real Slurm of one node, started in a temporary folder: shards whose program or whose node
is killed are requeued and go on, and merged they are the points of one run.

    slurm_test.py PROGRAM

Slurm and MUNGE come from Debian's packages, which ./test --all installs; nothing of the machine's own configuration is
read or written. Ends with exit code 77 where they are missing.
"""

import json
import os
import pathlib
import pwd
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SHARDS = REPOSITORY / "tools/cluster/shards.py"
PROGRAMS = ["slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "sinfo", "munged", "mungekey"]
SKIPPED = 77
PATIENCE_SECONDS = 240  # for any action of Slurm

# Settings for the fastest reaction: Slurm notices a dead node after seconds, and credentials, whose lifetime a requeued
# job has to wait for, expire soon. The node has the declared number of processors.
CONFIGURATION = """
ClusterName=tessera
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controlPort}
SlurmdPort={nodePort}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=10
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SlurmdTimeout=10
MessageTimeout=5
KillWait=2
ReturnToService=2
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def freePort():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def parentOf(process):
    # The name, in brackets, may have spaces.
    return int(pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def nameOf(process):
    return pathlib.Path(f"/proc/{process}/comm").read_text().strip()


def descendantsOf(process):
    """Processes that it started, and they, from the nearest on."""
    children = {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                children.setdefault(parentOf(entry.name), []).append(int(entry.name))
            except OSError:  # it has ended
                pass
    found = [process]
    for one in found:
        found += children.get(one, [])
    return found[1:]


class Slurm:
    """A cluster of one node."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        user = pwd.getpwuid(os.getuid()).pw_name
        for name in ("state", "spool"):
            (folder / name).mkdir(mode=0o755)
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=user, controlPort=freePort(), nodePort=freePort(), folder=folder,
            processors=os.cpu_count()))
        self.environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))
        try:
            subprocess.run(["mungekey", "--create", f"--keyfile={folder}/munge.key"], check=True)
            self.start("munged", "--foreground", "--force", f"--key-file={folder}/munge.key",
                       f"--socket={folder}/munge.socket", f"--pid-file={folder}/munged.pid",
                       f"--seed-file={folder}/munge.seed", f"--log-file={folder}/munged.log")
            self.wait("MUNGE answers", (folder / "munge.socket").exists)
            self.start("slurmctld", "-D", "-c")
            self.startNode()
            self.wait("the node is idle", lambda: self.says("sinfo", "--noheader", "--format=%t").startswith("idle"))
        except BaseException:
            self.stop()
            raise

    def start(self, *words):
        with (self.folder / f"{words[0]}.out").open("a") as output:
            self.processes.append(subprocess.Popen(words, env=self.environment, stdout=output, stderr=output))
        return self.processes[-1]

    def startNode(self):
        self.node = self.start("slurmd", "-D")

    def says(self, *words):
        result = subprocess.run(words, env=self.environment, text=True, capture_output=True, timeout=60)
        return result.stdout.strip()

    def wait(self, what, holds):
        end = time.monotonic() + PATIENCE_SECONDS
        while not holds():
            if time.monotonic() > end:
                raise AssertionError(f"not within {PATIENCE_SECONDS} s: {what}\n{self.logs()}")
            time.sleep(0.1)

    def logs(self):
        files = [*self.folder.glob("*.log"), *self.folder.glob("*.out"), *self.folder.glob("results/logs/*")]
        return "\n".join(f"--- {file}\n{file.read_text(errors='replace')[-4000:]}" for file in sorted(files))

    def endNodeAsByPowerFailure(self, process):
        """Kills the node's daemon, and the step that `process` belongs to with all that it started."""
        step = process
        while not nameOf(step).startswith("slurmstepd"):
            step = parentOf(step)
        self.node.kill()
        for one in [step, *descendantsOf(step)]:
            try:
                os.kill(one, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.node.wait()

    def stop(self):
        if self.processes:
            self.says("scancel", "--full", f"--user={pwd.getpwuid(os.getuid()).pw_name}")
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def pointsOf(file):
    """The points of a bench without what depends on time."""
    points = json.loads(file.read_text())["points"]
    for point in points:
        for field in ("cpuMs", "gpuMs", "floorMs", "ratioToFloor", "floorLitMs", "ratioToLitFloor", "pareto", "why"):
            point.pop(field)
        for one in point["passes"]:
            one.pop("gpuMs")
    return points


class Cluster(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tessera slurm ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        # Slurm's files need a path without spaces; the results' path may contain some.
        own = tempfile.TemporaryDirectory(prefix="tessera_slurm_")
        self.addCleanup(own.cleanup)
        self.slurm = Slurm(pathlib.Path(own.name))
        self.addCleanup(self.slurm.stop)

    def holderOf(self, shard):
        """The process that measures a shard and has kept a part of it."""
        folder = self.folder / "results/shards" / shard
        found = []

        def isBegun():
            lock = folder / "bench.lock"
            if not any((folder / "parts").glob("group-*.json")) or not lock.exists():
                return False
            found[:] = [int(one) for one in re.findall(r"process (\d+)", lock.read_text())]
            return bool(found)

        self.slurm.wait(f"shard {shard} is begun", isBegun)
        return found[0]

    def testAKilledProgramAndAKilledNodeAreRequeuedAndMergedShardsAreOneRun(self):
        matrix = {"technique": ["forward", "deferred"], "layout": ["exact", "packed"], "lights": [4, 16]}
        (self.folder / "matrix.json").write_text(json.dumps(matrix))
        command = ["bench", "lattice", "--size", "320x180", "--frames", "200", "--matrix", "matrix.json"]
        submitted = subprocess.run([sys.executable, "-B", SHARDS, "slurm", "--program", PROGRAM, "--shards", "2", "-o", "results",
                                    "--", *command], cwd=self.folder, env=self.slurm.environment, text=True, capture_output=True)
        self.assertEqual(submitted.returncode, 0, submitted.stderr)
        os.kill(self.holderOf("1-of-2"), signal.SIGKILL)
        process = self.holderOf("2-of-2")
        self.slurm.endNodeAsByPowerFailure(process)
        self.slurm.startNode()
        merged = self.folder / "results/merged/bench.json"
        self.slurm.wait("all shards are finished and merged",
                        lambda: merged.exists() and not self.slurm.says("squeue", "--noheader"))
        for shard in (1, 2):
            log = (self.folder / f"results/logs/shard-{shard}.log").read_text()
            self.assertIn("start 2: ", log)
            self.assertTrue(log.rstrip().endswith("exit code 0"), log)
        subprocess.run([PROGRAM, *command, "-o", "whole"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(pointsOf(merged), pointsOf(self.folder / "whole/bench.json"))


if __name__ == "__main__":
    # Daemons are not in the PATH of every user.
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [program for program in PROGRAMS if not shutil.which(program)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (tools/packages.txt, cluster); ./test --all installs them")
        sys.exit(SKIPPED)
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
