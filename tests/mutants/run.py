"""run.py ROOT [N] [--seed S] [--only GLOB] [--jobs J] [--resume] [--again]: mutation testing.

Puts one fault at a time (a constant, an operator, a line) into copies of the sources that suites.txt names, runs the
tests that it names beside them, and reports the faults that no test saw, by folder. What survives those tests is shown to
the slow suites of the same names. Exit code 3 when more than 1 % of the mutants survive, those of equivalent.txt, which
change nothing that a program could see, left out.

Shaders are read from a folder (TESSERA_SHADERS), so only faults in C++ are compiled, in a copy below build/mutants.

build/mutants/results.json keeps what every fault met, written as soon as it is known: a run that was stopped goes on with
--resume. killers.txt holds the test that saw each fault, which is tried first, so that a run takes a fraction of the time
of the first; --remember adds what a run has found.
"""

import argparse
import concurrent.futures
import fcntl
import fnmatch
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
KILLERS = HERE / "killers.txt"
MOST_SURVIVORS = 0.01
SECONDS_A_SUITE = 240  # a fault may cause an endless loop
SECONDS_A_SLOW_SUITE = 1200
INVALID = re.compile(r"shader cannot be compiled|program cannot be linked|error: ")

# Every file of these has a row in suites.txt.
DRAWN = ["shaders/lib/*.glsl", "renderer/*.cpp", "scenes/import/*.cpp", "validation/reference/*.cpp"]

# Possible faults of a line. The source layout puts blanks around binary operators.
OPERATORS = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "), (" <= ", " < "), (" > ", " >= "),
             (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "), (" & ", " | "),
             (" | ", " & "), (" >> ", " << "), (" << ", " >> "), (" += ", " -= "), ("min(", "max("), ("max(", "min(")]
NUMBER = re.compile(r"(?<![\w.\])])(\d+\.\d*(?:[eE][-+]?\d+)?[fF]?|\d+[uU]?)(?![\w.x])")
STATEMENT = re.compile(r"^\s*(?:if \(.*\) (?:return|continue|break|discard)\b.*;|[\w.\[\]]+ [-+*/|&]?= .*;|(?:return|continue|break);)\s*$")
SKIPPED = re.compile(r"^\s*(#|//|/\*|\*|layout\b|uniform\b|struct\b|precision\b|static_assert|assert|using |namespace|extern)")


def codeOf(line):
    """A line without its comment."""
    return line.split("//")[0].strip()


def otherNumber(text):
    """1 % more of a number with a point, 0.01 for 0.0, one more of a whole number."""
    number, suffix = re.fullmatch(r"(.*?)([fFuU]?)", text).groups()
    if not re.search(r"[.eE]", number):
        return str(int(number) + 1) + suffix
    other = f"{float(number) * 1.01:.9g}" if float(number) else "0.01"
    return (other if re.search(r"[.e]", other) else other + ".0") + suffix # GLSL floats need a decimal point


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
        self.name = ""  # key(), numbered where the same change applies to equal lines of the file

    def key(self):
        return f"{self.path} | {codeOf(self.before)} | {codeOf(self.after)}"

    def __str__(self):
        return f"{self.path}:{self.number}: {self.what}: {self.after.strip()}"


def mutantsOfFile(root, path):
    comment, seen = False, {}
    for number, line in enumerate((root / path).read_text().splitlines(), 1):
        if "/*" in line:
            comment = True
        if not comment:
            for what, after in mutantsOfLine(line):
                mutant = Mutant(path, number, what, line, after)
                times = seen[mutant.key()] = seen.get(mutant.key(), 0) + 1
                mutant.name = mutant.key() + (f" | {times}" if times > 1 else "")
                yield mutant
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


def byFolder(results):
    """[(folder, [(mutant, killer) ...])], in the order of their names."""
    folders = {}
    for mutant, killer in results:
        folders.setdefault(str(pathlib.Path(mutant.path).parent), []).append((mutant, killer))
    return sorted(folders.items())


def readEquivalent():
    """Rows of equivalent.txt: the key of a mutant, and why it changes nothing that a program could see."""
    lines = (HERE / "equivalent.txt").read_text().splitlines()
    return [line for line in lines if line.strip() and not line.startswith("#")]


def isEquivalent(mutant, rows):
    """Lines of code hold the mark between the fields, too, so that a row is not taken apart."""
    return any(row.startswith(mutant.key() + " | ") for row in rows)


def slowSuites(tests, suites):
    """["program:filter" ...]: the slow suites of the same names, whole, of those programs that have any."""
    byProgram = {}
    for suite in suites:
        program, _, names = suite.partition(":")
        for name in re.split("[:]", names.partition("-")[0]):
            byProgram.setdefault(program, set()).add(name.partition(".")[0].rstrip("*") + "Slow.*")
    return [f"{program}:{':'.join(sorted(names))}" for program, names in byProgram.items()
            if hasTests(tests / program, ":".join(names))]


def hasTests(program, names):
    listed = subprocess.run([program, "--gtest_list_tests", f"--gtest_filter={names}"], text=True, stdout=subprocess.PIPE,
                            check=True).stdout
    return re.search(r"^  \w", listed, re.MULTILINE) is not None


def requireTests(tests, suites):
    """Ends the program where a part of a suite's filter names no test, which would see nothing."""
    for suite in sorted(suites):
        program, _, names = suite.partition(":")
        for name in re.split("[:-]", names):
            if not hasTests(tests / program, name):
                sys.exit(f"suites.txt: {program} has no test '{name}'")


def choose(mutants, seed):
    """In an order that is the same for a seed, every file in turn, so that any number covers all files. Where a mutant stands
    hangs on its own text, so that edits elsewhere in the repository hardly move it."""
    def number(text):
        return int.from_bytes(hashlib.sha256(f"{seed} {text}".encode()).digest()[:8], "big")

    byFile = {}
    for mutant in mutants:
        byFile.setdefault(mutant.path, []).append(mutant)
    order = []
    for path, ofFile in byFile.items():
        ofFile.sort(key=lambda mutant: number(mutant.name))
        # Spreads each file's mutants evenly, so that any prefix holds files in proportion to their mutants.
        order += [((index + number(path) / 2**64) / len(ofFile), path, index) for index in range(len(ofFile))]
    return [byFile[path][index] for _, path, index in sorted(order)]


def runSuite(tests, suite, environment):
    """None when all tests pass, else the name of the first that fails; "invalid" when the fault is none."""
    program, _, names = suite.partition(":")
    isSlow = "Slow." in names
    left = "" if isSlow else ":*Slow.*" if "-" in names else "-*Slow.*"
    try:
        result = subprocess.run([tests / program, f"--gtest_filter={names}{left}", "--gtest_brief=1", "--gtest_fail_fast"],
                                env={**os.environ, **environment}, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                timeout=SECONDS_A_SLOW_SUITE if isSlow else SECONDS_A_SUITE)
    except subprocess.TimeoutExpired:
        return f"{suite} (no end)"
    if result.returncode == 0:
        return None
    if INVALID.search(result.stdout):
        return "invalid"
    failed = re.search(r"\[  FAILED  \] ([\w/]+\.[\w/]+)", result.stdout)
    return f"{program}:{failed.group(1)}" if failed else f"{suite} (exit {result.returncode})"


class Shaders:
    """Judges faults in files that only shaders include: the tests read a changed copy."""

    def __init__(self, root):
        self.root, self.tests = root, root / "build/release/tests"

    def judge(self, mutant, suites):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder) / "shaders"
            shutil.copytree(self.root / "shaders", tree)
            replaceLine(tree / pathlib.Path(mutant.path).relative_to("shaders"), mutant)
            # Compiling shaders takes nearly all the time; without LLVM's optimisations it takes half.
            environment = {"TESSERA_SHADERS": str(tree), "LP_NUM_THREADS": "1", "GALLIVM_PERF": "nopt"}
            return firstKiller(suites, lambda suite: runSuite(self.tests, suite, environment))


class Sources:
    """Judges faults in C++: compiled in a copy of the repository, one at a time."""

    programs = ["test_unit", "test_gpu", "test_image"]

    def __init__(self, root):
        self.copy = root / "build/mutants/source"
        self.copy.mkdir(parents=True, exist_ok=True)
        self.lock = open(self.copy.with_suffix(".lock"), "w")  # only one run at a time uses the copy
        fcntl.flock(self.lock, fcntl.LOCK_EX)
        files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, check=True, text=True,
                               stdout=subprocess.PIPE).stdout.split("\0")
        self.removeAllBut(files)
        for name in filter(None, files):
            source, target = root / name, self.copy / name
            if source.exists() and (not target.exists() or target.read_bytes() != source.read_bytes()):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        self.build = self.copy / "build/release"
        if not (self.build / "build.ninja").exists():
            launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
            subprocess.run(["cmake", "--preset", "release", *launcher], cwd=self.copy, check=True, stdout=subprocess.DEVNULL)
        if not self.compiles(*self.programs):
            sys.exit("the sources do not compile")

    def removeAllBut(self, files):
        """What was deleted or renamed since the last run would be compiled: sources are found by their names."""
        for path in sorted(self.copy.rglob("*"), reverse=True):
            name = path.relative_to(self.copy)
            if name.parts[0] != "build" and path.is_file() and str(name) not in files:
                path.unlink()

    def compiles(self, *programs):
        return subprocess.run(["ninja", "-C", self.build, *programs], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0

    def judge(self, mutant, suites):
        file = self.copy / mutant.path
        text = file.read_text()

        def run(suite):
            if not self.compiles(suite.partition(":")[0]):
                return "invalid"
            return runSuite(self.build / "tests", suite, {})

        try:
            replaceLine(file, mutant)
            if file.suffix == ".cpp":  # detects indices beyond a vector's end, if the source is compiled alone
                file.write_text("#define _GLIBCXX_ASSERTIONS\n" + file.read_text())
            return firstKiller(suites, run)
        finally:
            file.write_text(text)


def isShader(mutant):
    return mutant.path.startswith("shaders/") and not mutant.path.endswith(".h")  # C++ includes only the .h files


def replaceLine(file, mutant):
    lines = file.read_text().split("\n")
    assert lines[mutant.number - 1] == mutant.before, mutant
    lines[mutant.number - 1] = mutant.after
    file.write_text("\n".join(lines))


def firstKiller(suites, run):
    for suite in suites:
        killer = run(suite)
        if killer:
            return killer
    return None


class Results:
    """What every mutant met in earlier runs: {name: {"killedBy": test or None, "sources": hash}}, on disk."""

    def __init__(self, root):
        self.path = root / "build/mutants/results.json"
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.known = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.killers = dict(line.rsplit(" | ", 1) for line in KILLERS.read_text().splitlines() if " | " in line and line[0] != "#")
        files = subprocess.run(["git", "ls-files", "-z"], cwd=root, check=True, text=True, stdout=subprocess.PIPE).stdout.split("\0")
        digest = hashlib.sha256()
        for name in filter(None, files):
            if not name.startswith(("docs/", "tests/mutants/")) and (root / name).is_file():
                digest.update(name.encode() + hashlib.sha256((root / name).read_bytes()).digest())
        self.sources = digest.hexdigest()[:16]

    def kept(self, mutant, resume, again):
        """(known, killer): what a run with these options need not find out once more."""
        result = self.known.get(mutant.name)
        known = result is not None and (
            (resume and result["sources"] == self.sources) or (again and result["killedBy"] is not None))
        return known, result["killedBy"] if known else None

    def lastKiller(self, mutant):
        """["program:test"] that saw the mutant last time."""
        killer = (self.known.get(mutant.name) or {}).get("killedBy") or self.killers.get(mutant.name, "")
        return [killer.split(" ")[0]] if ":" in killer else []

    def remember(self, mutants):
        """Adds the tests that saw these mutants to killers.txt; of mutants that are gone the rows go."""
        found = {name: result["killedBy"].split(" ")[0] for name, result in self.known.items() if ":" in (result["killedBy"] or "")}
        names, files = {mutant.name for mutant in mutants}, {mutant.path for mutant in mutants}
        rows = sorted(f"{name} | {killer}" for name, killer in {**self.killers, **found}.items()
                      if name in names or name.split(" | ")[0] not in files)
        head = [line for line in KILLERS.read_text().splitlines() if line.startswith("#")]
        KILLERS.write_text("\n".join([*head, *rows]) + "\n")

    def add(self, mutant, killer):
        self.known[mutant.name] = {"killedBy": killer, "sources": self.sources}
        with open(self.path.with_suffix(".lock"), "w") as lock:  # another run may have added results
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.write(json.loads(self.path.read_text()) if self.path.exists() else {}, mutant.name)

    def write(self, others, name):
        others[name] = self.known[name]
        with tempfile.NamedTemporaryFile("w", dir=self.path.parent, delete=False) as file:
            json.dump(others, file, indent=1)
        os.replace(file.name, self.path)


def main():
    parser = argparse.ArgumentParser(prog="./test --mutants", description="Puts one fault at a time into copies of the sources and "
                                     "lists those that no test sees.")
    parser.add_argument("root", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("count", type=int, nargs="?", default=500, help="how many faults (500)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--only", default="*", metavar="GLOB", help="files to change, for example 'shaders/lib/light/*'")
    parser.add_argument("--part", default="*", metavar="GLOB", help="of the chosen faults, judge those in these files")
    parser.add_argument("--quick", action="store_true", help="leave the slow suites out")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many at a time (one a processor)")
    parser.add_argument("--resume", action="store_true", help="keep what earlier runs found of the same sources and tests")
    parser.add_argument("--remember", action="store_true", help="write the tests that saw faults to tests/mutants/killers.txt")
    parser.add_argument("--again", action="store_true", help="keep the faults that any earlier run saw killed: judge survivors again")
    options = parser.parse_args()
    root = options.root.resolve()
    rows, rest = readSuites()
    equivalent = readEquivalent()

    tracked = subprocess.run(["git", "ls-files"], cwd=root, check=True, text=True, stdout=subprocess.PIPE).stdout.split()
    suitesOf = {}
    for path in tracked:
        row = next((suites for pattern, suites in rows if fnmatch.fnmatch(path, pattern)), None)
        if row is None and any(fnmatch.fnmatch(path, pattern) for pattern in DRAWN):
            sys.exit(f"suites.txt: no row fits {path}")
        if row and row != ["-"] and fnmatch.fnmatch(path, options.only):
            suitesOf[path] = row + [suite for suite in rest if suite not in row]
    requireTests(root / "build/release/tests", {suite for suites in suitesOf.values() for suite in suites})
    mutants = [mutant for path in suitesOf for mutant in mutantsOfFile(root, path)]
    candidates = choose(mutants, options.seed)
    known = Results(root)
    print(f"{len(mutants)} faults are possible in {len(suitesOf)} files; trying {min(options.count, len(mutants))}", flush=True)

    lock = threading.Lock()
    found = {}  # index in `candidates`: killer or None
    taken = set()
    state = {"limit": options.count, "sources": None, "compiling": False}  # each invalid mutant raises the limit by one

    def take():
        """A place in `candidates`; None when nothing is left; -1 when all that is left waits for the compiler."""
        waiting = False
        for place in range(min(state["limit"], len(candidates))):
            if place not in taken and fnmatch.fnmatch(candidates[place].path, options.part):
                if state["compiling"] and not isShader(candidates[place]):
                    waiting = True
                    continue
                taken.add(place)
                return place
        return -1 if waiting else None

    def judged(mutant):
        if isEquivalent(mutant, equivalent):
            return "equivalent"
        isKnown, killer = known.kept(mutant, options.resume, options.again)
        if isKnown:
            return killer
        suites = known.lastKiller(mutant) + suitesOf[mutant.path]
        if not options.quick:
            suites = suites + slowSuites(root / "build/release/tests", suitesOf[mutant.path])
        if isShader(mutant):
            return Shaders(root).judge(mutant, suites)
        if not state["sources"]:
            print("Building a copy for faults in C++ ...", flush=True)
            state["sources"] = Sources(root)
        return state["sources"].judge(mutant, suites)

    def work():
        while True:
            with lock:
                place = take()
                if place is None:
                    return
                if place >= 0 and not isShader(candidates[place]):
                    state["compiling"] = True
            if place < 0:
                time.sleep(1)
                continue
            mutant = candidates[place]
            start = time.monotonic()
            try:
                killer = judged(mutant)
            finally:
                if not isShader(mutant):
                    state["compiling"] = False
            with lock:
                if killer == "invalid":
                    state["limit"] += 1
                else:
                    found[place] = killer
                if killer != "equivalent":
                    known.add(mutant, killer)
                if killer != "invalid":
                    print(f"[{len(found)}/{options.count}] {'SURVIVED' if killer is None else killer}  {mutant}  "
                          f"({time.monotonic() - start:.0f} s)", flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for future in [pool.submit(work) for _ in range(options.jobs)]:
            future.result()

    if options.remember:
        known.remember(mutants)
    results = [(candidates[place], found[place]) for place in sorted(found)]
    survivors = [mutant for mutant, killer in results if killer is None]
    judged = sum(killer != "equivalent" for _, killer in results)
    report = root / "build/mutants/report.json"
    report.write_text(json.dumps({"schema": 1, "seed": options.seed, "judged": judged,
                                  "survivors": [str(mutant) for mutant in survivors],
                                  "mutants": [{"file": m.path, "line": m.number, "what": m.what, "before": m.before.strip(),
                                               "after": m.after.strip(), "killedBy": k} for m, k in results]}, indent=1))
    print(f"\n{judged} mutants, {len(survivors)} survived ({100.0 * len(survivors) / max(judged, 1):.1f} %; at most "
          f"{100.0 * MOST_SURVIVORS:.0f} % may), {len(results) - judged} are equivalent; {report}")
    for folder, ofFolder in byFolder([result for result in results if result[1] != "equivalent"]):
        alive = [mutant for mutant, killer in ofFolder if killer is None]
        print(f"{folder}: {len(ofFolder)} mutants, {len(alive)} survived")
        for mutant in alive:
            print(f"  {mutant.key()}")
    return 0 if len(survivors) <= MOST_SURVIVORS * max(judged, 1) else 3


if __name__ == "__main__":
    sys.exit(main())
