#!/usr/bin/env python3
"""Renders every glTF model of a folder once and writes a sheet of pictures and the table of docs/khronos-models.md.

Usage: tools/khronos_models.py FOLDER OUTPUT [--program build/release/apps/tessera] [--size 480x270]
                               [--leave-out PATTERN]... [--document docs/khronos-models.md]
                               [--expect docs/khronos-models.md]

Of each model one file is shown, as it is without options: lit by the built-in studio, from the supplied camera, or by
and from what the model brings. How the supplied camera frames it is judged of each: one with cameras of its own is
looked at by --default-camera too. One that moves is shown at its begin, and looked at over the length of its first
clip. OUTPUT receives

  sheet.png    all pictures with their names, by the tone map khronos_neutral
  table.md     model, status (right, approximate, refused, crashed or nothing to draw), figures and why
  models.csv   the figures: mean luminance of the covered pixels in the picture that is shown, and the shares of them
               that are black and burnt; share of the width or height, whichever is more, that they span in the supplied
               camera's; whether they touch its edge; whose camera the shown one is by; seconds; warnings

With --document the table, and below it the totals, replace what stands between the two markers of that file. A model's
status follows from the extensions it uses, by EXTENSIONS below, and from what the program says. Ends with exit code 1
where a model crashes, is black or covers nothing, is black or burnt in more than half of its pixels, or is too small or
cut off in the supplied camera, and with --expect
where one is no longer drawn that the table of that file says is. Only Python's own library is needed.
"""
import argparse
import array
import collections
import csv
import fnmatch
import io
import itertools
import json
import math
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

RIGHT, APPROXIMATE, REFUSED, CRASHED, NOTHING = "right", "approximate", "refused", "crashed", "nothing to draw"

# How each extension is drawn. Others are left out, with a warning of the program.
EXTENSIONS = {
    "EXT_lights_image_based": (RIGHT, "filtered anew from its sharpest faces"),
    "EXT_mesh_gpu_instancing": (RIGHT, ""),
    "EXT_meshopt_compression": (RIGHT, ""),
    "EXT_texture_webp": (RIGHT, ""),
    "FAKE_materials_quantumRendering": (RIGHT, "no such extension: left out, and said"),
    "KHR_animation_pointer": (RIGHT, ""),
    "KHR_node_visibility": (RIGHT, "clips of it are left out, and said"),
    "KHR_draco_mesh_compression": (RIGHT, ""),
    "KHR_lights_punctual": (RIGHT, ""),
    "KHR_materials_anisotropy": (APPROXIMATE, "stretched highlights of the environment are sums of sixteen look-ups"),
    "KHR_materials_clearcoat": (RIGHT, ""),
    "KHR_materials_diffuse_transmission": (APPROXIMATE, "nothing shines through but what its alpha lets pass"),
    "KHR_materials_dispersion": (APPROXIMATE, "three colours instead of a spectrum"),
    "KHR_materials_emissive_strength": (RIGHT, ""),
    "KHR_materials_ior": (RIGHT, ""),
    "KHR_materials_iridescence": (RIGHT, ""),
    "KHR_materials_pbrSpecularGlossiness": (RIGHT, "converted"),
    "KHR_materials_sheen": (APPROXIMATE, "a sheen sees the environment as a matte surface does"),
    "KHR_materials_specular": (RIGHT, ""),
    "KHR_materials_transmission": (APPROXIMATE, "glass casts no shadow and no caustics, and sorts as whole meshes"),
    "KHR_materials_unlit": (RIGHT, ""),
    "KHR_materials_variants": (RIGHT, "the first one"),
    "KHR_materials_volume": (APPROXIMATE, "bodies show opaque surfaces as the camera sees them, and no glass behind them"),
    "KHR_mesh_quantization": (RIGHT, ""),
    "KHR_texture_basisu": (RIGHT, "shown with the plain pictures beside it"),
    "KHR_texture_transform": (RIGHT, ""),
    "KHR_xmp": (RIGHT, "words about the model: left out, and said"),
    "KHR_xmp_json_ld": (RIGHT, "words about the model"),
}
SUPPLIED_CAMERA = "by the supplied camera"
FROM_INSIDE = "seen from inside " + SUPPLIED_CAMERA  # then there is no framing to judge
DEFAULT_CAMERA = "--default-camera"  # instead of the model's cameras
NO_TRIANGLES = "the scene has no triangles to draw"
BAD_INPUT = 2  # the program's exit code for files that it refuses
MOST_SECONDS = 900  # limit per image
BLACK = 0.02  # mean luminance after the exposure that the program chooses: a fifth of the studio's brightest walls
# Radiance that khronos_neutral maps to 0.02 of the code values (brightest channel) and to 0.98 (darkest channel).
DARK, BURNT = 0.0157, 1.87
MOST_LOST = 0.5  # fraction of the covered pixels that are either
LEAST_SPAN = 0.55  # least fraction of the image's width or height to span in the supplied camera
MOMENTS = 4  # times after the first at which an animated model is rendered
BEGIN, END = "<!-- made by tools/khronos_models.py: begin -->", "<!-- made by tools/khronos_models.py: end -->"
# Containers of the same model; the first existing one is rendered.
CONTAINERS = ("", "glTF", "glTF-Binary", "glTF-Embedded")


# ---- Models --------------------------------------------------------------------------------------------------------


def models_below(folder, left_out=()):
    """One file of each model, by name. Folders of Khronos' samples are NAME/glTF/NAME.gltf or NAME/NAME.glb."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() not in (".gltf", ".glb") or not path.is_file():
            continue
        above = path.relative_to(folder).parent.parts
        container = above[-1] if above and above[-1].startswith("glTF") else ""
        place = above[: -1 if container else None]
        rank = CONTAINERS.index(container) if container in CONTAINERS else len(CONTAINERS)
        found.setdefault((place, path.stem), []).append((rank, path))
    models = {}
    for (place, stem), files in sorted(found.items()):
        name = place[-1] if place and place[-1].startswith(stem) else stem
        if name in models:
            name = "/".join((*place, stem))
        name = name.encode("utf-8", "backslashreplace").decode()  # file names may be invalid text
        if not any(fnmatch.fnmatch(name, pattern) for pattern in left_out):
            models[name] = min(files)[1]
    return models


def document_of(path):
    """The JSON of a model; an empty one where it cannot be read, which the program reports better."""
    try:
        data = path.read_bytes()
        if data[:4] == b"glTF":
            data = data[20 : 20 + struct.unpack_from("<I", data, 12)[0]]
        document = json.loads(data)
        return document if isinstance(document, dict) else {}
    except (OSError, ValueError, RecursionError, struct.error):
        return {}


def extensions_of(document):
    """Those that a document says it uses."""
    used = document.get("extensionsUsed")
    return sorted(used) if isinstance(used, list) and all(isinstance(name, str) for name in used) else []


def times_of(document):
    """The seconds at which a model is looked at: its begin, and steps to the end of its first clip."""
    try:
        samplers = document["animations"][0]["samplers"]
        length = max(document["accessors"][sampler["input"]]["max"][0] for sampler in samplers)
        if not 0.0 < length < math.inf:
            return [0.0]
        return [length * step / MOMENTS for step in range(MOMENTS + 1)]
    except (KeyError, IndexError, TypeError, ValueError, OverflowError):
        return [0.0]


def status_of(extensions, code, lines):
    """The status of a model and why, from its extensions, the program's exit code and what it said. A negative code is
    that of a signal, None is too much time."""
    if code == BAD_INPUT:
        return REFUSED, lines[-1] if lines else f"exit code {code}"
    if code != 0:
        how = f"took more than {MOST_SECONDS} s" if code is None else f"exit code {code}"
        if code is not None and code < 0:
            how = f"signal {signal.Signals(-code).name}" if -code in set(signal.Signals) else f"signal {-code}"
        return CRASHED, "; ".join([how, *lines[-1:]])
    if any(NO_TRIANGLES in line for line in lines):
        return NOTHING, "; ".join(line for line in lines if "left out" in line)
    reasons = [EXTENSIONS[name] for name in extensions if name in EXTENSIONS]
    unknown = [(APPROXIMATE, f"{name} is left out") for name in extensions if name not in EXTENSIONS]
    said = [
        (APPROXIMATE, line)
        for line in lines
        if "the extension " not in line
    ]
    reasons += unknown + said
    status = APPROXIMATE if any(each == APPROXIMATE for each, _ in reasons) else RIGHT
    shown = [why for each, why in reasons if why and each == status]
    return status, "; ".join(dict.fromkeys(shown))


# ---- Figures -------------------------------------------------------------------------------------------------------

# Figures of the covered pixels: mean luminance in the shown image; by the supplied camera, over all times, the larger
# fraction of the image's sides that they span, and whether they touch the edge; whether the shown image is by the
# supplied camera; fractions of black and burnt pixels in the shown image.
Figures = collections.namedtuple("Figures", "luminance span is_cut is_supplied dark burnt", defaults=(0.0, 0.0))
# figures: None without an image; is_expected: the expected table lists the model as drawn.
Row = collections.namedtuple("Row", "name status why figures is_expected", defaults=(False,))


def percent(share):
    return f"{100.0 * share:.0f} %"


def figures_of(shown, framed, is_supplied):
    """Of the picture of one model at its begin, and those by the supplied camera at some moments."""
    boxes = [box for box in (picture.box() for picture in framed) if box]
    if not boxes:
        return Figures(shown.luminance(), 0.0, False, is_supplied, *shown.lost())
    width, height = framed[0].width, framed[0].height
    left, top = (min(box[side] for box in boxes) for side in (0, 1))
    right, bottom = (max(box[side] for box in boxes) for side in (2, 3))
    span = max((right - left + 1) / width, (bottom - top + 1) / height)
    is_cut = is_supplied != FROM_INSIDE and (left == 0 or top == 0 or right == width - 1 or bottom == height - 1)
    return Figures(shown.luminance(), span, is_cut, is_supplied, *shown.lost())


# Reasons why a model fails, by the name in the totals.
FAULTS = {
    "crashed": lambda row: row.status == CRASHED,
    "black": lambda row: is_drawn(row) and not row.figures.luminance >= BLACK,
    "over half black": lambda row: is_drawn(row) and row.figures.dark > MOST_LOST,
    "over half burnt": lambda row: is_drawn(row) and row.figures.burnt > MOST_LOST,
    f"framed under {percent(LEAST_SPAN)}": lambda row: is_judged(row) and row.figures.span < LEAST_SPAN,
    "cut off": lambda row: is_judged(row) and row.figures.is_cut,
    "no longer drawn": lambda row: row.is_expected and row.status in (REFUSED, NOTHING),
}


def is_drawn(row):
    return row.figures is not None and row.status != NOTHING


def is_judged(row):
    """Whether there is something to frame: what covers nothing in any picture is black."""
    return is_drawn(row) and max(row.figures.span, row.figures.luminance) > 0.0


def faults_of(row):
    return [name for name, is_fault in FAULTS.items() if is_fault(row)]


def totals_of(rows):
    """One line: how many models there are of each status, and of each fault."""
    counts = collections.Counter(row.status for row in rows)
    faults = collections.Counter(fault for row in rows for fault in faults_of(row))
    statuses = ", ".join(f"{counts[status]} {status}" for status in (RIGHT, APPROXIMATE, REFUSED, NOTHING))
    return f"{len(rows)} models: {statuses}; " + ", ".join(f"{faults[name]} {name}" for name in FAULTS)


def table_of(rows):
    def cell(text):
        return text.replace("|", "\\|").replace("\n", " ")

    def cells(row):
        if not is_drawn(row):
            return [""] * 4
        figures = row.figures
        camera = "supplied" if figures.is_supplied else "its own"
        return [f"{figures.luminance:.2g}", f"{percent(figures.span)}", "cut" if figures.is_cut else "free", camera]

    names = ["model", "status", "luminance", "share", "edge", "camera", "why"]
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    lines += ["| " + " | ".join([cell(row.name), row.status, *cells(row), cell(row.why)]) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def drawn_in(document):
    """The names of the models that the table of a document says are drawn."""
    lines = document.split(BEGIN)[-1].split(END)[0].splitlines()
    rows = [line.removeprefix("| ").split(" | ") for line in lines if line.startswith("| ")]
    return {row[0].replace("\\|", "|") for row in rows if len(row) > 1 and row[1] in (RIGHT, APPROXIMATE)}


def with_table(document, table):
    """A document with the table between its markers."""
    if document.count(BEGIN) != 1 or document.count(END) != 1:
        raise ValueError(f"must hold these two lines once each: {BEGIN} and {END}")
    before, after = document.split(BEGIN)[0], document.split(END)[1]
    return f"{before}{BEGIN}\n{table}{END}{after}"


# ---- Pictures ------------------------------------------------------------------------------------------------------


class Picture:
    """Planes of floats, by the channel's name, rows from the top."""

    def __init__(self, width, height, planes):
        self.width, self.height, self.planes = width, height, planes

    def covered(self):
        """Places of the pixels in which something is drawn, row by row."""
        return [i for i, a in enumerate(self.planes["A"]) if a > 0.5]

    def expose(self, stops):
        """As a display picture is, of which the file holds the radiance."""
        if stops != 0:
            for channel in "RGB":
                self.planes[channel] = [2.0**stops * value for value in self.planes[channel]]

    def luminance(self):
        """The mean over the covered pixels."""
        covered = self.covered()
        if not covered:
            return 0.0
        r, g, b = (self.planes[c] for c in "RGB")
        return sum(0.2126 * r[i] + 0.7152 * g[i] + 0.0722 * b[i] for i in covered) / len(covered)

    def lost(self):
        """Shares of the covered pixels that a display shows as black and as burnt: (black, burnt)."""
        covered = self.covered()
        values = [[self.planes[channel][i] for channel in "RGB"] for i in covered]
        pixels = max(len(covered), 1)
        return sum(max(rgb) < DARK for rgb in values) / pixels, sum(min(rgb) > BURNT for rgb in values) / pixels

    def box(self):
        """First and last covered pixel: left, top, right, bottom; None without any."""
        covered = self.covered()
        if not covered:
            return None
        columns = [i % self.width for i in covered]
        return min(columns), covered[0] // self.width, max(columns), covered[-1] // self.width

    def bytes(self):
        """RGB of 8 bits, sRGB, by the tone map of models. Source: Khronos 2024, "PBR Neutral Tone Mapper"."""

        def code(value):
            return round(255.0 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1.0 / 2.4) - 0.055))

        def codes(rgb):
            rgb = [min(max(value, 0.0), 1e9) if value == value else 0.0 for value in rgb]
            darkest = min(rgb)
            toe = darkest - 6.25 * darkest * darkest if darkest < 0.08 else 0.04
            rgb = [value - toe for value in rgb]
            peak = max(rgb)
            if peak >= 0.76:
                bent = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76)
                white = 1.0 - 1.0 / (0.15 * (peak - bent) + 1.0)
                rgb = [value * bent / peak * (1.0 - white) + bent * white for value in rgb]
            return map(code, rgb)

        return bytearray(itertools.chain.from_iterable(map(codes, zip(*(self.planes[channel] for channel in "RGB")))))


def read_exr(data):
    """Scan lines of 32-bit floats, plain or in ZIP blocks. Source: OpenEXR, "The OpenEXR File Layout"."""
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError("is no OpenEXR file")
    at, header = 8, {}
    while data[at] != 0:
        name, kind = (part.decode() for part in data[at:].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    at += 1
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names, rest = [], header["channels"]
    while rest[0] != 0:
        name, rest = rest.split(b"\0", 1)
        if struct.unpack_from("<i", rest)[0] != 2:
            raise ValueError("holds other numbers than 32-bit floats")
        names.append(name.decode())
        rest = rest[16:]
    compression = header["compression"][0]
    if compression not in (0, 2, 3):
        raise ValueError(f"has compression {compression}; none and ZIP are read")
    rows_each = 16 if compression == 3 else 1
    planes = {name: array.array("f", bytes(4 * width * height)) for name in names}
    for offset in struct.unpack_from(f"<{-(-height // rows_each)}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(rows_each, height - (y - top))
        block, whole = data[offset + 8 : offset + 8 + size], 4 * width * rows * len(names)
        if size < whole:
            block = zlib.decompress(block)
            # Each byte is the difference to the one before, plus 128; then the two halves alternate.
            block = bytes(b & 255 for b in itertools.accumulate(block, lambda last, b: last + b - 128))
            half, mixed = (len(block) + 1) // 2, bytearray(len(block))
            mixed[0::2], mixed[1::2] = block[:half], block[half:]
            block = bytes(mixed)
        for row in range(rows):
            for i, name in enumerate(names):
                begin = 4 * width * (row * len(names) + i)
                numbers = array.array("f", block[begin : begin + 4 * width])
                first = (y - top + row) * width
                planes[name][first : first + width] = numbers
    return Picture(width, height, planes)


def png_of(width, height, rgb):
    """Source: RFC 2083."""

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = b"".join(b"\0" + rgb[3 * width * y : 3 * width * (y + 1)] for y in range(height))
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


# Letters of 5 x 7 dots: columns from the left, the lowest bit at the top.
LETTERS = {
    " ": "0000000000", "-": "0808080808", "_": "4040404040", "/": "2010080402", ".": "0060600000",
    "0": "3e5149453e", "1": "00427f4000", "2": "4261514946", "3": "2141454b31", "4": "1814127f10",
    "5": "2745454539", "6": "3c4a494930", "7": "0171090503", "8": "3649494936", "9": "064949291e",
    "A": "7e1111117e", "B": "7f49494936", "C": "3e41414122", "D": "7f4141221c", "E": "7f49494941",
    "F": "7f09090901", "G": "3e4149497a", "H": "7f0808087f", "I": "00417f4100", "J": "2040413f01",
    "K": "7f08142241", "L": "7f40404040", "M": "7f020c027f", "N": "7f0408107f", "O": "3e4141413e",
    "P": "7f09090906", "Q": "3e4151215e", "R": "7f09192946", "S": "4649494931", "T": "01017f0101",
    "U": "3f4040403f", "V": "1f2040201f", "W": "3f4038403f", "X": "6314081463", "Y": "0708700807",
    "Z": "6151494543",
}  # fmt: skip
LINE = 12  # pixels of a name below its image


def sheet_of(pictures, size, columns=6):
    """(name, RGB or None) side by side, each above its name: width, height and RGB."""
    width, height = size
    columns = max(1, min(columns, len(pictures)))
    rows = -(-len(pictures) // columns)
    whole = columns * width
    sheet = bytearray(3 * whole * rows * (height + LINE))
    for number, (name, rgb) in enumerate(pictures):
        left, top = number % columns * width, number // columns * (height + LINE)
        if rgb is not None:
            for y in range(height):
                begin = 3 * ((top + y) * whole + left)
                sheet[begin : begin + 3 * width] = rgb[3 * width * y : 3 * width * (y + 1)]
        for i, letter in enumerate(name.upper()[: (width - 4) // 6]):
            for x, dots in enumerate(bytes.fromhex(LETTERS.get(letter, "7f4141417f"))):
                for y in range(7):
                    if dots >> y & 1:
                        begin = 3 * ((top + height + 3 + y) * whole + left + 2 + 6 * i + x)
                        sheet[begin : begin + 3] = b"\xe0\xe0\xe0"
    return whole, rows * (height + LINE), sheet


# ---- Files ---------------------------------------------------------------------------------------------------------


def write(path, data):
    """Whole or not at all."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_bytes(data if isinstance(data, bytes) else data.encode())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def csv_of(rows):
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue()


# ---- Program -------------------------------------------------------------------------------------------------------


def render(program, path, picture, size, *more):
    """Of a model, with more options: the exit code (None after MOST_SECONDS), the warnings without names of programs and
    files, what it says of a camera that it supplied, and the stops by which it exposes a display picture."""
    command = [str(program), "render", str(path), "-o", str(picture), "--size", f"{size[0]}x{size[1]}", *more]
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=MOST_SECONDS)
    except subprocess.TimeoutExpired:
        return None, [], None, 0
    lines = []
    for line in done.stderr.splitlines():
        line = line.strip()
        if line.startswith("tessera: note: "):  # about the machine's cache, not the model
            continue
        line = line.replace(str(path.parent) + "/", "")
        for prefix in ("tessera: ", "error: ", "warning: ", f"{path.stem}: ", f"{path.name}: "):
            line = line.removeprefix(prefix)
        if line:
            lines.append(line)
    exposed = re.search(r"exposed by ([+-]\d+) EV", done.stdout)
    supplied = next((said for said in (FROM_INSIDE, SUPPLIED_CAMERA) if said in done.stdout), None)
    return done.returncode, lines, supplied, int(exposed[1]) if exposed else 0


def look_at(name, program, path, picture, size):
    """The row of a model, its RGB at its begin or None, and what was said."""
    document = document_of(path)
    begin, *later = times_of(document)

    def look(seconds, *more):
        picture.unlink(missing_ok=True)
        if seconds > 0.0:
            more = ("--time", f"{seconds:g}", *more)
        code, lines, is_supplied, stops = render(program, path, picture, size, *more)
        seen = read_exr(picture.read_bytes()) if code == 0 else None
        if seen:
            seen.expose(stops)
        return code, lines, is_supplied, seen

    code, lines, is_supplied, shown = look(begin)
    said, framed = lines, [shown] if is_supplied else []
    for seconds in later if is_supplied else [begin, *later]:
        if code != 0:
            break
        code, lines, _, seen = look(seconds, *([] if is_supplied else [DEFAULT_CAMERA]))
        said = said or lines
        framed.append(seen)
    picture.unlink(missing_ok=True)
    extensions = extensions_of(document)
    if code != 0:
        return Row(name, *status_of(extensions, code, lines), None), None, lines
    return Row(name, *status_of(extensions, 0, said), figures_of(shown, framed, is_supplied)), shown.bytes(), said


def size_in(text):
    width, height = map(int, text.split("x"))
    return width, height


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    repository = pathlib.Path(__file__).resolve().parents[1]
    parser.add_argument("--program", type=pathlib.Path, default=repository / "build/release/apps/tessera")
    parser.add_argument("--size", type=size_in, default=(480, 270))
    parser.add_argument("--leave-out", action="append", default=[], metavar="PATTERN")
    parser.add_argument("--document", type=pathlib.Path)
    parser.add_argument("--expect", type=pathlib.Path)
    options = parser.parse_args(arguments)
    models = models_below(options.folder, options.leave_out)
    if not models:
        parser.error(f"{options.folder} holds no .gltf or .glb file")
    if not shutil.which(str(options.program)):
        parser.error(f"{options.program} is no program; build it with ./run scenes, or name another with --program")
    if options.document:
        with_table(options.document.read_text(encoding="utf-8"), "")  # fails before the work starts
    expected = drawn_in(options.expect.read_text(encoding="utf-8")) if options.expect else set()
    if options.expect and not expected:
        parser.error(f"{options.expect} holds no table in which a model is drawn")
    options.output.mkdir(parents=True, exist_ok=True)
    rows, records, pictures = [], [], []
    with tempfile.TemporaryDirectory(prefix=".models-", dir=options.output) as own:
        for number, (name, path) in enumerate(models.items(), 1):
            start = time.monotonic()
            row, rgb, said = look_at(name, options.program, path, pathlib.Path(own) / "model.exr", options.size)
            row = row._replace(is_expected=name in expected)
            seconds = time.monotonic() - start
            figures = [""] * 6
            if row.figures:
                figures = [f"{row.figures.luminance:.4f}", f"{row.figures.dark:.3f}", f"{row.figures.burnt:.3f}"]
                figures += [f"{row.figures.span:.3f}", int(row.figures.is_cut)]
                figures.append("supplied" if row.figures.is_supplied else "its own")
            rows.append(row)
            records.append((name, row.status, *figures, f"{seconds:.2f}", " / ".join(said)))
            pictures.append((name, rgb))
            faults = "".join(f", {fault}" for fault in faults_of(row) if fault != row.status)
            print(f"{number}/{len(models)} {name}: {row.status}{faults}, {seconds:.1f} s", flush=True)
    write(options.output / "sheet.png", png_of(*sheet_of(pictures, options.size)))
    totals = totals_of(rows)
    table = table_of(rows)
    write(options.output / "table.md", table)
    names = ("model", "status", "mean luminance", "black", "burnt", "span", "cut", "camera", "seconds", "warnings")
    write(options.output / "models.csv", csv_of([names, *records]))
    if options.document:
        below = totals.replace("; ", ";\n")
        write(options.document, with_table(options.document.read_text(encoding="utf-8"), f"{table}\n{below}.\n"))
    print(totals)
    bad = [row for row in rows if faults_of(row)]
    for row in bad:
        figures = row.figures and f"luminance {row.figures.luminance:.4f}, spans {row.figures.span:.3f}"
        print(f"{row.name}: {', '.join(faults_of(row))}: {figures or row.why}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
