"""check_floors.py ROOT: no file includes a floor above its own.

The floors, top to bottom: apps, viewer, validation, passes/recipes, passes, renderer, shaders, base; scenes stands beside
renderer and knows nothing of it. Passes know nothing of each other: recipes wire them. OpenGL stays inside renderer/gpu, and a render
graph knows nothing of it. Tests and the command line may include everything.
"""

import pathlib
import re
import sys

from sources import sourcesOf

# What each room may include, besides itself. The most specific room that holds a file counts.
ROOMS = {
    "base": (),
    "shaders": (),
    "scenes": ("base",),
    "renderer/graph": ("base",),
    "renderer/gpu": ("renderer/graph", "shaders", "base"),
    "renderer/shader": ("renderer/gpu", "renderer/graph", "shaders", "base"),
    "renderer/culling": ("shaders", "base"),
    "renderer/frame": ("renderer/culling", "renderer/gpu", "renderer/graph", "renderer/shader", "scenes", "shaders", "base"),
    "passes": ("renderer", "scenes", "shaders", "base"),
    "passes/recipes": ("passes", "renderer", "scenes", "shaders", "base"),
    # The reference computes everything a second time: it shares the plain scene, and nothing else.
    "validation/reference": ("scenes",),
    "validation": ("validation/reference", "passes", "renderer", "scenes", "shaders", "base"),
    "viewer": ("validation", "passes", "renderer", "scenes", "shaders", "base"),
    "apps": ("viewer", "validation", "passes", "renderer", "scenes", "shaders", "base"),
}
# Single includes that go past the table, with the reason.
EXCEPTIONS = {
    ("renderer/gpu/Sampler.h", "scenes/Scene.h"): "the scene's own struct says how a texture is sampled",
}
PASS = re.compile(r"(Pass|Prepass)\.h$")
OPENGL = re.compile(r"(glad|GL|GLES\d?|EGL|KHR|GLFW)/")
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^">]+)[">]')


def roomOf(path):
    """The most specific room that holds a path, or None."""
    held = [room for room in ROOMS if path.startswith(room + "/")]
    return max(held, key=len, default=None)


def within(path, rooms):
    return any(path.startswith(room + "/") for room in rooms)


def faultOf(path, quoted, included):
    """What is wrong with `path` including `included`, or None. Both are relative to the repository's root."""
    room = roomOf(path)
    if room is None:
        return None
    if OPENGL.match(included):
        if room == "renderer/gpu" and path.endswith(".cpp") or room == "viewer" and included.startswith("GLFW/"):
            return None
        return "OpenGL stays inside the sources of renderer/gpu; use its wrapper"
    if not quoted:
        return None
    target = roomOf(included)
    if target is None or (path, included) in EXCEPTIONS:
        return None
    if room == "passes" and target == "passes":
        other = PASS.search(included) and pathlib.PurePath(path).with_suffix(".h").as_posix() != included
        return "a pass does not know another pass; let a recipe wire them" if other else None
    if target == room or within(included, ROOMS[room]) and not (room == "passes" and target == "passes/recipes"):
        return None
    allowed = ", ".join(ROOMS[room]) or "nothing but itself"
    return f"{room} may include {allowed}; {target} is not below it"


def checkFile(root, file):
    """The messages on one file."""
    path = file.relative_to(root).as_posix()
    messages = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        found = INCLUDE.match(line)
        if not found:
            continue
        quoted, included = found.group(1) == '"', found.group(2)
        # A name that is no path from the root is a neighbour's.
        if quoted and not (root / included).exists() and (file.parent / included).exists():
            included = (file.parent / included).resolve().relative_to(root.resolve()).as_posix()
        fault = faultOf(path, quoted, included)
        if fault:
            messages.append(f"{path}:{number}: includes {included}: {fault}")
    return messages


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    messages = [message for file in sourcesOf(root) for message in checkFile(root, file)]
    print("\n".join(messages), end="\n" if messages else "")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
