"""tools/khronos_models.py on small models and a stand-in for the program."""

import array
import contextlib
import csv
import io
import json
import pathlib
import re
import shutil
import struct
import sys
import tempfile
import unittest
import zlib

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
import khronos_models as tool  # noqa: E402


def exr(width, height, value, compression):
    """value(channel, x, y) of A, B, G and R. Source: OpenEXR, "The OpenEXR File Layout"."""
    names = "ABGR"

    def attribute(name, kind, content):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(content)) + content

    channels = b"".join(f"{name}\0".encode() + struct.pack("<4i", 2, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = b"\x76\x2f\x31\x01\x02\0\0\0" + attribute("channels", "chlist", channels)
    head += attribute("compression", "compression", bytes([compression])) + attribute("dataWindow", "box2i", window) + b"\0"
    rows_each = 16 if compression == 3 else 1
    blocks = []
    for top in range(0, height, rows_each):
        numbers = array.array("f")
        for y in range(top, min(top + rows_each, height)):
            for name in names:
                numbers.extend(value(name, x, y) for x in range(width))
        block = numbers.tobytes()
        if compression:
            halves = block[0::2] + block[1::2]
            halves = bytes((b - a + (128 if i else 0)) & 255 for i, (a, b) in enumerate(zip(b"\0" + halves, halves)))
            packed = zlib.compress(halves)
            block = packed if len(packed) < len(block) else block
        blocks.append(struct.pack("<2i", top, len(block)) + block)
    offsets, at = b"", len(head) + 8 * len(blocks)
    for block in blocks:
        offsets += struct.pack("<Q", at)
        at += len(block)
    return head + offsets + b"".join(blocks)


def pixels_of(png):
    """Width, height and RGB rows of a PNG whose rows have no filter."""
    width, height = struct.unpack_from(">2I", png, 16)
    begin = png.index(b"IDAT") + 4
    (size,) = struct.unpack_from(">I", png, begin - 8)
    rows = zlib.decompress(png[begin : begin + size])
    step = 3 * width + 1
    assert all(rows[y * step] == 0 for y in range(height))
    return width, height, [rows[y * step + 1 : (y + 1) * step] for y in range(height)]


class KhronosModels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def model(self, name, extensions=(), glb=False):
        path = self.folder / "models" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        text = json.dumps({"asset": {"version": "2.0"}, "extensionsUsed": list(extensions)}).encode()
        if glb:
            text = b"glTF" + struct.pack("<4I", 2, 20 + len(text), len(text), 0x4E4F534A) + text
        path.write_bytes(text)
        return path

    def test_one_file_of_each_model_is_shown(self):
        plain = self.model("Box/glTF/Box.gltf")
        self.model("Box/glTF-Binary/Box.glb", glb=True)
        self.model("Box/glTF-Draco/Box.gltf")
        binary = self.model("Duck/glTF-Binary/Duck.glb", glb=True)
        flat = self.model("Fox.glb", glb=True)
        quantized = self.model("Cube-Quantized/Cube.gltf")
        cube = self.model("Cube/Cube.gltf")
        models = {"Box": plain, "Duck": binary, "Fox": flat, "Cube": cube, "Cube-Quantized": quantized}
        self.assertEqual(tool.models_below(self.folder / "models"), models)
        del models["Cube"], models["Cube-Quantized"]
        self.assertEqual(tool.models_below(self.folder / "models", ["Cube*"]), models)

    def test_extensions_are_read_of_both_containers_and_of_broken_files_none(self):
        used = ["KHR_materials_unlit", "EXT_texture_webp"]
        for glb in (False, True):
            self.assertEqual(tool.extensions_of(self.model("a.glb", used, glb)), sorted(used))
        for broken in (b"", b"glTF", b"glTF" + bytes(30), b"{", b"[]", b'{"extensionsUsed": [1, "a"]}'):
            path = self.model("b.gltf")
            path.write_bytes(broken)
            self.assertEqual(tool.extensions_of(path), [], broken)

    def test_every_extension_that_is_read_has_a_row(self):
        source = (REPOSITORY / "scenes/import/GltfDocument.cpp").read_text()
        table = re.search(r"kSupportedExtensions\[\] = \{(.*?)\};", source, re.S).group(1)
        names = re.findall(r'"(\w+)"', table)
        self.assertGreater(len(names), 15)
        self.assertEqual([name for name in names if name not in tool.EXTENSIONS], [])

    def test_status_follows_from_extensions_and_what_is_said(self):
        volume = "bodies bend the environment's light, and do not show what lies behind them"
        light = "the scene has no light: lit by the built-in environment 'studio'"
        cases = [
            ([], 0, [light], ("right", "")),
            (["KHR_materials_unlit"], 0, [], ("right", "")),
            (["KHR_materials_variants"], 0, [], ("right", "the first one")),
            (["KHR_materials_variants", "KHR_materials_volume"], 0, [], ("approximate", volume)),
            (["KHR_new"], 0, ["the extension KHR_new is not supported and was ignored"],
             ("approximate", "KHR_new is left out")),
            ([], 0, ["2 primitive(s) of lines are left out"], ("approximate", "2 primitive(s) of lines are left out")),
            (["KHR_materials_volume"], 2, ["a", "requires X"], ("refused", "requires X")),
            ([], 137, [], ("refused", "exit code 137")),
        ]  # fmt: skip
        for extensions, code, lines, expected in cases:
            self.assertEqual(tool.status_of(extensions, code, lines), expected)

    def test_the_table_replaces_the_one_between_its_markers(self):
        table = tool.table_of([("A", "right", ""), ("B", "refused", "a | b")])
        self.assertEqual(table.splitlines()[2:], ["| A | right |  |", "| B | refused | a \\| b |"])
        old = f"# Title\n{tool.BEGIN}\nold\n{tool.END}\nrest\n"
        new = tool.with_table(old, table)
        self.assertEqual(new, f"# Title\n{tool.BEGIN}\n{table}{tool.END}\nrest\n")
        self.assertEqual(tool.with_table(new, table), new)
        with self.assertRaises(ValueError):
            tool.with_table("# Title\n", table)
        tool.with_table((REPOSITORY / "docs/khronos-models.md").read_text(), table)

    def test_pictures_are_read_to_the_last_bit(self):
        def value(channel, x, y):
            return "ABGR".index(channel) + x / 7.0 - 3.0 * y

        for compression in (0, 2, 3):
            picture = tool.read_exr(exr(5, 37, value, compression))
            self.assertEqual((picture.width, picture.height), (5, 37))
            for channel in "ABGR":
                wanted = array.array("f", (value(channel, x, y) for y in range(37) for x in range(5)))
                self.assertEqual(picture.planes[channel], wanted)
        for broken in (b"PNG", exr(5, 3, value, 4)):
            with self.assertRaises(ValueError):
                tool.read_exr(broken)

    def test_only_covered_pixels_are_measured(self):
        def value(channel, x, y):
            if channel == "A":
                return 1.0 if 2 <= x < 5 and y in (1, 7) else 0.0
            return {"R": 0.1, "G": 0.2, "B": 0.4}[channel] if 2 <= x < 5 and y in (1, 7) else 100.0

        mean, share = tool.read_exr(exr(20, 10, value, 3)).measure()
        self.assertAlmostEqual(mean, 0.2126 * 0.1 + 0.7152 * 0.2 + 0.0722 * 0.4, 6)
        self.assertEqual(share, 0.7)
        self.assertEqual(tool.read_exr(exr(2, 2, lambda *_: 0.0, 3)).measure(), (0.0, 0.0))

    def test_the_sheet_shows_pictures_above_their_names(self):
        red, blue = b"\xff\0\0" * 40 * 8, b"\0\0\xff" * 40 * 8
        picture = tool.png_of(*tool.sheet_of([("I", red), ("none", None), ("B", blue)], (40, 8), columns=2))
        width, height, rows = pixels_of(picture)
        self.assertEqual((width, height), (80, 2 * (8 + tool.LINE)))
        self.assertEqual(rows[7][:120], red[:120])
        self.assertEqual(rows[7][120:], bytes(120))
        self.assertEqual(rows[8 + tool.LINE][:120], blue[:120])
        self.assertEqual(rows[8][:120], bytes(120), "the picture's last row is above")
        # The stem of I: seven dots in the third of five columns.
        self.assertEqual([rows[8 + 3 + y][3 * 4] for y in range(-1, 8)], [0] + 7 * [0xE0] + [0])
        for letter, dots in tool.LETTERS.items():
            self.assertEqual(len(bytes.fromhex(dots)), 5, letter)

    def run_tool(self, *options):
        said, failed = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(failed):
            code = tool.main([str(self.folder / "models"), str(self.folder / "out"), "--size", "8x4", *options])
        return code, failed.getvalue()

    def test_each_model_is_drawn_once_and_black_ones_are_told(self):
        self.model("Box.gltf", ["KHR_materials_volume"])
        self.model("Old.gltf")
        (self.folder / "lit.exr").write_bytes(exr(8, 4, lambda channel, x, y: 0.5 if channel != "A" else 1.0, 3))
        (self.folder / "black.exr").write_bytes(exr(8, 4, lambda channel, x, y: 0.0 if channel != "A" else 1.0, 3))
        program = self.folder / "tessera"
        program.write_text(f"""#!{shutil.which("sh")}
echo "$*" >> {self.folder}/log
case "$2" in
    *Old.gltf) echo "tessera: error: $2: is glTF 1.0" >&2; exit 2 ;;
    *) echo "tessera: warning: Box: something is left out" >&2; cp "{self.folder}/$(cat {self.folder}/shown).exr" "$4" ;;
esac
""")
        program.chmod(0o755)
        document = self.folder / "document.md"
        document.write_text(f"{tool.BEGIN}\n{tool.END}\n")
        (self.folder / "shown").write_text("lit")
        code, failed = self.run_tool("--program", str(program), "--document", str(document))
        self.assertEqual((code, failed), (0, ""))
        log = (self.folder / "log").read_text().splitlines()
        self.assertEqual(len(log), 2)
        self.assertRegex(log[0], r"^render .*/Box\.gltf -o .*/model\.exr --size 8x4$")
        table = (self.folder / "out/table.md").read_text()
        self.assertIn("| Box | approximate | bodies bend", table)
        self.assertIn("; something is left out |", table)
        self.assertIn("| Old | refused | is glTF 1.0 |", table)
        self.assertIn(table, document.read_text())
        with open(self.folder / "out/models.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual((rows[0]["mean luminance"], rows[0]["span"]), ("0.5000", "1.000"))
        self.assertEqual(rows[0]["warnings"], "something is left out")
        self.assertEqual(rows[1]["mean luminance"], "")
        self.assertEqual(pixels_of((self.folder / "out/sheet.png").read_bytes())[:2], (16, 4 + tool.LINE))
        self.assertFalse((self.folder / "out/model.exr").exists())
        (self.folder / "shown").write_text("black")
        code, failed = self.run_tool("--program", str(program))
        self.assertEqual(code, 1)
        self.assertIn("Box: its mean luminance is 0.0000", failed)


if __name__ == "__main__":
    unittest.main()
