"""check_format.py ROOT: every C++ file is laid out as clang-format 14 lays it out with the repository's .clang-format.

Exits with 77 (skipped) when that version is not there: another one breaks lines elsewhere.
"""

import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

from sources import sourcesOf

SKIPPED = 77
VERSION = "14"


def findClangFormat():
    for name in (f"clang-format-{VERSION}", "clang-format"):
        program = shutil.which(name)
        if program:
            said = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
            if re.search(rf"version {VERSION}\.", said):
                return program
    return None


def main():
    program = findClangFormat()
    if not program:
        print(f"skipped: there is no clang-format {VERSION} (Debian 12: apt-get install clang-format)")
        return SKIPPED
    files = [str(path) for path in sourcesOf(sys.argv[1])]
    jobs = min(len(files), os.cpu_count() or 1)

    def check(part):
        return subprocess.run([program, "--dry-run", "--Werror", *part], capture_output=True, text=True)

    with ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(check, [files[start::jobs] for start in range(jobs)]))
    bad = sorted({line.split(":")[0] for result in results for line in result.stderr.splitlines()
                  if "clang-format-violations" in line})
    if bad:
        print("Not laid out as .clang-format says; remedy: clang-format -i " + " ".join(
            os.path.relpath(path, sys.argv[1]) for path in bad))
    elif any(result.returncode for result in results):
        print("".join(result.stderr for result in results))
    return 1 if any(result.returncode for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
