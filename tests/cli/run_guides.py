"""Does what the guides say, on a copy of the repository: applies their patches, builds the program and uses it.

    run_guides.py SOURCE_DIR CMAKE WORK_DIR
    run_guides.py SOURCE_DIR: only whether pages and patches agree, and each patch still fits without a guess

A guide is a page docs/add-a-*.md with a patch in docs/guides. All patches are applied to one copy, which is built once.
Then the guide's ```console blocks are run, with the scene that SCENES gives for it, and what a newcomer would look for is
checked.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

# Patch: page, maximum of new files, maximum of files in all.
PATCHES = {
    "vignette": ("add-a-pass.md", 3, 6),
    "deferred_prepass": ("add-a-technique.md", 0, 2),
    "oren_nayar": ("add-a-material-model.md", 0, 5),
    "cosine_light": ("add-a-light-type.md", 0, 4),
    "pillars_scene": ("add-a-scene.md", 1, 3),
}
# The first patch contains a setting, in these files:
SETTING_FILES = {"renderer/frame/FrameSettings.h", "engine/FrameSettingRows.cpp"}


def fail(message):
    sys.exit(f"run_guides.py: {message}")


def filesOf(patch):
    """(all files, new files) of a patch."""
    text = patch.read_text()
    return (set(re.findall(r"^diff --git a/(\S+) ", text, re.M)),
            set(re.findall(r"^diff --git a/(\S+) .*\nnew file mode", text, re.M)))


def checkPage(page, patch):
    """Every line of the page's C++ and GLSL blocks that stand in sections before `See it` or `Look` is in the patch."""
    added = {line[1:].strip() for line in patch.read_text().splitlines() if line[:1] in ("+", " ")}
    inside, missing = False, []
    for line in page.read_text().splitlines():
        if line.startswith("## ") and re.search(r"See it|Look|Tests", line):
            break
        if line.startswith("```"):
            inside = line[3:] in ("cpp", "glsl")
        elif inside and line.strip() and line.strip() not in added:
            missing.append(line)
    return missing


def checkPatches(source):
    for name, (page, mostNew, mostFiles) in PATCHES.items():
        patch = source / "docs/guides" / f"{name}.patch"
        files, new = filesOf(patch)
        if len(new) > mostNew or len(files) > mostFiles:
            fail(f"{name} takes {len(new)} new files and {len(files)} in all; {mostNew} and {mostFiles} are promised")
        missing = checkPage(source / "docs" / page, patch)
        if missing:
            fail(f"{page} shows what {name}.patch does not do:\n" + "\n".join(missing))
    listed = {patch.stem for patch in (source / "docs/guides").glob("*.patch")}
    if listed != set(PATCHES):
        fail(f"docs/guides holds {sorted(listed)}, the table {sorted(PATCHES)}")
    if not SETTING_FILES <= filesOf(source / "docs/guides/vignette.patch")[0]:
        fail("the setting is no part of vignette.patch")


def build(source, cmake, work):
    copy = work / "source"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    built = {"build", "out", ".git"}
    shutil.copytree(source, copy, ignore=lambda folder, names: built & set(names) if pathlib.Path(folder) == source else [])
    for name in PATCHES:
        # Patches of two guides may change neighbouring rows of one table.
        run(["patch", "-p1", "--no-backup-if-mismatch", "-i", str(source / "docs/guides" / f"{name}.patch")], copy)
    launcher = []
    if shutil.which("ccache"):
        launcher = ["-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
    run([cmake, "--preset", "release", "-DTESSERA_TESTS=OFF", *launcher], copy)
    run([cmake, "--build", "build/release", "--target", "tessera_program"], copy)
    return copy / "build/release/apps/tessera"


def run(command, folder, expect=0):
    result = subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            stdin=subprocess.DEVNULL)
    if result.returncode != expect:
        fail(f"{' '.join(map(str, command))}: exit code {result.returncode}\n{result.stdout}")
    return result.stdout


SCENES = {
    "add-a-material-model.md": {"tessera": 1, "base": {"file": "builtin:spheres"}, "materials": [
        {"replaces": 1, "name": "clay", "model": "oren_nayar", "k_d": [0.7, 0.4, 0.3], "sigma": 0.5}]},
    "add-a-light-type.md": {"tessera": 1, "base": {"file": "builtin:spheres"}, "lights": [
        {"type": "cosine", "position": [2, 5, 4], "target": [0, 0, 0], "intensity": 90, "spread": 0.2}]},
}


def runGuide(page, program, folder):
    folder.mkdir()
    if page.name in SCENES:
        (folder / "scene.json").write_text(json.dumps(SCENES[page.name]))
    inside, ran = False, 0
    for line in page.read_text().splitlines():
        if line.startswith("```"):
            inside = line == "```console"
        elif inside:
            words = line.replace("./run", str(program), 1).split()
            run(words, folder)
            ran += 1
    if ran == 0:
        fail(f"{page.name} has no console block")


def checkVignette(program, folder):
    for strength in ("0", "0.5"):
        run([program, "render", "room", "-o", f"{strength}.png", "--size", "64x36", "--vignette-strength", strength], folder)
        listed = "vignette" in run([program, "plan", "room", "--vignette-strength", strength], folder)
        if listed != (strength != "0"):
            fail(f"plan lists the pass wrongly at strength {strength}")
    run([program, "render", "room", "-o", "plain.png", "--size", "64x36"], folder)
    plain = (folder / "plain.png").read_bytes()
    if plain != (folder / "0.png").read_bytes():
        fail("a strength of 0 changes the picture")
    if plain == (folder / "0.5.png").read_bytes():
        fail("a strength of 0.5 does not change the picture")


def main():
    source = pathlib.Path(sys.argv[1])
    checkPatches(source)
    if len(sys.argv) == 2:
        for name in PATCHES:
            run(["patch", "-p1", "-F0", "--dry-run", "-i", str(source / "docs/guides" / f"{name}.patch")], source)
        return
    cmake, work = sys.argv[2], pathlib.Path(sys.argv[3])
    program = build(source, cmake, work)
    for page, *_ in PATCHES.values():
        runGuide(source / "docs" / page, program, work / page)
    runGuide(source / "docs/add-a-setting.md", program, work / "add-a-setting.md")
    (work / "vignette").mkdir()
    checkVignette(program, work / "vignette")
    shutil.rmtree(work)


if __name__ == "__main__":
    main()
