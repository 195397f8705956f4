"""check_clang.py BUILD [TARGET...]: the sources of these targets, by default of all, compile with clang and without a warning.

They are compiled as BUILD compiles them, but to nothing. Clang 14's warnings count; other versions have others. Exits with 77
(skipped) where there is no clang. One program of libFuzzer stands for all, which differ in a name.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

SKIPPED = 77
TARGET = re.compile(r"(?:^|/)CMakeFiles/([^/]+)\.dir/")
# Silences clang on options that only GCC has, and on names that shadow those of another source of a batch.
FOREIGN = ["-Wno-unknown-warning-option", "-Wno-ignored-optimization-argument", "-Wno-unused-command-line-argument", "-Wno-shadow"]


def isOne(target, wanted):
    if wanted:
        return target in wanted
    return not target.endswith("_verify_interface_header_sets") and (not target.startswith("fuzz_") or target in ("fuzz_readers", "fuzz_gltf"))


def commandsOf(entries, wanted, clang, warnings):
    """(folder, command that compiles to nothing) of each C++ source of the wanted targets."""
    found = []
    for entry in entries:
        words = shlex.split(entry["command"])
        at = words.index("-o")
        target = TARGET.search(words[at + 1])
        if target and isOne(target.group(1), wanted) and pathlib.Path(entry["file"]).suffix in (".cpp", ".cxx"):
            # A launcher such as ccache may stand before the compiler.
            first = next(i for i, word in enumerate(words) if word.startswith("-"))
            found.append((entry["directory"], [clang, *words[first:at], *words[at + 2:], *FOREIGN, *warnings, "-fsyntax-only"]))
    return found


def main():
    clang = shutil.which("clang++-14") or shutil.which("clang++")
    if not clang:
        print("skipped: there is no clang (Debian 12: apt-get install clang)")
        return SKIPPED
    build, wanted = pathlib.Path(sys.argv[1]), sys.argv[2:]
    said = subprocess.run([clang, "--version"], capture_output=True, text=True).stdout
    warnings = ["-Werror"] if re.search(r"version 14\.", said) else ["-Wno-error"]
    commands = commandsOf(json.loads((build / "compile_commands.json").read_text()), wanted, clang, warnings)
    if not commands:
        print(f"{build}/compile_commands.json has none of the targets {wanted}")
        return 1

    def compiled(command):
        return subprocess.run(command[1], cwd=command[0], capture_output=True, text=True)

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        results = list(pool.map(compiled, commands))
    print("".join(result.stderr for result in results))
    return 1 if any(result.returncode for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
