#!/usr/bin/env python3
"""count.py PROGRAM [--update]: what the main shader programs cost, in instructions, against the table beside this file.

Mesa lists the instructions that it hands to its rasteriser: after everything is inlined, after constants of a program are
folded and after dead code is gone. The rasteriser runs both sides of most branches, so that their number is nearly the time of a
pixel, and unlike a time it is the same in every run. A row is a program of a view; where a column differs by more than 3 % the
test fails. --update writes the table anew: the commit that does so says why. Skipped (exit code 77) with another version of Mesa
than the table is of.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

SKIPPED = 77
TOLERANCE = 0.03
TABLE = pathlib.Path(__file__).resolve().parent / "instructions.txt"
# The table's views by name, as arguments of link_programs.
VIEWS = {
    "lattice": "lattice lights=16",
    "lattice_forward": "lattice lights=16 technique=forward",
    "lattice_packed": "lattice lights=16 technique=clustered_deferred layout=packed",
    "lattice_gpu_lists": "lattice lights=16 technique=tiled_deferred cullOn=compute",
    "lattice_compute": "lattice lights=16 technique=tiled_deferred lightOn=compute",
    "hall": "hall technique=clustered_deferred",
    "hall_maps": "hall shadowFilter=pcf",
    "head": "head",
    "diffused_light": "diffusion_truth",
    "lamps": "lamps",
    "lamps_sampled": "lamps areaLights=sampled",
    "glass": "glass",
    "studio_sampled": "studio environmentLight=sampled",
}
COLUMNS = ("instructions", "slow", "loads", "textures", "branches")
SLOW = {"fdiv", "fsqrt", "frsq", "frcp", "fexp2", "flog2", "fpow", "fsin", "fcos", "idiv", "udiv", "umod", "imod", "irem"}
# Operations that only name values and cost nothing.
FREE = {"load_const", "deref_var", "deref_struct", "deref_array", "deref_cast", "phi", "undefined", "mov"} | {f"vec{n}" for n in range(2, 17)}
BLOCK = re.compile(r"^shader: MESA_SHADER_(\w+)$")
LABEL = re.compile(r"^label: (\w+)")
VALUE = re.compile(r"^\s+(?:vec\d+ \d+ \w+ = )?(?:\(\w+\))?(intrinsic )?([a-z]\w*)")


def kindOf(intrinsic, operation):
    """The columns that an instruction counts in."""
    if intrinsic:
        return ("instructions", "loads") if "load_ubo" in operation or "ssbo" in operation or "image" in operation else ("instructions",)
    if re.match(r"tex$|tx[bldfs]|tg4", operation):
        return ("instructions", "textures")
    return ("instructions", "slow") if operation in SLOW else ("instructions",)


def countsOf(log):
    """{"program.stage": {column: number}} of all that Mesa lists in a log."""
    counts, row = {}, None
    stage = None
    for line in log.splitlines():
        block = BLOCK.match(line)
        if block:
            stage, row = block.group(1).lower(), None
            continue
        label = LABEL.match(line)
        if label and stage:
            row = counts.setdefault(f"{label.group(1)}.{stage}", dict.fromkeys(COLUMNS, 0))
        elif line.startswith("("):
            row = stage = None  # start of the next program's GLSL IR
        if row is None or not line[:1].isspace():
            continue
        text = line.strip()
        if text.startswith(("if ", "loop")):
            row["branches"] += 1
        elif not text.startswith(("block ", "/*", "}", "break", "continue", "decl_")):
            value = VALUE.match(line)
            if value and value.group(2) not in FREE:
                for column in kindOf(*value.groups()):
                    row[column] += 1
    return counts


def measure(program, arguments):
    """The driver, and the counts of one view."""
    environment = {**os.environ, "MESA_GLSL": "dump", "MESA_SHADER_CACHE_DISABLE": "true"}
    done = subprocess.run([program, *arguments], env=environment, capture_output=True, text=True, errors="replace")
    if done.returncode:
        sys.exit(f"link_programs {' '.join(arguments)} ended with {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stdout.strip(), countsOf(done.stderr)


def textOf(driver, rows):
    lines = ["# What programs cost, in instructions of Mesa; count.py PROGRAM --update writes this table.", f"# {driver}",
             f"{'# view':18} {'program':36} " + " ".join(f"{column:>12}" for column in COLUMNS)]
    lines += [f"{view:18} {program:36} " + " ".join(f"{row[column]:12}" for column in COLUMNS) for (view, program), row in rows.items()]
    return "\n".join(lines) + "\n"


def tableIn(text):
    """The driver, and {(view, program): {column: number}}."""
    lines = text.splitlines()
    rows = {}
    for line in lines[3:]:
        view, program, *numbers = line.split()
        rows[(view, program)] = dict(zip(COLUMNS, map(int, numbers)))
    return lines[1].removeprefix("# "), rows


def faultsOf(kept, now):
    """What differs from the table, one line for a figure."""
    faults = [f"{view} {program}: is in the table alone" for view, program in kept.keys() - now.keys()]
    faults += [f"{view} {program}: is not in the table" for view, program in now.keys() - kept.keys()]
    for key in kept.keys() & now.keys():
        for column in COLUMNS:
            before, after = kept[key][column], now[key][column]
            if abs(after - before) > TOLERANCE * before:
                faults.append(f"{key[0]} {key[1]}: {column} {before} -> {after} ({after / max(before, 1) - 1:+.1%})")
    return sorted(faults)


def main():
    program = sys.argv[1]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        found = list(pool.map(lambda arguments: measure(program, arguments.split()), VIEWS.values()))
    driver = found[0][0]
    rows = {(view, name): row for view, (_, counts) in zip(VIEWS, found) for name, row in sorted(counts.items())}
    if sys.argv[2:] == ["--update"]:
        TABLE.write_text(textOf(driver, rows))
        return 0
    kept = tableIn(TABLE.read_text())
    if kept[0] != driver:
        print(f"skipped: the table is of '{kept[0]}', and this is '{driver}'")
        return SKIPPED
    faults = faultsOf(kept[1], rows)
    if faults:
        print(*faults, "", f"Where that is worth its time: {sys.argv[0]} {program} --update, and the reason in the same commit.", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
