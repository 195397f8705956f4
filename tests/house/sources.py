"""The project's own C++ files, for the checks of this folder."""

import pathlib
import subprocess

FOLDERS = ("apps", "base", "engine", "passes", "python", "renderer", "scenes", "shaders", "tests", "tools", "validation", "viewer")


def sourcesOf(root, suffixes=(".h", ".cpp")):
    """Sorted paths below the repository's code folders: those in git or to be added; all of them without git."""
    root = pathlib.Path(root)
    listing = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--",
                              *FOLDERS], capture_output=True, text=True) if (root / ".git").exists() else None
    if listing and listing.returncode == 0:
        paths = [root / name for name in listing.stdout.split("\0") if name]
    else:
        paths = [path for folder in FOLDERS for path in (root / folder).rglob("*")]
    return sorted(path for path in paths if path.suffix in suffixes and path.is_file())
