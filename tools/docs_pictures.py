#!/usr/bin/env python3
"""Draws pictures of the documents anew: those of the table below, into docs/images; and `thumbnails`, those that the viewer
shows of the built-in scenes, into viewer/thumbnails.

Usage: tools/docs_pictures.py [NAME]... [--program build/release/apps/tessera] [--into FOLDER]

A picture is panels, at most five in a row, each a call of `tessera render`. Panels are drawn at twice their size and
averaged, so that edges are smooth. Models of Khronos are read from the folder TESSERA_ASSETS; without it their pictures
are left out. Needs ImageMagick (Debian: imagemagick).
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ASSETS = os.environ.get("TESSERA_ASSETS")
GAP_PIXELS = 4
MOST_COLUMNS = 5


def light(name, type_, position, target, colour, intensity, cones, radius):
    """A light that casts shadows with a penumbra; cones in degrees."""
    return {"name": name, "type": type_, "position": position, "color": colour, "intensity": intensity, "radius": radius,
            "castsShadow": True, **({"target": target, "innerDegrees": cones[0], "outerDegrees": cones[1]} if cones else {})}


# The lights of head and head_skin, with a radius, so that shadows on faces have soft edges.
FACE = [0, 0.56, 0]
SKIN_LIGHTS = [light("key", "spot", [-0.95, 1.05, 1.1], FACE, [1, 0.9, 0.78], 3.4, (12, 26), 0.08),
               light("back", "spot", [0.62, 0.78, -0.8], FACE, [1, 0.84, 0.66], 4.5, (12, 24), 0.05),
               light("fill", "point", [1.4, 0.75, 1.5], None, [0.5, 0.66, 1], 0.55, None, 0.2),
               light("backdrop", "spot", [-0.2, 2.3, 0], [-0.25, 0.75, -1.4], [0.55, 0.66, 0.8], 3.0, (8, 56), 0.05)]


def skin(**members):
    return {"tessera": 1, "base": {"file": "builtin:head_skin"}, "lights": SKIN_LIGHTS, **members}


def sick():
    """scenes/files/head_sick.json with soft shadows."""
    scene = json.loads((ROOT / "scenes/files/head_sick.json").read_text())
    scene["hook"]["file"] = str(ROOT / "scenes/files/head_sick.glsl")
    return {**scene, "lights": SKIN_LIGHTS}


def model(name):
    """The file of a Khronos model, in the folder of its name."""
    return next(pathlib.Path(ASSETS, name).glob(f"{name}.gl*"))


SOFT = ["--shadow-samples", "16"]
CLOSE = ["--camera", "close", *SOFT]
BUST = ["--target", "0,0.49,0", "--fov", "15.5"]

# name: (size of a panel, quality of the JPEG, panels as (scene, options of render))
PICTURES = {
    "skin-methods": ((400, 480), 88, [(skin(), [*CLOSE, "--subsurface", method]) for method in
                                      ("none", "wrap", "depth_map", "texture_space_diffusion")]
                     + [(skin(), [*CLOSE, "--technique", "reference"])]),
    "head-sick": ((450, 495), 90, [(sick(), ["--time", time, *SOFT]) for time in ("0", "4.5", "9")]),
    "shadow-filters": ((480, 504), 90, [("head", [*BUST, *filter_]) for filter_ in (
        ["--shadow-filter", "traced"], ["--shadow-filter", "hard", "--shadow-resolution", "512"],
        ["--shadow-filter", "pcf", "--shadow-resolution", "512", "--shadow-width", "7"])]),
    "lamps": ((1280, 720), 88, [("lamps", ["--shadows", "none"])]),
    "flag": ((300, 225), 90, [(str(ROOT / "scenes/files/flag.json"), ["--camera", "near", "--time", time]) for time in
                              ("0", "0.35", "0.7", "1.05")]),
    "python": ((400, 225), 90, [("hall", ["--view", view]) for view in ("final", "depth", "normal")]),
}
if ASSETS:
    PICTURES |= {
        "fox": ((240, 200), 90, [(model("Fox"), ["--clip", "Run", "--time", time]) for time in
                                 ("0", "0.15", "0.3", "0.45", "0.6")]),
        # Only models that their authors gave to the public domain.
        "khronos-models": ((400, 300), 86, [(model(name), []) for name in (
            "WaterBottle", "ToyCar", "SheenCloth", "AnisotropyStrengthTest", "MetalRoughSpheresNoTextures", "TransmissionTest",
            "NormalTangentTest", "TextureEncodingTest")]),
    }


def thumbnails(program, folder):
    """256x144 of every built-in scene, without models of TESSERA_ASSETS, which others do not have."""
    environment = {name: value for name, value in os.environ.items() if name != "TESSERA_ASSETS"}
    listed = subprocess.run([program, "scenes"], check=True, text=True, stdout=subprocess.PIPE, env=environment).stdout
    with tempfile.TemporaryDirectory() as scratch:
        for scene in (line.split()[0] for line in listed.splitlines()[1:]):
            picture = pathlib.Path(scratch) / "large.png"
            subprocess.run([program, "render", scene, "-o", picture, "--size", "1024x576"], check=True, env=environment)
            subprocess.run(["convert", picture, "-resize", "256x144", "-quality", "88", "-strip", folder / f"{scene}.jpg"], check=True)


def draw(name, program, folder):
    (width, height), quality, panels = PICTURES[name]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        drawn = []
        for number, (scene, options) in enumerate(panels):
            if isinstance(scene, dict):
                file = scratch / "scene.json"
                file.write_text(json.dumps(scene))
                scene = str(file)
            picture = scratch / f"{number}.png"
            # The time of the reference is proportional to its pixels.
            factor = 1 if "reference" in options else 2
            size = f"{factor * width}x{factor * height}"
            subprocess.run([program, "render", scene, "-o", picture, "--size", size, *options], check=True)
            drawn.append(picture)
        columns = len(drawn) if len(drawn) <= MOST_COLUMNS else 4
        subprocess.run(["montage", *drawn, "-resize", f"{width}x{height}!", "-tile", f"{columns}x", "-background", "black",
                        "-geometry", f"+{GAP_PIXELS // 2}+{GAP_PIXELS // 2}", "-quality", str(quality), folder / f"{name}.jpg"],
                       check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Pictures: " + ", ".join([*PICTURES, "thumbnails"]))
    parser.add_argument("names", nargs="*", metavar="NAME", help="which ones (all)")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/apps/tessera")
    parser.add_argument("--into", type=pathlib.Path, metavar="FOLDER", help="instead of those folders")
    options = parser.parse_args()
    known = [*PICTURES, "thumbnails"]
    unknown = [name for name in options.names if name not in known]
    if unknown:
        sys.exit(f"no picture is called '{unknown[0]}'; valid are {', '.join(known)}")
    if not options.program.exists():
        sys.exit(f"{options.program} is not there; build it by ./run, or name another with --program")
    program = options.program.resolve()
    for name in options.names or known:
        print(name, flush=True)
        if name == "thumbnails":
            thumbnails(program, options.into or ROOT / "viewer/thumbnails")
        else:
            draw(name, program, options.into or ROOT / "docs/images")


if __name__ == "__main__":
    main()
