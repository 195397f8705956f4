"""Runs the commands of a document: every line of its ```sh blocks, in order, in an empty folder of its own.

    run_document.py DOCUMENT PROGRAM [SIZE]

`tessera` and ./run are the already built PROGRAM; the repository's folders stand there by name, for commands that read
them. With SIZE, WIDTHxHEIGHT, commands that request pictures of more pixels get that size instead. ./run alone makes the
demonstration in a small size. Blocks marked otherwise (```console, ```text, ...) show output and are not run.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Commands in documents that are not run here: pattern of the whole command, reason.
EXCEPTIONS = [
    (r"\./test\b.*", "runs the tests, of which this is one"),
    (r"cmake --(preset|build|install)\b.*", "builds the project again"),
    (r"\./run package", "makes packages of the finished build, as a test of its own does"),
    (r"(ninja|ctest)\b.*", "builds or tests the project again"),
    (r"(sudo )?apt-get .*", "changes the machine"),
    (r"(git clone|pip install|vcpkg) .*", "needs a network"),
    (r"\./run python\b.*", "builds the Python module, whose tests run what the documents show of it"),
    (r"(\./run|tessera) view\b.*", "opens a window and waits for its user"),
]

TIMEOUT_SECONDS = 300


def commandsOf(text):
    """(line number, command) of every line of the text's ```sh blocks; lines continued by a backslash are one."""
    commands = []
    inside = False
    start, command = 0, ""
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"\s*```(.*)", line)
        if fence:
            if command:
                raise SystemExit(f"line {start}: the block ends within a command")
            inside = not inside and fence.group(1).strip() == "sh"
            continue
        if not inside:
            continue
        if not command:
            start = number
        command += line.strip()
        if command.endswith("\\"):
            command = command[:-1]
            continue
        if command and not command.startswith("#"):
            commands.append((start, command))
        command = ""
    return commands


def exceptionOf(command):
    """Why the command is not run, or None."""
    for pattern, reason in EXCEPTIONS:
        if re.fullmatch(pattern, re.sub(r"\s+#.*", "", command)):
            return reason
    return None


def limited(command, size):
    """The command with no `--size` of more pixels than `size`, which is text, or None for any."""
    def pixels(text):
        width, height = text.split("x")
        return int(width) * int(height)
    if size is None:
        return command
    return re.sub(r"--size (\d+x\d+)",
                  lambda found: found.group() if pixels(found.group(1)) <= pixels(size) else f"--size {size}", command)


def prepare(folder, root, program, size):
    """The repository as a reader sees it, with the built program behind ./run; the demonstration in a small size."""
    for entry in root.iterdir():
        if entry.is_dir() and entry.name not in ("build", "out") and not entry.name.startswith("."):
            (folder / entry.name).symlink_to(entry)
    (folder / ".bin").mkdir()
    (folder / ".bin" / "tessera").symlink_to(program)
    run = folder / "run"
    demonstration = limited("demo -o out --size 320x180", size)
    run.write_text(f'#!/bin/sh\n[ $# -gt 0 ] || set -- {demonstration}\nexec "{program}" "$@"\n')
    run.chmod(0o755)


def main():
    document, program = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    size = sys.argv[3] if len(sys.argv) > 3 else None
    root = pathlib.Path(__file__).resolve().parents[2]
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, root, program, size)
        environment = dict(os.environ, PATH=f"{folder}/.bin:{os.environ['PATH']}")
        # With a display ./run would open the viewer and wait.
        for variable in ("DISPLAY", "WAYLAND_DISPLAY"):
            environment.pop(variable, None)
        for number, command in commandsOf(document.read_text()):
            where = f"{document.name}:{number}: {command}"
            reason = exceptionOf(command)
            if reason:
                print(f"{where}\n    not run: {reason}")
                continue
            print(where, flush=True)
            try:
                result = subprocess.run(["bash", "-c", limited(command, size)], cwd=folder, env=environment, text=True,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        timeout=TIMEOUT_SECONDS)
                code, output = result.returncode, result.stdout
            except subprocess.TimeoutExpired:
                code, output = f"none within {TIMEOUT_SECONDS} s", ""
            if code != 0:
                failures += 1
                print(f"    FAILED, exit code {code}\n{output}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
