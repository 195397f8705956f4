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
            self.assertEqual(tool.extensions_of(tool.document_of(self.model("a.glb", used, glb))), sorted(used))
        path = self.model("b.gltf")
        path.unlink()
        self.assertEqual(tool.document_of(path), {})
        used = (b'[1, "a"]', b'[["a"], ["b"]]', b'"ab"', b"null")
        for broken in (b"", b"glTF", b"glTF" + bytes(30), b"{", b"[]", b"[" * 100000,
                       *(b'{"extensionsUsed": %s}' % names for names in used)):  # fmt: skip
            path.write_bytes(broken)
            self.assertEqual(tool.extensions_of(tool.document_of(path)), [], broken)
            self.assertEqual(tool.times_of(tool.document_of(path)), [0.0], broken)

    def test_models_that_move_are_looked_at_over_their_first_clip(self):
        document = {
            "accessors": [{"max": [2.0]}, {"max": [6.0]}, {"max": [9.0]}],
            "animations": [{"samplers": [{"input": 0}, {"input": 1}]}, {"samplers": [{"input": 2}]}],
        }
        self.assertEqual(tool.times_of(document), [0.0, 1.5, 3.0, 4.5, 6.0])
        document["accessors"][0]["max"] = document["accessors"][1]["max"] = [0.0]
        self.assertEqual(tool.times_of(document), [0.0])
        for broken in (10**400, float("inf"), float("nan"), "2", [2.0]):
            document["accessors"][0]["max"] = document["accessors"][1]["max"] = [broken]
            self.assertEqual(tool.times_of(document), [0.0], broken)
        del document["accessors"][0]["max"]
        self.assertEqual(tool.times_of(document), [0.0])

    def extensions_that_are_read(self):
        source = (REPOSITORY / "scenes/import/GltfDocument.cpp").read_text()
        table = re.search(r"kSupportedExtensions\[\] = \{(.*?)\};", source, re.S).group(1)
        names = re.findall(r'"(\w+)"', table)
        self.assertGreater(len(names), 15)
        return names

    def test_every_extension_that_is_read_has_a_row(self):
        self.assertEqual([name for name in self.extensions_that_are_read() if name not in tool.EXTENSIONS], [])

    def test_the_document_of_the_format_names_the_extensions_that_are_read(self):
        text = (REPOSITORY / "docs/scene-format.md").read_text(encoding="utf-8")
        words = re.findall(r"`((?:KHR|EXT)?_\w+)`", text.split("\n## glTF\n")[1].split("\n## ")[0])
        named = {word if word[0] != "_" else "KHR_materials" + word for word in words}
        self.assertEqual(sorted(named), sorted(self.extensions_that_are_read()))

    def test_status_follows_from_extensions_and_what_is_said(self):
        volume = "bodies show opaque surfaces as the camera sees them, and no glass behind them"
        cases = [
            ([], 0, [], ("right", "")),
            (["KHR_materials_unlit"], 0, [], ("right", "")),
            (["KHR_materials_variants"], 0, [], ("right", "the first one")),
            (["KHR_materials_variants", "KHR_materials_volume"], 0, [], ("approximate", volume)),
            (["KHR_new"], 0, ["the extension KHR_new is not supported and was ignored"],
             ("approximate", "KHR_new is left out")),
            ([], 0, ["JOINTS_2 and further are left out"], ("approximate", "JOINTS_2 and further are left out")),
            (["KHR_materials_volume"], 2, ["a", "requires X"], ("refused", "requires X")),
            ([], 2, [], ("refused", "exit code 2")),
            (["FAKE_materials_quantumRendering"], 0,
             ["the extension FAKE_materials_quantumRendering is not supported and was ignored"],
             ("right", "no such extension: left out, and said")),
            (["KHR_xmp"], 0, ["the extension KHR_xmp is not supported and was ignored"],
             ("right", "words about the model: left out, and said")),
            ([], 0, ["mesh 'a' has no POSITION and is left out", "the scene has no triangles to draw"],
             ("nothing to draw", "mesh 'a' has no POSITION and is left out")),
            ([], 137, [], ("crashed", "exit code 137")),
            ([], 1, ["a", "no memory"], ("crashed", "exit code 1; no memory")),
            ([], -11, ["a"], ("crashed", "signal SIGSEGV; a")),
            ([], None, [], ("crashed", "took more than 900 s")),
        ]  # fmt: skip
        for extensions, code, lines, expected in cases:
            self.assertEqual(tool.status_of(extensions, code, lines), expected)

    def test_the_table_replaces_the_one_between_its_markers(self):
        figures = tool.Figures(0.12345, 0.876, True, False)
        table = tool.table_of([tool.Row("A", "right", "", figures), tool.Row("B", "refused", "a | b", None)])
        self.assertEqual(
            table.splitlines()[2:],
            ["| A | right | 0.12 | 88 % | cut | its own |  |", "| B | refused |  |  |  |  | a \\| b |"],
        )
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

        picture = tool.read_exr(exr(20, 10, value, 3))
        self.assertAlmostEqual(picture.luminance(), 0.2126 * 0.1 + 0.7152 * 0.2 + 0.0722 * 0.4, 6)
        self.assertEqual(picture.box(), (2, 1, 4, 7))
        self.assertEqual(picture.lost(), (0.0, 0.0))
        nothing = tool.read_exr(exr(2, 2, lambda *_: 0.0, 3))
        self.assertEqual((nothing.luminance(), nothing.box(), nothing.lost()), (0.0, None, (0.0, 0.0)))

    def test_what_a_display_shows_as_black_or_white_is_counted(self):
        columns = [(0.01, 0.01, 0.02), (0.0, 0.015, 0.0), (1.8, 3.0, 3.0), (1.9, 3.0, 3.0)]
        picture = tool.read_exr(exr(4, 1, lambda channel, x, y: 1.0 if channel == "A" else columns[x]["RGB".index(channel)], 3))
        self.assertEqual(picture.lost(), (0.25, 0.25))
        grey = tool.read_exr(exr(2, 1, lambda channel, x, y: tool.DARK if x == 0 else tool.BURNT, 3)).bytes()
        self.assertEqual([round(code / 255, 2) for code in grey[::3]], [0.02, 0.98])

    def covering(self, left, top, right, bottom, value=0.5):
        """A picture of 20 x 10 in which these pixels are covered."""
        def of(channel, x, y):
            inside = left <= x <= right and top <= y <= bottom
            return float(inside) if channel == "A" else value

        return tool.read_exr(exr(20, 10, of, 3))

    def test_figures_are_those_of_all_moments(self):
        first, second = self.covering(8, 4, 9, 5, 0.25), self.covering(3, 4, 3, 5, 0.75)
        figures = tool.figures_of(first, [first, second], True)
        self.assertAlmostEqual(figures.luminance, 0.25, 6)
        self.assertEqual(figures[1:4], (7 / 20, False, True))
        self.assertEqual(tool.figures_of(first, [self.covering(3, 2, 3, 8)], True).span, 0.7, "of the height")
        for box in ((0, 4, 5, 5), (8, 0, 9, 5), (8, 4, 19, 5), (8, 4, 9, 9)):
            self.assertTrue(tool.figures_of(first, [first, self.covering(*box)], True).is_cut, box)
        nothing = self.covering(1, 1, 0, 0)
        self.assertEqual(tool.figures_of(nothing, [nothing], True)[:4], (0.0, 0.0, False, True))

    def test_a_model_with_cameras_is_framed_by_the_supplied_one_and_as_bright_as_by_its_own(self):
        own, framed = self.covering(0, 0, 0, 0, 0.75), self.covering(4, 4, 15, 5, 0.25)
        nothing = self.covering(1, 1, 0, 0)
        self.assertEqual(tool.figures_of(own, [framed], False)[1:4], (12 / 20, False, False))
        for shown in (framed, nothing):
            self.assertAlmostEqual(tool.figures_of(own, [shown], False).luminance, 0.75, 6)
        self.assertEqual(tool.figures_of(own, [nothing], False).span, 0.0)

    def test_faults_of_the_view_of_the_supplied_camera_are_reported(self):
        def faults(luminance, span, is_cut, is_supplied=True, status="right"):
            return tool.faults_of(tool.Row("A", status, "", tool.Figures(luminance, span, is_cut, is_supplied)))

        self.assertEqual(faults(0.02, 0.55, False), [])
        self.assertEqual(faults(0.0199, 0.55, False), ["black"])
        self.assertEqual(faults(float("nan"), 0.55, False), ["black"])
        for lost, names in (((0.51, 0.49), ["over half black"]), ((0.5, 0.51), ["over half burnt"])):
            self.assertEqual(tool.faults_of(tool.Row("A", "right", "", tool.Figures(0.5, 0.9, False, True, *lost))), names)
        self.assertEqual(faults(0.02, 0.549, False), ["framed under 55 %"])
        self.assertEqual(faults(0.02, 1.0, True), ["cut off"])
        room = self.covering(0, 0, 19, 9)
        inside = tool.figures_of(room, [room], tool.FROM_INSIDE)
        self.assertFalse(inside.is_cut, "a room reaches beyond the picture on all sides")
        self.assertTrue(tool.figures_of(room, [room], tool.SUPPLIED_CAMERA).is_cut)
        self.assertEqual(faults(0.01, 0.5, True, is_supplied=False), ["black", "framed under 55 %", "cut off"])
        self.assertEqual(faults(0.5, 0.0, False, is_supplied=False), ["framed under 55 %"], "its own camera sees it")
        self.assertEqual(faults(0.0, 0.55, False, is_supplied=False), ["black"], "its own camera sees nothing")
        self.assertEqual(faults(0.0, 0.0, False), ["black"], "it covers nothing")
        self.assertEqual(faults(0.0, 0.0, False, status="nothing to draw"), [])
        self.assertEqual(tool.faults_of(tool.Row("A", "crashed", "", None)), ["crashed"])
        self.assertEqual(tool.faults_of(tool.Row("A", "refused", "", None)), [])

    def test_the_totals_are_one_line(self):
        rows = [
            tool.Row("A", "right", "", tool.Figures(0.5, 0.9, False, True)),
            tool.Row("B", "approximate", "", tool.Figures(0.01, 0.3, True, True)),
            tool.Row("C", "crashed", "", None),
        ]
        self.assertEqual(
            tool.totals_of(rows),
            "3 models: 1 right, 1 approximate, 0 refused, 0 nothing to draw; "
            "1 crashed, 1 black, 0 over half black, 0 over half burnt, 1 framed under 55 %, 1 cut off, 0 no longer drawn",
        )

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

    def picture(self, name, value, left=0):
        """A picture of 8 x 4, covered from column `left` but for the edges; all over if that is 0."""
        def of(channel, x, y):
            return value if channel != "A" else float(left == 0 or (left <= x < 7 and 1 <= y < 3))

        (self.folder / f"{name}.exr").write_bytes(exr(8, 4, of, 3))

    def program(self):
        """A stand-in for the program: Old is refused, Ill crashes, all others are what the file "shown" names, and by
        --default-camera what the file "framed" names."""
        program = self.folder / "tessera"
        program.write_text(f"""#!{shutil.which("sh")}
echo "$*" >> {self.folder}/log
case "$*" in
    *Old.gltf*) echo "tessera: error: $2: is glTF 1.0" >&2; exit 2 ;;
    *Ill.gltf*) kill -s SEGV $$ ;;
    *--default-camera*)
        echo "seen whole by the supplied camera 'default' in the place of its own"
        cp "{self.folder}/$(cat {self.folder}/framed).exr" "$4" ;;
    *) cat {self.folder}/said >&2; cat {self.folder}/noted; cp "{self.folder}/$(cat {self.folder}/shown).exr" "$4" ;;
esac
""")
        program.chmod(0o755)
        return ["--program", str(program)]

    def show(self, picture, *said, framed=None, stops=0):
        """A picture by the supplied camera, or by the model's own where the one by the supplied is `framed`."""
        (self.folder / "shown").write_text(picture)
        (self.folder / "framed").write_text(framed or "none")
        noted = "no camera in it: seen whole by the supplied camera 'default'\n" * (framed is None)
        if stops != 0:
            noted += f"its lights are too dim for a display: exposed by {stops:+} EV (--exposure chooses another)\n"
        (self.folder / "noted").write_text(noted)
        (self.folder / "said").write_text(
            "tessera: note: of no model\n" + "".join(f"tessera: warning: {line}\n" for line in said))

    def rows(self):
        with open(self.folder / "out/models.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_each_model_is_drawn_once_and_reported(self):
        self.model("Box.gltf", ["KHR_materials_volume"])
        self.model("Old.gltf")
        self.picture("lit", 0.5)
        self.picture("whole", 0.25, 1)
        program = self.program()
        self.show("lit", "Box: something is left out", framed="whole")
        document = self.folder / "document.md"
        document.write_text(f"{tool.BEGIN}\n{tool.END}\n")
        (self.folder / "out").mkdir()
        (self.folder / "out/model.exr").write_text("someone's")
        code, failed = self.run_tool(*program, "--document", str(document))
        self.assertEqual((code, failed), (0, ""))
        log = (self.folder / "log").read_text().splitlines()
        self.assertEqual(len(log), 3)
        self.assertRegex(log[0], r"^render .*/Box\.gltf -o .*/model\.exr --size 8x4$")
        self.assertEqual(log[1], f"{log[0]} --default-camera")
        table = (self.folder / "out/table.md").read_text()
        self.assertIn("| Box | approximate | 0.5 | 75 % | free | its own | bodies show", table)
        self.assertIn("; something is left out |", table)
        self.assertIn("| Old | refused |  |  |  |  | is glTF 1.0 |", table)
        self.assertIn(f"{table}\n2 models: 0 right, 1 approximate, 1 refused, ", document.read_text())
        rows = self.rows()
        self.assertEqual((rows[0]["mean luminance"], rows[0]["span"], rows[0]["cut"]), ("0.5000", "0.750", "0"))
        self.assertEqual((rows[0]["camera"], rows[0]["warnings"]), ("its own", "something is left out"))
        self.assertEqual(rows[1]["mean luminance"], "")
        self.assertEqual(pixels_of((self.folder / "out/sheet.png").read_bytes())[:2], (16, 4 + tool.LINE))
        self.assertEqual((self.folder / "out/model.exr").read_text(), "someone's")
        names = {"model.exr", "models.csv", "sheet.png", "table.md"}
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, names)

    def test_what_the_table_says_is_drawn_must_be(self):
        self.model("Box.gltf")
        self.model("Old.gltf")
        self.picture("lit", 0.5, 1)
        program = self.program()
        self.show("lit")
        document = self.folder / "document.md"

        def run_where(status):
            figures = tool.Figures(0.5, 0.9, False, True) if status != "refused" else None
            table = tool.table_of([tool.Row("Box", "right", "", tool.Figures(0.5, 0.9, False, True)),
                                   tool.Row("Old", status, "", figures), tool.Row("Gone", "right", "", figures)])  # fmt: skip
            document.write_text(f"# Models\n{tool.BEGIN}\n{table}{tool.END}\n| Box | refused |\n")
            return self.run_tool(*program, "--expect", str(document))

        self.assertEqual(run_where("refused"), (0, ""))
        for status in ("right", "approximate"):
            self.assertEqual(run_where(status), (1, "Old: no longer drawn: is glTF 1.0\n"))
        self.assertEqual(tool.drawn_in(tool.table_of([tool.Row("A | B", "right", "", None)])), {"A | B"})
        self.assertIn("WaterBottle", tool.drawn_in((REPOSITORY / "docs/khronos-models.md").read_text(encoding="utf-8")))

    def test_files_are_written_whole_or_not_at_all(self):
        path = self.folder / "table.md"
        tool.write(path, "old")
        with self.assertRaises(UnicodeEncodeError):
            tool.write(path, "new \udc80")
        self.assertEqual(path.read_text(), "old")
        tool.write(path, b"new")
        self.assertEqual((path.read_text(), list(self.folder.iterdir())), ("new", [path]))

    def test_a_missing_program_is_reported_before_the_work(self):
        self.model("Box.gltf")
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as failed:
            tool.main([str(self.folder / "models"), str(self.folder / "out"), "--program", str(self.folder / "none")])
        self.assertIn("none is no program; build it with ./run scenes", failed.getvalue())
        self.assertFalse((self.folder / "out").exists())

    def test_names_that_are_no_text_are_reported(self):
        try:
            self.model("caf\udce9.gltf")
        except OSError:
            self.skipTest("this file system has UTF-8 names alone")
        self.assertEqual(list(tool.models_below(self.folder / "models")), ["caf\\udce9"])

    def test_models_that_are_black_framed_badly_or_crash_fail(self):
        self.model("Box.gltf")
        program = self.program()
        self.picture("lit", 0.5, 1)
        self.picture("black", 0.01, 1)
        self.picture("small", 0.5, 4)
        self.picture("large", 0.5)
        black = "Box: black, over half black: luminance 0.0100, spans 0.750\n"
        small = "Box: framed under 55 %: luminance 0.5000, spans 0.500\n"
        cut_off = "Box: cut off: luminance 0.5000, spans 1.000\n"
        cases = [
            ("lit", None, ""),
            ("black", None, black),
            ("small", None, small),
            ("large", None, cut_off),
            ("small", "lit", ""),
            ("large", "lit", ""),
            ("lit", "black", ""),
            ("black", "lit", black),
            ("lit", "small", small),
            ("lit", "large", cut_off),
        ]
        for picture, framed, messages in cases:
            self.show(picture, framed=framed)
            self.assertEqual(self.run_tool(*program), (1 if messages else 0, messages), (picture, framed))
        self.show("black", stops=2)
        self.assertEqual(self.run_tool(*program), (0, ""))
        self.assertEqual(self.rows()[0]["mean luminance"], "0.0400", "as the display picture is exposed")
        self.model("Ill.gltf")
        self.show("lit")
        code, failed = self.run_tool(*program)
        self.assertEqual((code, failed), (1, "Ill: crashed: signal SIGSEGV\n"))
        self.assertEqual([row["status"] for row in self.rows()], ["right", "crashed"])

    def test_what_moves_is_drawn_at_five_moments(self):
        path = self.model("Box.gltf")
        samplers = [{"input": 0}]
        path.write_text(json.dumps({"accessors": [{"max": [2]}], "animations": [{"samplers": samplers}]}))
        self.picture("lit", 0.5, 1)
        program = self.program()
        self.show("lit")
        self.assertEqual(self.run_tool(*program), (0, ""))
        log = (self.folder / "log").read_text().splitlines()
        ends = ["--size 8x4", "--time 0.5", "--time 1", "--time 1.5", "--time 2"]
        self.assertEqual([line.endswith(end) for line, end in zip(log, ends, strict=True)], 5 * [True])
        (self.folder / "log").unlink()
        self.show("lit", framed="lit")
        self.assertEqual(self.run_tool(*program), (0, ""))
        log = (self.folder / "log").read_text().splitlines()
        ends = ["--size 8x4", *(f"{end} --default-camera" for end in ends)]
        self.assertEqual([line.endswith(end) for line, end in zip(log, ends, strict=True)], 6 * [True], "once by its own")


if __name__ == "__main__":
    unittest.main()
