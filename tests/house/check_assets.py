"""check_assets.py ROOT: what tests prove with third-party models, others prove without.

Every test that is skipped where the folder of third-party models is missing stands in the table of docs/build.md, and its row names
another test, or says that nothing stands in.
"""

import pathlib
import re
import sys

DOCUMENT = "docs/build.md"
HEADER = "| feature | skipped | what stands in |\n"
NAME = re.compile(r"`(\w+\.\w+)`")
TEST = re.compile(r"^TEST(?:_F|_P|_SWEEP|_SWEEP_AS)?\((\w+),\s+(\w+)[,)]", re.MULTILINE)
SKIP = re.compile(r"GTEST_SKIP\(\)[^;]*(?:TESSERA_ASSETS|third-party models|folder of assets|folder_)[^;]*;")
PLACE = re.compile(r"^TEST(?:_F|_P|_SWEEP|_SWEEP_AS)?\((\w+),\s+(\w+)[,)]|^class (\w+)", re.MULTILINE)


def skippedIn(text):
    """Names of the tests that are skipped without the folder; those of a fixture where it skips them all."""
    names = set()
    for skip in SKIP.finditer(text):
        *_, last = PLACE.finditer(text[:skip.start()])
        if last.group(3):
            names |= {f"{suite}.{name}" for suite, name in TEST.findall(text) if suite == last.group(3)}
        else:
            names.add(f"{last.group(1)}.{last.group(2)}")
    return names


def rowsIn(document):
    table = document.split(HEADER, 1)[1].split("\n\n", 1)[0]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in table.splitlines()[1:]]


def faultsOf(skipped, rows):
    listed = {name for row in rows for name in NAME.findall(row[1])}
    faults = [f"{name}: is skipped without third-party models, and stands in no row of {DOCUMENT}" for name in sorted(skipped - listed)]
    faults += [f"{DOCUMENT}: '{row[0]}' names no test that stands in, and does not say that nothing does" for row in rows
               if not set(NAME.findall(row[2])) - skipped and row[2] != "nothing" and "the same test" not in row[2]]
    return faults


def main():
    root = pathlib.Path(sys.argv[1])
    skipped = set()
    for file in sorted((root / "tests").rglob("*.cpp")):
        skipped |= skippedIn(file.read_text(encoding="utf-8"))
    faults = faultsOf(skipped, rowsIn((root / DOCUMENT).read_text(encoding="utf-8")))
    print(*faults, sep="\n")
    return 1 if faults or not skipped else 0


if __name__ == "__main__":
    sys.exit(main())
