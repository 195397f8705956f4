"""check_batches.py ROOT: sources that are compiled in one batch never define a name twice.

CMake compiles twelve sources of a target as one (CMAKE_UNITY_BUILD), and which twelve changes with every new file. So what stands
in an anonymous namespace must have a name of its own in its target, but for functions that differ in what they take.
"""

import collections
import pathlib
import re
import sys

from sources import sourcesOf

# Folders whose sources are one target each; the longest that holds a file counts.
TARGETS = ("apps", "base", "engine", "passes", "python", "renderer", "scenes", "shaders", "validation", "viewer", "tests/unit", "tests/gpu", "tests/image",
           "tests/cli/program", "tests/viewer")
# Sources of other folders that tests/CMakeLists.txt compiles into a target too.
GUESTS = {
    "tests/unit": ["apps/" + part + ".cpp" for part in ("ErrorLine", "FirstLook", "FrameOptionText", "Numbers", "Options",
                                                        "OutputFolder", "Outputs", "Progress", "Keywords", "Request")] + ["tests/support/TestScenes.cpp"],
    "python": ["apps/" + part + ".cpp" for part in ("BenchJob", "BenchRun", "Comparison", "FilterEnvironment", "FrameOptionText",
                                                    "Keywords", "OnePicture", "OutputFolder", "Outputs", "Planning", "Progress",
                                                    "Request")] + ["viewer/save/OptionText.cpp"],
    "tests/image": ["tests/support/TestScenes.cpp", "tests/support/CullingScenes.cpp"],
    "tests/cli/program": ["tests/support/Process.cpp"],
    "tests/viewer": ["tests/support/Process.cpp"],
}
NAMESPACE = re.compile(r"(?:inline )?namespace ([\w:]*) ?\{$")
END = re.compile(r"\} // namespace")
TYPE = re.compile(r"(?:struct|class|union|enum(?: class)?) (\w+)\b(?!;)")
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)
FUNCTION = re.compile(r"(?!\w+:(?!:)|TEST|INSTANTIATE|using |template|return )[\w:<>,&*\[\] ]+?[ &*](\w+)\((.*)")
VALUE = re.compile(r"(?:static |inline )?(?:constexpr|const) [\w:<>,&* ]+?[ &*](\w+)(?:\[[^\]]*\])*\s*(?:=|\{)")


def namesIn(text):
    """(line, enclosing namespaces, name) of what a source defines in anonymous namespaces; a function's name ends in its
    parameters."""
    stack = []
    lines = RAW_STRING.sub(lambda found: "\n" * found.group().count("\n"), text).splitlines()
    for number, line in enumerate(lines, 1):
        opened = NAMESPACE.match(line)
        if opened:
            stack.append(opened.group(1))
        elif END.match(line) and stack:
            stack.pop()
        elif "" in stack and line[:1] not in (" ", "}", "/", "#", ""):
            whole = " ".join([line] + [more.strip() for more in lines[number:number + 6]])
            found = TYPE.match(line)
            if found:
                yield number, "::".join(stack), found.group(1)
            elif VALUE.match(line):
                yield number, "::".join(stack), VALUE.match(line).group(1)
            elif FUNCTION.match(whole) and not re.match(r"[^{;]*\);", whole):  # a declaration is no definition
                function = FUNCTION.match(whole)
                yield number, "::".join(stack), f"{function.group(1)}({parameterTypes(function.group(2))})"


def parameterTypes(text):
    """What a parameter list that begins `text` takes, without the names and defaults."""
    depth, at = 1, 0
    while at < len(text) and depth:
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        at += 1
    parameters = re.sub(r"<[^<>]*>", "", text[:at - 1]).split(",") if at > 1 else []
    return ",".join(re.sub(r"\s*\w+(\[\])?$", "", parameter.split("=")[0].strip()) for parameter in parameters)


def targetsOf(path):
    """The targets that a source is compiled into."""
    home = max((target for target in TARGETS if path.startswith(target + "/")), key=len, default=None)
    return ([home] if home else []) + [target for target, guests in GUESTS.items() if path in guests]


def faultsOf(files):
    """Messages on {path: text}, paths relative to the repository's root."""
    places = collections.defaultdict(dict) # of each name, by file
    for path, text in sorted(files.items()):
        if path.endswith(".cpp"):
            for number, where, name in namesIn(text):
                for target in targetsOf(path):
                    places[target, where, name].setdefault(path, number)
    messages = []
    for (_, _, name), found in places.items():
        (path, number), *others = found.items()
        messages += [f"{other}:{otherNumber}: {name} has the name of that of {path}:{number}, which may be compiled in one batch with it"
                     for other, otherNumber in others]
    return messages


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    messages = faultsOf({file.relative_to(root).as_posix(): file.read_text(encoding="utf-8") for file in sourcesOf(root)})
    print("\n".join(messages), end="\n" if messages else "")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
