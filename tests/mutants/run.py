"""run.py ROOT [N] [--seed S] [--only GLOB] [--jobs J]: mutation testing.

Puts one fault at a time (a constant, an operator, a line) into copies of the sources that suites.txt names, runs the
tests that it names beside them, and reports the faults that no test saw. Exit code 3 when more than 3 % of the mutants
survive, those of equivalent.txt, which change nothing that a program could see, left out.

Shaders are read from a folder (TESSERA_SHADERS), so only faults in C++ are compiled, in a copy below build/mutants.
"""

import argparse
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import queue
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = pathlib.Path(__file__).resolve().parent
MOST_SURVIVORS = 0.03
SECONDS_A_SUITE = 300  # a fault may make a loop endless
INVALID = re.compile(r"shader cannot be compiled|program cannot be linked|error: ")

# What a line may become. Binary operators stand between blanks, as the sources are laid out.
OPERATORS = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "), (" <= ", " < "), (" > ", " >= "),
             (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "), (" & ", " | "),
             (" | ", " & "), (" >> ", " << "), (" << ", " >> "), (" += ", " -= "), ("min(", "max("), ("max(", "min(")]
NUMBER = re.compile(r"(?<![\w.\])])(\d+\.\d*(?:[eE][-+]?\d+)?[fF]?|\d+[uU]?)(?![\w.x])")
STATEMENT = re.compile(r"^\s*(?:if \(.*\) (?:return|continue|break|discard)\b.*;|[\w.\[\]]+ [-+*/|&]?= .*;|(?:return|continue|break);)\s*$")
SKIPPED = re.compile(r"^\s*(#|//|/\*|\*|layout\b|uniform\b|struct\b|precision\b|static_assert|using |namespace|extern)")


def otherNumber(text):
    """1 % more of a number with a point, 0.01 for 0.0, one more of a whole number."""
    number, suffix = re.fullmatch(r"(.*?)([fFuU]?)", text).groups()
    if not re.search(r"[.eE]", number):
        return str(int(number) + 1) + suffix
    other = f"{float(number) * 1.01:.9g}" if float(number) else "0.01"
    return (other if re.search(r"[.e]", other) else other + ".0") + suffix # GLSL takes no 1 for a float


def mutantsOfLine(line):
    """(what, new line) for each fault that the line can get."""
    code = line.split("//")[0]
    if SKIPPED.match(line) or not code.strip() or '"' in code:
        return
    for before, after in OPERATORS:
        at = code.find(before)
        while at >= 0:
            yield f"{before.strip()} -> {after.strip()}", line[:at] + after + line[at + len(before):]
            at = code.find(before, at + len(before))
    for match in NUMBER.finditer(code):
        number = otherNumber(match.group(1))
        yield f"{match.group(1)} -> {number}", line[:match.start(1)] + number + line[match.end(1):]
    if STATEMENT.match(line):
        yield "line left out", re.match(r"\s*", line).group(0) + ";"


class Mutant:
    def __init__(self, path, number, what, before, after):
        self.path, self.number, self.what, self.before, self.after = path, number, what, before, after

    def key(self):
        return f"{self.path} | {self.before.strip()} | {self.after.strip()}"

    def __str__(self):
        return f"{self.path}:{self.number}: {self.what}: {self.after.strip()}"


def mutantsOfFile(root, path):
    comment = False
    for number, line in enumerate((root / path).read_text().splitlines(), 1):
        if "/*" in line:
            comment = True
        if not comment:
            for what, after in mutantsOfLine(line):
                yield Mutant(path, number, what, line, after)
        if "*/" in line:
            comment = False


def readSuites():
    """[(pattern of files, ["program:filter" ...])], the first that fits; and the suites of the row `rest`."""
    rows, rest = [], []
    for line in (HERE / "suites.txt").read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        pattern, *suites = line.split()
        if pattern == "rest":
            rest = suites
        else:
            rows.append((pattern, suites))
    return rows, rest


def readEquivalent():
    """{key of a mutant: why it changes nothing that a program could see}"""
    result = {}
    for line in (HERE / "equivalent.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            path, before, after, why = [field.strip() for field in line.split(" | ", 3)]
            result[f"{path} | {before} | {after}"] = why
    return result


def choose(mutants, count, seed):
    """In an order that is the same for a seed, every file in turn, so that any number covers all files."""
    generator = random.Random(seed)
    byFile = {}
    for mutant in mutants:
        byFile.setdefault(mutant.path, []).append(mutant)
    for ofFile in byFile.values():
        generator.shuffle(ofFile)
    # The share of a file is that of its mutants.
    order = sorted(((index + generator.random()) / len(ofFile), path, index)
                   for path, ofFile in byFile.items() for index in range(len(ofFile)))
    return [byFile[path][index] for _, path, index in order][:count]


def runSuite(tests, suite, environment):
    """None when all tests pass, else the name of the first that fails; "invalid" when the fault is none."""
    program, _, names = suite.partition(":")
    try:
        result = subprocess.run([tests / program, f"--gtest_filter={names}-*Slow.*", "--gtest_brief=1", "--gtest_fail_fast"],
                                env={**os.environ, **environment}, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS_A_SUITE)
    except subprocess.TimeoutExpired:
        return f"{suite} (no end)"
    if result.returncode == 0:
        return None
    if INVALID.search(result.stdout):
        return "invalid"
    failed = re.search(r"\[  FAILED  \] (\S+)", result.stdout)
    return failed.group(1) if failed else f"{suite} (exit {result.returncode})"


class Shaders:
    """Judges faults in files that only shaders include: the tests read a changed copy."""

    def __init__(self, root):
        self.root, self.tests = root, root / "build/release/tests"

    def judge(self, mutant, suites):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder) / "shaders"
            shutil.copytree(self.root / "shaders", tree)
            replaceLine(tree / pathlib.Path(mutant.path).relative_to("shaders"), mutant)
            environment = {"TESSERA_SHADERS": str(tree), "LP_NUM_THREADS": "1"}
            return firstKiller(self.tests, suites, environment)


class Sources:
    """Judges faults in C++: compiled in a copy of the repository, one at a time."""

    def __init__(self, root):
        self.copy = root / "build/mutants/source"
        self.lock = threading.Lock()
        files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, check=True, text=True,
                               stdout=subprocess.PIPE).stdout.split("\0")
        for name in filter(None, files):
            source, target = root / name, self.copy / name
            if source.exists() and (not target.exists() or target.read_bytes() != source.read_bytes()):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        self.build = self.copy / "build/release"
        if not (self.build / "build.ninja").exists():
            launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
            subprocess.run(["cmake", "--preset", "release", *launcher], cwd=self.copy, check=True, stdout=subprocess.DEVNULL)
        if not self.compiles():
            sys.exit("the sources do not compile")

    def compiles(self):
        return subprocess.run(["ninja", "-C", self.build, "test_unit", "test_gpu", "test_image"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0

    def judge(self, mutant, suites):
        with self.lock:
            file = self.copy / mutant.path
            text = file.read_text()
            try:
                replaceLine(file, mutant)
                if not self.compiles():
                    return "invalid"
                return firstKiller(self.build / "tests", suites, {})
            finally:
                file.write_text(text)


def replaceLine(file, mutant):
    lines = file.read_text().split("\n")
    assert lines[mutant.number - 1] == mutant.before, mutant
    lines[mutant.number - 1] = mutant.after
    file.write_text("\n".join(lines))


def firstKiller(tests, suites, environment):
    for suite in suites:
        killer = runSuite(tests, suite, environment)
        if killer:
            return killer
    return None


def main():
    parser = argparse.ArgumentParser(prog="./test --mutants", description="Puts one fault at a time into copies of the sources and "
                                     "lists those that no test sees.")
    parser.add_argument("root", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("count", type=int, nargs="?", default=300, help="how many faults (300)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--only", default="*", metavar="GLOB", help="files to change, for example 'shaders/lib/light*'")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many at a time (one a processor)")
    options = parser.parse_args()
    root = options.root.resolve()
    rows, rest = readSuites()
    equivalent = readEquivalent()

    tracked = subprocess.run(["git", "ls-files"], cwd=root, check=True, text=True, stdout=subprocess.PIPE).stdout.split()
    suitesOf = {}
    for path in tracked:
        row = next((suites for pattern, suites in rows if fnmatch.fnmatch(path, pattern)), None)
        if row and row != ["-"] and fnmatch.fnmatch(path, options.only):
            suitesOf[path] = row + [suite for suite in rest if suite not in row]
    mutants = [mutant for path in suitesOf for mutant in mutantsOfFile(root, path)]
    candidates = queue.Queue()
    for mutant in choose(mutants, 2 * options.count, options.seed):
        candidates.put(mutant)

    shaders = Shaders(root)
    sources = None
    if any(not path.startswith("shaders/lib/") for path in suitesOf):
        print("Building a copy for faults in C++ ...", flush=True)
        sources = Sources(root)
    print(f"{len(mutants)} faults are possible in {len(suitesOf)} files; trying {min(options.count, len(mutants))}", flush=True)

    lock = threading.Lock()
    results = []  # (mutant, killer or None)

    def work():
        while True:
            with lock:
                if len(results) + work.running >= options.count or candidates.empty():
                    return
                mutant = candidates.get()
                work.running += 1
            judge = shaders if mutant.path.startswith("shaders/lib/") else sources
            killer = "equivalent" if mutant.key() in equivalent else judge.judge(mutant, suitesOf[mutant.path])
            with lock:
                work.running -= 1
                if killer != "invalid":
                    results.append((mutant, killer))
                    print(f"[{len(results)}/{options.count}] {'SURVIVED' if killer is None else killer}  {mutant}", flush=True)

    work.running = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for future in [pool.submit(work) for _ in range(options.jobs)]:
            future.result()

    survivors = [mutant for mutant, killer in results if killer is None]
    judged = sum(killer != "equivalent" for _, killer in results)
    report = root / "build/mutants/report.json"
    report.parent.mkdir(parents=True, exist_ok=True)
    report.write_text(json.dumps({"schema": 1, "seed": options.seed, "judged": judged,
                                  "survivors": [str(mutant) for mutant in survivors],
                                  "mutants": [{"file": m.path, "line": m.number, "what": m.what, "before": m.before.strip(),
                                               "after": m.after.strip(), "killedBy": k} for m, k in results]}, indent=1))
    print(f"\n{judged} mutants, {len(survivors)} survived ({100.0 * len(survivors) / max(judged, 1):.1f} %; at most "
          f"{100.0 * MOST_SURVIVORS:.0f} % may), {len(results) - judged} are equivalent; {report}")
    for mutant in survivors:
        print(f"  {mutant.key()}")
    return 0 if len(survivors) <= MOST_SURVIVORS * max(judged, 1) else 3


if __name__ == "__main__":
    sys.exit(main())
