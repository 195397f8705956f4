"""check_batches.py ROOT: sources that are compiled in one batch never define a name twice.

CMake compiles twelve sources of a target as one (CMAKE_UNITY_BUILD), and which twelve changes with every new file. So what stands
in an anonymous namespace must have a name of its own in its target, but for functions that differ in what they take.
"""

import collections
import pathlib
import re
import sys

from sources import sourcesOf

# Folders whose sources form one target each; the longest match for a file counts.
TARGETS = ("apps", "base", "engine", "passes", "python", "renderer", "scenes", "shaders", "validation", "viewer", "tests/unit", "tests/gpu", "tests/image",
           "tests/cli/program", "tests/viewer")
# Files that add sources of other folders to a target.
LISTS = ("python/CMakeLists.txt", "tests/CMakeLists.txt")
STATEMENT = re.compile(r"(foreach|endforeach|target_sources|tessera_test)\(([^)]*)\)")
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
            elif FUNCTION.match(whole) and not re.match(r"[^{;]*\);", whole):  # skips declarations
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


def guestsOf(lists):
    """{folder of a target: sources of other folders that it takes} of {path of a CMakeLists.txt: its text}."""
    guests = collections.defaultdict(set)
    for path, text in lists.items():
        here, homes, loops = pathlib.PurePath(path).parent, {}, []
        for statement, words in STATEMENT.findall(re.sub(r"#.*", "", text)):
            first, *rest = words.split() or [""]
            if statement == "foreach":
                loops.append((first, rest))
            elif statement == "endforeach":
                loops.pop()
            elif statement == "tessera_test":  # arguments: name, label, folder
                homes[first] = here / rest[1]
            else:
                for source in rest[1:]:  # after PRIVATE
                    values = next((values for variable, values in loops if "${%s}" % variable in source), [""])
                    for value in values:
                        whole = re.sub(r"\$\{(?!PROJECT_SOURCE_DIR)\w+\}", value, source)
                        found = whole.removeprefix("${PROJECT_SOURCE_DIR}/")
                        guests[str(homes.get(first, here))].add(found if found != whole else str(here / whole))
    return guests


def targetsOf(path, guests):
    """The targets that a source is compiled into."""
    home = max((target for target in TARGETS if path.startswith(target + "/")), key=len, default=None)
    return ([home] if home else []) + [target for target, taken in guests.items() if path in taken]


def faultsOf(files, guests):
    """Messages on {path: text}, paths relative to the repository's root. `guests` is what guestsOf() says."""
    places = collections.defaultdict(dict) # line of each name, by file
    for path, text in sorted(files.items()):
        if path.endswith(".cpp"):
            for number, where, name in namesIn(text):
                for target in targetsOf(path, guests):
                    places[target, where, name].setdefault(path, number)
    messages = []
    for (_, _, name), found in places.items():
        (path, number), *others = found.items()
        messages += [f"{other}:{otherNumber}: {name} has the name of that of {path}:{number}, which may be compiled in one batch with it"
                     for other, otherNumber in others]
    return messages


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    guests = guestsOf({path: (root / path).read_text(encoding="utf-8") for path in LISTS})
    messages = faultsOf({file.relative_to(root).as_posix(): file.read_text(encoding="utf-8") for file in sourcesOf(root)}, guests)
    print("\n".join(messages), end="\n" if messages else "")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
