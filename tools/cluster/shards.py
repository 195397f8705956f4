#!/usr/bin/env python3
"""Divides a tessera command among processes or machines, and puts together what they find.

The program shards (bench, stress and frames by --shard I/N, single pictures by scene), a scheduler schedules, and
everything may be killed and started again: what is finished is not done twice.
"""
import argparse
import dataclasses
import itertools
import json
import math
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import typing

HERE = pathlib.Path(__file__).resolve().parent

EXAMPLES = """
what may be divided
{works}

examples
  A matrix of 16 groups (scenes x lights x sizes) on a Slurm cluster, a shard for each: a job array, merged by a job of
  its own when all are finished:
    shards.py slurm --shards 16 -o results -- bench hall --matrix matrix.json
  At most four nodes at once, in a partition, each shard within an hour (options of sbatch):
    shards.py slurm --shards 16 --jobs 4 --with=--partition=gpu --with=--time=60 -o results -- bench hall --matrix matrix.json
  The same on the machines that hosts.txt names, by GNU parallel over ssh, one shard at a time on each:
    shards.py parallel --shards 16 --with=--sshloginfile=hosts.txt -o results -- bench hall --matrix matrix.json
  Frames of a sequence, on this machine, two processes, without GNU parallel:
    shards.py xargs --shards 8 --jobs 2 -o film -- render lattice --frames 240 --technique reference
  Reference pictures of three scenes, one a task:
    shards.py slurm -o truth -- render hall room head --technique reference --size 640x360
  What would be run, and nothing else:
    shards.py slurm --dry-run --shards 4 -o results -- stress

Paths in COMMAND are those of the folder in which this is started; that folder, OUT and the program must be the same on
all machines. Started again with the same command line, it finishes what is missing.
"""


class Refused(Exception):
    """Input that makes no sense; one line for the user."""


@dataclasses.dataclass
class Job:
    """A command line: `words` after the --, and where its results go."""

    words: list
    out: pathlib.Path
    program: str
    folder: str
    shards: int
    name: str

    def part(self, index):
        return self.out / "shards" / f"{index}-of-{self.shards}"


def shellLine(job, words, unless=None):
    """One line for a shell; with `unless`, nothing is done where that file is there."""
    command = shlex.join(str(word) for word in words)
    if unless:
        command = f"{{ test -s {shlex.quote(str(unless))} || {command}; }}"
    return f"cd {shlex.quote(job.folder)} && {command}"


def benchLine(job, index):
    # Without an earlier run, --resume starts one.
    return shellLine(job, [job.program, *job.words, "--shard", f"{index}/{job.shards}", "--resume", "-o", job.part(index)])


def benchMerge(job):
    parts = [job.part(index) for index in range(1, job.shards + 1)]
    return shellLine(job, [job.program, "bench", "-o", job.out / "merged", "--merge", *parts])


def groupsOf(words):
    """How many groups of points a bench has at most: a scene with one number of lights in one size each. None where the
    words leave it open; the program reports faults of a matrix."""
    scenes = scenesOf(words)
    rest = words[1 + len(scenes):]
    for before, word in zip(["", *rest], rest):
        isValue = before.startswith("-") and "=" not in before
        if not word.startswith("-") and not isValue:
            return None
    files = [word for before, word in zip(["", *rest], rest) if before == "--matrix"]
    files += [word.partition("=")[2] for word in rest if word.startswith("--matrix=")]
    try:
        matrix = json.loads(pathlib.Path(files[-1]).read_text()) if files else {}
        return len(scenes) * math.prod(len(matrix[key]) for key in ("lights", "size") if key in matrix) or None
    except (OSError, ValueError, TypeError):
        return None


def stressFile(job, index):
    return f"{job.part(index)}.json"


def stressLine(job, index):
    file = stressFile(job, index)
    return shellLine(job, [job.program, *job.words, "--shard", f"{index}/{job.shards}", "--json", file], unless=file)


def stressMerge(job):
    parts = [stressFile(job, index) for index in range(1, job.shards + 1)]
    return shellLine(job, [sys.executable, HERE / "shards.py", "join", "-o", job.out / "stress.json", *parts])


def framesLine(job, index):
    return shellLine(job, [job.program, *job.words, "--shard", f"{index}/{job.shards}", "-o", job.out / job.name])


def scenesOf(words):
    return list(itertools.takewhile(lambda word: not word.startswith("-"), words[1:]))


def pictureLine(job, index):
    scenes = scenesOf(job.words)
    file = job.out / job.name.replace("{scene}", pathlib.Path(scenes[index - 1]).stem)
    options = job.words[1 + len(scenes):]
    return shellLine(job, [job.program, "render", scenes[index - 1], *options, "-o", file], unless=file)


@dataclasses.dataclass
class Work:
    """A kind of command: how a shard of it is run, and how shards are put together."""

    name: str
    words: str
    own: list  # options that this tool sets
    line: typing.Callable
    merge: typing.Optional[typing.Callable] = None
    pictures: typing.Optional[str] = None  # default of --name
    isTimed: bool = False  # needs a machine of its own
    isByScene: bool = False  # one shard per scene; else --shards is their number
    parts: typing.Optional[typing.Callable] = None  # maximum number of parts of the words, or None
    part: str = ""  # name of such parts


WORKS = [
    Work("bench", "groups of points; OUT/merged is what one run would have written, or has a column a machine",
         ["--shard", "--resume", "--merge", "-o", "--output"], benchLine, benchMerge, isTimed=True,
         parts=groupsOf, part="groups of points (one scene, named right after bench, with one number of lights in one size)"),
    Work("stress", "cases; OUT/stress.json has all of them", ["--shard", "--json"], stressLine, stressMerge),
    Work("frames", "`render SCENE --frames N`: every Nth frame, into OUT", ["--shard", "-o", "--output"], framesLine,
         pictures="frame_%05d.png"),
    Work("pictures", "`render SCENE SCENE ...`: a picture a scene, into OUT", ["--shard", "-o", "--output"], pictureLine,
         pictures="{scene}.exr", isByScene=True),
]


def hasOption(words, option):
    return any(word == option or word.startswith(option + "=") for word in words) or (
        len(option) == 2 and any(word.startswith(option) and not word.startswith("--") for word in words))


def workOf(words):
    name = words[0] if words else ""
    if name == "render":
        name = "frames" if hasOption(words, "--frames") else "pictures"
    for work in WORKS:
        if work.name == name:
            return work
    raise Refused(f"'{name}' cannot be divided: give bench, stress or render and their options after --")


def requireSense(work, arguments):
    words = arguments.command
    for option in work.own:
        if hasOption(words[1:], option):
            raise Refused(f"{option} is given by this tool; leave it out of the command")
    if any("\n" in word for word in [*words, str(arguments.output), os.getcwd()]):
        raise Refused("a word or path with a line break cannot be passed on; name it otherwise")
    if arguments.jobs is not None and arguments.jobs < 1:
        raise Refused("--jobs: at least one part runs at once")
    if work.isByScene:
        scenes = scenesOf(words)
        stems = [pathlib.Path(scene).stem for scene in scenes]
        if not scenes:
            raise Refused("name a scene after render, before its options")
        if arguments.shards:
            raise Refused("pictures have a shard a scene; leave --shards out")
        twice = next((stem for stem in stems if stems.count(stem) > 1), None)
        if twice and len(scenes) > 1:
            raise Refused(f"two scenes are named {twice}, and their pictures would be one file; divide them in two runs")
        if len(scenes) > 1 and "{scene}" not in (arguments.name or work.pictures):
            raise Refused("--name needs the place {scene}, so that each scene has a file of its own")
        return
    if not arguments.shards or arguments.shards < 1:
        raise Refused("say with --shards into how many parts the work is to be divided")
    most = work.parts(words) if work.parts else None
    if most is not None and arguments.shards > most:
        raise Refused(f"--shards {arguments.shards}: more than there are {work.part}: {most}; give fewer shards")


def programOf(name):
    """The program as an absolute path: as named, in PATH, or built in this repository."""
    candidates = [name] if name else ["tessera", HERE.parents[1] / "build/release/apps/tessera"]
    for candidate in candidates:
        found = shutil.which(str(candidate))
        if found:
            return os.path.abspath(found)
    raise Refused(f"{name or 'tessera'}: no such program; give --program")


def write(file, text):
    """Whole or not at all."""
    temporary = file.with_name(f".{file.name}.{os.getpid()}")
    temporary.write_text(text)
    temporary.replace(file)


def sbatch(job, work, arguments, array):
    """sbatch as words, without the file of lines: of the array, or of the merge."""
    log = str(job.out / "logs").replace("%", "%%") + ("/shard-%a.log" if array else "/merge.log")
    words = ["sbatch", "--parsable", f"--job-name=tessera-{work.name}", f"--output={log}", "--open-mode=append",
             "--requeue", f"--chdir={job.folder}"]
    if array:
        words.append(f"--array=1-{job.shards}" + (f"%{arguments.jobs}" if arguments.jobs else ""))
        if work.isTimed:
            words.append("--exclusive")
    return words + arguments.option


def slurm(job, work, arguments, lines, merge):
    """(commands to run, in order): the second waits for the first, whose job replaces {job}."""
    script = str(HERE / "job.sh")
    commands = [sbatch(job, work, arguments, True) + [script, str(lines)]]
    if merge:
        commands.append(sbatch(job, work, arguments, False) +
                        ["--dependency=afterok:{job}", "--kill-on-invalid-dep=yes", script, str(merge)])
    return commands


def parallel(job, work, arguments, lines, merge):
    # Each line of the file is a whole command, so nothing in it is quoted or replaced again.
    return [["parallel", "--will-cite", "--jobs", str(arguments.jobs or 1), *arguments.option, "--arg-file", str(lines)]]


def xargs(job, work, arguments, lines, merge):
    return [["xargs", "--max-procs", str(arguments.jobs or 1), "--max-args", "1", "--delimiter", "\\n", *arguments.option,
             "--arg-file", str(lines), "sh", "-c"]]


SCHEDULERS = {"slurm": slurm, "parallel": parallel, "xargs": xargs}
PACKAGES = {"slurm": ("sbatch", "Slurm (Debian: slurm-client)"), "parallel": ("parallel", "GNU parallel (Debian: parallel)"),
            "xargs": ("xargs", "GNU xargs (Debian: findutils)")}


def divide(arguments):
    work = workOf(arguments.command)
    requireSense(work, arguments)
    shards = len(scenesOf(arguments.command)) if work.isByScene else arguments.shards
    out = pathlib.Path(os.path.abspath(arguments.output))
    job = Job(arguments.command, out, programOf(arguments.program), os.getcwd(), shards, arguments.name or work.pictures)
    commands = [work.line(job, index) for index in range(1, shards + 1)]
    merge = work.merge(job) if work.merge else None
    linesFile, mergeFile = out / "commands.txt", out / "merge.txt"
    scheduled = SCHEDULERS[arguments.by](job, work, arguments, linesFile, mergeFile if merge else None)
    if arguments.dryRun:
        print(f"# {shards} of {work.name}, the lines of {linesFile}", *commands, "# scheduled by", sep="\n")
        print(*(shlex.join(words) for words in scheduled), sep="\n")
        if merge:
            print(f"# put together by, in {mergeFile}", merge, sep="\n")
        return 0
    if not shutil.which(PACKAGES[arguments.by][0]):
        others = ", ".join(name for name in SCHEDULERS if name != arguments.by and shutil.which(PACKAGES[name][0]))
        raise Refused(f"{PACKAGES[arguments.by][1]} is not installed" + (f"; here are: {others}" if others else ""))
    text = "".join(line + "\n" for line in commands)
    if linesFile.exists() and linesFile.read_text() != text:
        raise Refused(f"{out} holds other work, see {linesFile}; name another folder, or remove it")
    for folder in ("shards", "logs"):
        (out / folder).mkdir(parents=True, exist_ok=True)
    write(linesFile, text)
    if merge:
        write(mergeFile, merge + "\n")
    return submit(scheduled, out) if arguments.by == "slurm" else runHere(scheduled, merge, linesFile)


def submit(scheduled, out):
    job = ""
    for words in scheduled:
        result = subprocess.run([word.replace("{job}", job) if word.startswith("--dependency=") else word for word in words],
                                text=True, stdout=subprocess.PIPE)
        if result.returncode != 0:
            raise Refused(f"{words[0]} ended with exit code {result.returncode}; what it said is above")
        job = result.stdout.strip().split(";")[0]
        print(f"job {job}: {shlex.join(words[-2:])}")
    print(f"logs are in {out / 'logs'}; squeue shows what runs, and a shard that ended is requeued with scontrol requeue")
    return 0


def runHere(scheduled, merge, linesFile):
    code = max(subprocess.run(words).returncode for words in scheduled)
    if merge:
        # The merge refuses unfinished shards and reports the findings.
        return subprocess.run(["sh", "-c", merge]).returncode
    if code != 0:
        raise Refused(f"some of {linesFile} failed; what they said is above; run this again for what is missing")
    return 0


def rowsOfCases(record):
    """The results of each case: of one by several techniques they stand one after another."""
    return [list(rows) for _, rows in itertools.groupby(record["cases"], key=lambda row: row["name"])]


def joined(records):
    """One record of stress from those of its shards, in the order of shards: as one run would have written it. Of
    several renderers each result says its own."""
    efforts = sorted({record["effort"] for record in records})
    if len(efforts) > 1:
        raise Refused(f"shards of different effort cannot be put together: {' and '.join(efforts)}")
    renderers = list(dict.fromkeys(record["renderer"] for record in records))
    if len(renderers) > 1:
        for record in records:
            for row in record["cases"]:
                row["renderer"] = record["renderer"]
    cases = [rows for turn in itertools.zip_longest(*map(rowsOfCases, records)) for rows in turn if rows]
    return {"schema": records[0]["schema"], "renderer": "; ".join(renderers), "effort": efforts[0],
            "ok": all(record["ok"] for record in records), "cases": list(itertools.chain.from_iterable(cases))}


def join(arguments):
    records = []
    for file in arguments.files:
        try:
            records.append(json.loads(pathlib.Path(file).read_text()))
            if not {"schema", "renderer", "effort", "ok", "cases"} <= set(records[-1]):
                raise ValueError
        except OSError as error:
            raise Refused(f"{file}: {error.strerror}; that shard is not finished") from None
        except (ValueError, TypeError):
            raise Refused(f"{file}: is no record of tessera stress --json") from None
    whole = joined(records)
    write(pathlib.Path(arguments.output), json.dumps(whole, indent=2, ensure_ascii=False) + "\n")
    missed = [row for row in whole["cases"] if not row["ok"]]
    for row in missed:
        print(f"missed: {row['name']}" + (f" with {row['technique']}" if row["technique"] else "") + f": {'; '.join(row['missed'])}")
    print(f"{len(missed)} of {len(whole['cases'])} missed; {arguments.output}")
    return 0 if whole["ok"] else 3


def parsed(words):
    works = "\n".join(f"  {work.name:9} {work.words}" for work in WORKS)
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES.format(works=works),
                                     formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    kinds = parser.add_subparsers(dest="by", required=True, metavar="slurm|parallel|xargs|join")
    for name, words_ in (("slurm", "a Slurm job array"), ("parallel", "GNU parallel, here or on other machines by ssh"),
                         ("xargs", "processes of this machine, where GNU parallel is missing")):
        kind = kinds.add_parser(name, help=words_, usage=f"shards.py {name} -o OUT [options] -- COMMAND ARG...",
                                description=f"Schedules by {words_}.", allow_abbrev=False)
        kind.add_argument("-o", "--output", required=True, metavar="OUT", help="folder of all results")
        kind.add_argument("--shards", type=int, metavar="N", help="parts to divide the work into")
        kind.add_argument("--jobs", type=int, metavar="J",
                          help="parts that run at once [slurm: all, others: 1 a machine, since tessera takes all cores]")
        kind.add_argument("--program", help="the program [tessera of PATH, else of this repository's build]")
        kind.add_argument("--name", help="file of a picture in OUT [frames: frame_%%05d.png, pictures: {scene}.exr]")
        kind.add_argument("--with", dest="option", action="append", default=[], metavar="OPTION",
                          help=f"an option for {PACKAGES[name][0]}, as --with=--OPTION; may be given again")
        kind.add_argument("--dry-run", dest="dryRun", action="store_true", help="prints what would be run; writes nothing")
        kind.set_defaults(run=divide)
    kind = kinds.add_parser("join", help="puts the JSON files of stress shards together, given from the first to the last",
                            allow_abbrev=False)
    kind.add_argument("-o", "--output", required=True, metavar="FILE")
    kind.add_argument("files", nargs="+", metavar="SHARD")
    kind.set_defaults(run=join)
    # All words after -- belong to the program.
    at = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:at])
    arguments.command = words[at + 1:]
    return arguments


def main(words):
    arguments = parsed(words)
    try:
        return arguments.run(arguments)
    except Refused as error:
        print(f"shards.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"shards.py: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
