"""check_reference.py ROOT: the reference renderer shares with the product what the table of docs/reference.md says.

Every header outside validation/reference that it includes, directly or through others, stands in a row of the first table below
"What both sides share"; every header of that table is included; and every row of the three tables says what stands between.
"""

import pathlib
import re
import sys

DOCUMENT = "docs/reference.md"
HEADING = "## What both sides share"
ROOM = "validation/reference"
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
HEADER = re.compile(r"`([\w/]+\.h)`")
NOTHING = re.compile(r"\b(nothing|none)\b")
TEST = re.compile(r"`\w+\.\w+`")


def includedBy(root):
    """{header outside the room: the file by which it is reached}"""
    found, waiting = {}, sorted((root / ROOM).glob("*.*"))
    while waiting:
        file = waiting.pop()
        for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
            path = name if (root / name).exists() else (file.parent / name).resolve().relative_to(root.resolve()).as_posix()
            if path not in found and not path.startswith(ROOM + "/"):
                found[path] = file.relative_to(root).as_posix()
                waiting.append(root / path)
    return found


def rowsIn(text):
    """The rows of each table below the heading, as lists of cells."""
    section = text.split(HEADING + "\n", 1)[1].split("\n## ", 1)[0]
    tables = re.findall(r"(?:^\|.*\n)+", section, re.MULTILINE)
    return [[[cell.strip() for cell in line.strip("|").split(" | ")] for line in table.splitlines()[2:]] for table in tables]


def faultsOf(included, tables):
    listed = {header for row in tables[0] for header in HEADER.findall(row[0])}
    faults = [f"{by}: includes {header}, which stands in no row of {DOCUMENT}" for header, by in included.items() if header not in listed]
    faults += [f"{DOCUMENT}: lists {header}, which {ROOM} does not include" for header in sorted(listed - included.keys())]
    faults += [f"{DOCUMENT}: '{row[0]}' names no test that stands between, and does not say that nothing does"
               for table in tables for row in table if not TEST.search(row[-1]) and not NOTHING.search(row[-1])]
    return faults


def main():
    root = pathlib.Path(sys.argv[1])
    faults = faultsOf(includedBy(root), rowsIn((root / DOCUMENT).read_text(encoding="utf-8")))
    print(*faults, sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
