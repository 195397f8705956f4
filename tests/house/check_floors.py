"""check_floors.py ROOT: no file includes a floor above its own, and no folders of a floor include each other in a circle.

The floors, top to bottom: python, apps, viewer, validation, engine, passes, renderer, shaders, base; scenes stands beside renderer,
independent of it. Passes are independent of each other: the engine wires them. OpenGL stays inside renderer/gpu, and a render
graph is independent of it. Tests and the command line may include everything.
"""

import collections
import pathlib
import re
import sys

from sources import sourcesOf

# Folders that each module may include besides itself. The most specific module that contains a file counts.
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
    "engine": ("passes", "renderer", "scenes", "shaders", "base"),
    # The reference computes everything independently: it shares only the plain scene.
    "validation/reference": ("scenes",),
    "validation": ("validation/reference", "engine", "passes", "renderer", "scenes", "shaders", "base"),
    "viewer": ("validation", "engine", "passes", "renderer", "scenes", "shaders", "base"),
    "python": ("apps", "validation", "engine", "renderer", "scenes", "base"),
    "apps": ("viewer", "validation", "engine", "passes", "renderer", "scenes", "shaders", "base"),
}
# Single includes that the table forbids, with the reason why they are allowed.
EXCEPTIONS = {
    ("renderer/gpu/Sampler.h", "scenes/Texture.h"): "the scene's own struct says how a texture is sampled",
}
PASS = re.compile(r"(Pass|Prepass)\.h$")
OPENGL = re.compile(r"(glad|GL|GLES\d?|EGL|KHR|GLFW)/")
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^">]+)[">]')
# Paths of GLSL includes are relative to this folder.
SHADERS = "shaders"


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
        return "a pass does not know another pass; let the engine wire them" if other else None
    if target == room or within(included, ROOMS[room]):
        return None
    allowed = ", ".join(ROOMS[room]) or "nothing but itself"
    return f"{room} may include {allowed}; {target} is not below it"


def includesOf(root, file):
    """(line, whether quoted, path from the root) of what one file includes."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        found = INCLUDE.match(line)
        if not found:
            continue
        quoted, included = found.group(1) == '"', found.group(2)
        # A name that is not a path from the root is relative to the shader folder or to the including file.
        if quoted and not (root / included).exists():
            for folder in (root / SHADERS, file.parent):
                if (folder / included).exists():
                    included = (folder / included).resolve().relative_to(root.resolve()).as_posix()
                    break
        yield number, quoted, included


def checkFile(root, file):
    """The messages on one file."""
    path = file.relative_to(root).as_posix()
    messages = []
    for number, quoted, included in includesOf(root, file):
        fault = faultOf(path, quoted, included)
        if fault:
            messages.append(f"{path}:{number}: includes {included}: {fault}")
    return messages


def cyclesOf(root, files):
    """A message on each circle of folders that include each other: the include that leads back to where it began. What stands
    beside subfolders is what they share, or the way into them: includes between a folder and those below it do not count."""
    edges = collections.defaultdict(dict)
    for file in files:
        folder = file.relative_to(root).parent.as_posix()
        if roomOf(folder + "/") is None:
            continue
        for number, quoted, included in includesOf(root, file):
            target = pathlib.PurePosixPath(included).parent.as_posix()
            nested = (folder + "/").startswith(target + "/") or (target + "/").startswith(folder + "/")
            if quoted and not nested and roomOf(included) is not None:
                edges[folder].setdefault(target, f"{file.relative_to(root).as_posix()}:{number}: includes {included}")
    messages = []
    done = set()

    def visit(folder, way):
        for target, place in sorted(edges[folder].items()):
            if target in way:
                circle = way[way.index(target):] + [target]
                messages.append(f"{place}: folders include each other: {' -> '.join(circle)}")
            elif target not in done:
                visit(target, way + [target])
        done.add(folder)

    for folder in sorted(edges):
        if folder not in done:
            visit(folder, [folder])
    return messages


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    files = sourcesOf(root, (".h", ".cpp", ".glsl", ".comp", ".frag", ".vert", ".geom"))
    messages = [message for file in files for message in checkFile(root, file)] + cyclesOf(root, files)
    print("\n".join(messages), end="\n" if messages else "")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
