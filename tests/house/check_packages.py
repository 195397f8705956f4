"""check_packages.py ROOT: tools/packages.txt (Debian) and vcpkg.json (elsewhere) name the same libraries."""

import json
import pathlib
import sys


SETS = ("build", "test", "package", "python", "cluster", "fit", "zink", "fuzz")


def faultsOf(table, manifest):
    """Messages on a package table's text and a parsed vcpkg.json."""
    ports = {}
    messages = []
    for number, line in enumerate(table.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        fields = line.split(None, 3)
        if len(fields) < 4 or fields[1] not in SETS:
            messages.append(f"tools/packages.txt:{number}: a line is: package, set ({', '.join(SETS)}), vcpkg port or -, what for")
        elif fields[2] != "-":
            ports[fields[2]] = fields[0]
    listed = {entry if isinstance(entry, str) else entry["name"] for entry in manifest["dependencies"]}
    messages += [f"vcpkg.json: lacks {port}, which tools/packages.txt gives for Debian's {ports[port]}"
                 for port in sorted(ports.keys() - listed)]
    messages += [f"tools/packages.txt: names no Debian package for {port} of vcpkg.json" for port in sorted(listed - ports.keys())]
    return messages


def main():
    root = pathlib.Path(sys.argv[1])
    messages = faultsOf((root / "tools/packages.txt").read_text(), json.loads((root / "vcpkg.json").read_text()))
    print("\n".join(messages), end="\n" if messages else "")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
