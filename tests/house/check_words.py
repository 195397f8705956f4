"""check_words.py ROOT: comments, documents, names and messages use the field's terms, not words that this project once
coined for them.

In documents, code blocks and text between backticks are free.
"""

import pathlib
import re
import sys

from sources import sourcesOf

# What stands for each: the word of the field, or the noun that the sentence is about.
TERMS = {
    r"told|tells?": "reported, returns, prints or warns: things do not speak",
    r"asked|asks": "requested, read or used: things do not speak",
    r"knows|nobody": "has, stores, or the condition itself",
    r"heeds?|heeded|unheeded": "is affected by, reads, uses; ignored",
    r"leeway": "tolerance",
    r"wish|wishe[sd]": "requested options, requested",
    r"of what|of whom": "the noun",
    r"whoever": "the caller, the user: the noun",
}
SPLIT = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|_")
WORD = {term: re.compile(rf"\b(?:{words})\b", re.IGNORECASE) for words, term in TERMS.items()}
SUFFIXES = (".h", ".cpp", ".glsl", ".vert", ".frag", ".geom", ".comp")
QUOTED = re.compile(r"`[^`]*`|\"[^\"]*\"|\]\([^)]*\)|\b\w+::\w+(?:::\w+)*|\w+\(\)")
OF_WHAT = re.compile(r"\bof (?:what|whom)\b", re.IGNORECASE)  # checked in prose alone
OWN = ("tests/house/check_words.py", "tests/house/checks_test.py")
COMMENT = re.compile(r'R"([^(]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(//[^\n]*|/\*.*?\*/)', re.DOTALL)


def commentsOf(text):
    """(line, comment) of C++ or GLSL."""
    for match in COMMENT.finditer(text):
        if match.group(2):
            yield text.count("\n", 0, match.start()) + 1, match.group(2)


def proseOf(text):
    """(line, text) of a Markdown document, without its blocks of code."""
    isCode = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            isCode = not isCode
        elif not isCode:
            yield number, line


def wordsOf(text):
    """(line, words) of names, strings and comments of code: the words of fooBar and foo_bar are foo and bar."""
    for number, line in enumerate(text.splitlines(), 1):
        yield number, SPLIT.sub(" ", line)


def faultsOf(path, parts, isFree=QUOTED):
    for number, text in parts:
        for term, word in WORD.items():
            found = word.search(isFree.sub(" ", text))
            if found:
                yield f"{path}:{number}: '{found.group(0)}'; write {term}"


def main(root):
    documents = [root / "README.md", root / "CHANGELOG.md", *sorted((root / "docs").glob("*.md"))]
    faults = [fault for path in sourcesOf(root, SUFFIXES)
              for fault in faultsOf(path.relative_to(root), commentsOf(path.read_text()))]
    faults += [fault for path in sourcesOf(root, (*SUFFIXES, ".py")) if str(path.relative_to(root)) not in OWN
               for fault in faultsOf(path.relative_to(root), wordsOf(path.read_text()), OF_WHAT)]
    faults += [fault for path in documents for fault in faultsOf(path.relative_to(root), proseOf(path.read_text()))]
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
