"""The Python module does what the command line does, and behaves as Python's users expect.

    module_test.py PROGRAM

The module is the one in the folder that the variable TESSERA_PYTHON_MODULE names, which ./test --python sets. Exits with 77
(skipped) where there is none, or no NumPy.
"""

import ast
import gc
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import textwrap
import threading
import unittest
import warnings
from base64 import b64encode

from find_module import REPOSITORY, numpy, tessera

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else None
SIZE = {"size": (96, 54)}


def programSays(*words):
    """What the program prints; exit code 3 reports a missed tolerance, which is no matter here."""
    result = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=300)
    assert result.returncode in (0, 3), result.stderr
    return result.stdout


def movingTriangle():
    """A glTF model: a triangle that moves from x = 0 to x = 1 m within a second."""
    positions = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
    times, places = struct.pack("<2f", 0, 1), struct.pack("<6f", 0, 0, 0, 1, 0, 0)
    data = positions + times + places
    view = lambda offset, length: {"buffer": 0, "byteOffset": offset, "byteLength": length}
    accessor = lambda number, count, kind, **bounds: {"bufferView": number, "componentType": 5126, "count": count, "type": kind,
                                                      **bounds}
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + b64encode(data).decode()}],
            "bufferViews": [view(0, 36), view(36, 8), view(44, 24)],
            "accessors": [accessor(0, 3, "VEC3", min=[-1, -1, 0], max=[1, 1, 0]), accessor(1, 2, "SCALAR", min=[0], max=[1]),
                          accessor(2, 2, "VEC3")],
            "animations": [{"samplers": [{"input": 1, "output": 2}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class SameAsTheProgram(Folder):
    def fileOf(self, name, *words):
        path = self.folder / name
        programSays("render", "spheres", "-o", str(path), "--size", "96x54", *words)
        return path.read_bytes()

    def testPicturesAreTheFilesOfRender(self):
        for words, keywords in [((), {}),
                                (("--technique", "forward_plus", "--exposure", "1.5", "--tonemap", "aces"),
                                 {"technique": "forward_plus", "exposure": 1.5, "tonemap": "aces"}),
                                (("--view", "normal", "--lights", "9"), {"view": "normal", "lights": 9}),
                                (("--eye", "0,2,9", "--target", "0,1,0", "--fov", "30", "--specular", "off"),
                                 {"eye": (0, 2, 9), "target": numpy.array([0.0, 1.0, 0.0]), "fov": 30, "specular": False}),
                                (("--view", "lights", "--technique", "tiled_deferred"),
                                 {"view": "lights", "technique": "tiled_deferred"})]:
            with self.subTest(words):
                picture = tessera.render("spheres", **SIZE, **keywords)
                self.assertEqual(picture.png(), self.fileOf("a.png", *words))
                picture.save(self.folder / "b.exr")
                self.assertEqual((self.folder / "b.exr").read_bytes(), self.fileOf("a.exr", *words))

    def testTheReferenceIsThatOfRender(self):
        picture = tessera.render("spheres", technique="reference", size="48x27")
        programSays("render", "spheres", "-o", str(self.folder / "a.png"), "--size", "48x27", "--technique", "reference")
        self.assertEqual(picture.png(), (self.folder / "a.png").read_bytes())
        self.assertEqual(picture.technique, "reference")

    def testComparisonsArePrintedByCompare(self):
        words = ("compare", "spheres", "--size", "96x54", "--layout", "packed", "--techniques", "deferred,forward_plus")
        self.assertEqual(
            tessera.compare("spheres", techniques=["deferred", "forward_plus"], layout="packed", **SIZE),
            json.loads(programSays(*words, "--json", "-")))

    def testPlansArePrintedByPlan(self):
        self.assertEqual(tessera.plan("hall", technique="forward_plus", **SIZE),
                         json.loads(programSays("plan", "hall", "--technique", "forward_plus", "--size", "96x54", "--json", "-")))
        self.assertEqual(tessera.plan("spheres", also=[0]),
                         json.loads(programSays("plan", "spheres", "--also", "0", "--json", "-")))
        measured = tessera.plan("spheres", measure=True, **SIZE)
        self.assertTrue(all(one["ms"] is not None for one in measured["passes"]), measured["passes"])

    def testBenchmarksAreKeptAsBenchKeepsThem(self):
        matrix = {"technique": ["forward", "deferred"], "lights": [2, 4]}
        record = tessera.bench("spheres", matrix=matrix, frames=1, size=(48, 27), against="forward", output=self.folder / "run")
        self.assertEqual(record, json.loads((self.folder / "run/bench.json").read_text()))
        self.assertTrue(record["complete"])
        self.assertEqual({(one["technique"], one["lights"]) for one in record["points"]},
                         {(technique, lights) for technique in matrix["technique"] for lights in matrix["lights"]})
        with self.assertRaisesRegex(tessera.InputError, "colour"):
            tessera.bench("spheres", matrix={"colour": [1]})

    def testScenesAndTechniquesAreThoseOfTheProgram(self):
        listed = programSays("scenes")
        self.assertTrue(all(row["name"] in listed and row["purpose"] in listed for row in tessera.scenes()))
        self.assertEqual(len(tessera.scenes()), len(listed.splitlines()) - 1)
        self.assertEqual(tessera.techniques()[-1], "reference")
        self.assertEqual(tessera.__version__, programSays("--version").split()[1])


class Arrays(unittest.TestCase):
    def testAPictureIsArraysOfItsOwnMemory(self):
        picture = tessera.render("spheres", **SIZE)
        self.assertEqual((picture.width, picture.height, picture.scene, picture.view), (96, 54, "spheres", "final"))
        self.assertEqual((picture.rgba.shape, picture.rgba.dtype), ((54, 96, 4), numpy.float32))
        self.assertEqual((picture.rgb.shape, picture.alpha.shape), ((54, 96, 3), (54, 96)))
        self.assertEqual((picture.display.shape, picture.display.dtype), ((54, 96, 3), numpy.uint8))
        numpy.testing.assert_array_equal(picture.rgb, picture.rgba[..., :3])
        numpy.testing.assert_array_equal(picture.alpha, picture.rgba[..., 3])
        numpy.testing.assert_array_equal(numpy.asarray(picture), picture.rgba)
        self.assertEqual(numpy.asarray(picture, dtype=float).dtype, float)
        self.assertTrue(numpy.shares_memory(picture.rgba, picture.rgba))
        for array in (picture.rgba, picture.rgb, picture.display):
            with self.assertRaises(ValueError):
                array[0, 0, 0] = 1
        self.assertGreater(picture.rgb.max(), 0)

    def testArraysKeepTheirPictureAlive(self):
        picture = tessera.render("spheres", **SIZE)
        rgba, copy = picture.rgba, picture.rgba.copy()
        del picture
        gc.collect()
        others = [tessera.render("room", **SIZE) for _ in range(3)]
        numpy.testing.assert_array_equal(rgba, copy)
        del others

    def testViewsAreFoundByName(self):
        scene = tessera.load("spheres", **SIZE)
        normal = tessera.render(scene, view="normal")
        covered = normal.alpha == 1
        self.assertTrue(covered.any())
        self.assertEqual(normal.view, "normal")
        for view in ("depth", "diffuse"):
            picture = tessera.render(scene, view=view)
            self.assertTrue(numpy.isfinite(picture.rgb[covered]).all())
            self.assertTrue((picture.alpha == normal.alpha).all())
            self.assertFalse((picture.rgb[covered] == normal.rgb[covered]).all(), view)
        self.assertIn("depth", [view["name"] for view in tessera.views()])

    def testANotebookShowsThePngFile(self):
        picture = tessera.render("spheres", **SIZE)
        self.assertEqual(picture._repr_png_()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(picture._repr_png_(), picture.png())
        self.assertIn("96x54 of spheres", repr(picture))
        toneMapped = tessera.render("spheres", technique="reference", size=(16, 9), tonemap="aces")
        own = tessera.render("spheres", technique="forward", size=(16, 9), tonemap="aces", filter="exact")
        self.assertLessEqual(numpy.abs(toneMapped.display.astype(int) - own.display).max(), 1)


class Scenes(unittest.TestCase):
    def testALoadedSceneIsDrawnAsAFreshOne(self):
        scene = tessera.load("spheres", lights=3)
        self.assertEqual((scene.name, scene.lights), ("spheres", 3))
        self.assertGreater(scene.triangles, 100)
        self.assertIn("spheres", repr(scene))
        for keywords in ({}, {"technique": "forward"}, {"lights": 9}, {"size": (54, 96)}, {"eye": (0, 2, 9)}, {"time": 1.5}, {}):
            keywords = {**SIZE, **keywords}
            with self.subTest(keywords):
                again = tessera.render(scene, **keywords).rgba
                fresh = tessera.render("spheres", **{"lights": 3, **keywords}).rgba
                numpy.testing.assert_array_equal(again, fresh)

    def testAClipIsShownAtTheTimeOfEachPicture(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "moving.gltf"
            path.write_text(json.dumps(movingTriangle()))
            scene = tessera.load(path, **SIZE)
            pictures = []
            for seconds in (0, 0.5, 1, 0.25, 0):
                again = tessera.render(scene, time=seconds).rgba
                numpy.testing.assert_array_equal(again, tessera.render(path, time=seconds, **SIZE).rgba)
                pictures.append(again.copy())
            self.assertFalse((pictures[0] == pictures[1]).all())
            numpy.testing.assert_array_equal(pictures[0], pictures[-1])
            placed = {"eye": (0, 0, 4), "target": (0, 0, 0)}
            for seconds in (1, 0):
                numpy.testing.assert_array_equal(tessera.render(scene, time=seconds, **placed).rgba,
                                                 tessera.render(path, time=seconds, **placed, **SIZE).rgba)

    def testKeywordsOfTheLoadHoldUnlessTheyAreSaidAnew(self):
        scene = tessera.load("spheres", technique="forward", **SIZE)
        self.assertEqual(tessera.render(scene).technique, "forward")
        self.assertEqual(tessera.render(scene, technique="deferred").technique, "deferred")
        self.assertEqual(tessera.render(scene, technique=None).technique, "forward")


class Errors(Folder):
    def testWhatCannotBeUsedIsAValueErrorThatNamesKeywords(self):
        self.assertTrue(issubclass(tessera.InputError, ValueError))
        for message, call in [("did you mean 'deferred'", lambda: tessera.render("spheres", technique="defered")),
                              ("did you mean 'spheres'", lambda: tessera.load("sphere")),
                              ("^exposure", lambda: tessera.render("spheres", exposure=1e9)),
                              ("^size '0x9'", lambda: tessera.render("spheres", size=(0, 9))),
                              ("^fov nan", lambda: tessera.render("spheres", fov=float("nan"))),
                              ("nothing.glb", lambda: tessera.load(self.folder / "nothing.glb")),
                              ("^picture.jpg", lambda: tessera.render("spheres", **SIZE).save("picture.jpg")),
                              ("no plan", lambda: tessera.plan("spheres", technique="reference")),
                              ("output", lambda: tessera.bench("spheres", resume=True))]:
            with self.subTest(message), self.assertRaisesRegex(tessera.InputError, message) as raised:
                call()
            self.assertNotIn("--", str(raised.exception))

    def testTextsAndNumbersThatNothingTakesAreNamedByTheirKeywords(self):
        lone, huge = "\ud800", 10**400
        for message, call in [("^technique holds", lambda: tessera.render("spheres", technique=lone)),
                              ("^scene holds", lambda: tessera.render(lone)),
                              ("^source holds", lambda: tessera.load("a\0b")),
                              ("^camera holds", lambda: tessera.render("spheres", camera=lone)),
                              ("^a keyword holds", lambda: tessera.render("spheres", **{lone: 1})),
                              ("^exposure is a larger", lambda: tessera.render("spheres", exposure=10**5000)),
                              ("^size is a larger", lambda: tessera.render("spheres", size=(10**5000, 9))),
                              ("^eye is a larger", lambda: tessera.render("spheres", eye=(huge, 0, 0))),
                              ("^frames is a larger", lambda: tessera.bench("spheres", frames=huge))]:
            with self.subTest(message), self.assertRaisesRegex(tessera.InputError, message):
                call()

    def testAnUnknownKeywordIsATypeErrorThatNamesTheNearest(self):
        for message, call in [(r"render\(\) has no keyword 'exposur'.*'exposure'", lambda: tessera.render("spheres", exposur=1)),
                              ("'against'", lambda: tessera.compare("spheres", agains="forward")),
                              ("size", lambda: tessera.render("spheres", size={})),
                              ("technique is bool", lambda: tessera.render("spheres", technique=True)),
                              ("eye", lambda: tessera.render("spheres", eye=(1, 2))),
                              ("scene is int", lambda: tessera.render(3))]:
            with self.subTest(message), self.assertRaisesRegex(TypeError, message):
                call()

    def testWarningsArePythons(self):
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            tessera.render("spheres", eye=(0, 0, 1e6), target=(0, 0, 2e6), **SIZE)
        self.assertTrue(any("sees nothing" in str(one.message) and "check eye" in str(one.message) for one in heard), heard)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaisesRegex(UserWarning, "sees nothing"):
                tessera.render("spheres", eye=(0, 0, 1e6), target=(0, 0, 2e6), **SIZE)

    def testFilesMayHaveNamesThatAreNoUtf8(self):
        name = os.fsencode(self.folder) + b"/caf\xe9.gltf"
        try:
            with open(name, "w") as file:
                json.dump({**movingTriangle(), "extensionsUsed": ["EXT_unknown"]}, file)
        except OSError:
            self.skipTest("this file system has UTF-8 names alone")
        with self.assertWarnsRegex(UserWarning, r"caf\\xe9: .*EXT_unknown"):
            scene = tessera.load(os.fsdecode(name), **SIZE)
        self.assertEqual((os.fsencode(scene.name), [os.fsencode(file) for file in scene.files]), (b"caf\xe9", [name]))
        self.assertIn(r"caf\xe9: 1 triangles", repr(scene))
        picture = tessera.render(scene)
        self.assertEqual(os.fsencode(picture.scene), b"caf\xe9")
        self.assertIn(r"of caf\xe9", repr(picture))
        record = tessera.bench(os.fsdecode(name), matrix={"technique": ["forward"]}, frames=1, size=(48, 27))
        self.assertTrue(record["complete"])

    def testAFolderOfTheCacheMayHaveANameThatIsNoUtf8(self):
        says = "import tessera; tessera.render('lamps', lights=1, size=(16, 9))"
        # Mesa prints the folder's raw bytes too.
        result = subprocess.run([sys.executable, "-c", says], capture_output=True, text=True, errors="replace", timeout=300,
                                env={**os.environ, "XDG_CACHE_HOME": os.fsdecode(b"/dev/null/\xff")})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(r"UserWarning: /dev/null/\xff/tessera/lobes-", result.stderr)

    def testWhereAContextCannotBeMadeAnotherKindMayBeChosen(self):
        says = textwrap.dedent("""
            import tessera
            tessera.use_context("window")
            try:
                tessera.render("spheres", size=(16, 9))
            except RuntimeError:
                tessera.use_context("egl")
                assert tessera.render("spheres", size=(16, 9)).rgb.max() > 0
                try:
                    tessera.use_context("window")
                except RuntimeError as error:
                    assert "before the first picture" in str(error), error
                    print("drawn")
        """)
        noDisplay = {key: value for key, value in os.environ.items() if not key.endswith("DISPLAY") and key != "XDG_RUNTIME_DIR"}
        result = subprocess.run([sys.executable, "-c", says], env=noDisplay, capture_output=True, text=True, timeout=120)
        self.assertEqual((result.returncode, result.stdout), (0, "drawn\n"), result.stderr)

    def testAForkedProcessRaisesAnErrorWithTheRemedy(self):
        tessera.render("spheres", **SIZE)
        says = textwrap.dedent("""
            import os, sys, tessera
            tessera.render("spheres", size=(16, 9))
            child = os.fork()
            if child == 0:
                try:
                    tessera.render("spheres", size=(16, 9))
                except RuntimeError as error:
                    os._exit(7 if "spawn" in str(error) else 8)
                os._exit(9)
            os._exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
        """)
        self.assertEqual(subprocess.run([sys.executable, "-c", says], timeout=120).returncode, 7)


class WhileItWorks(unittest.TestCase):
    def testProgressIsReportedToItsEndOnTheCallersThread(self):
        reports = []
        tessera.render("spheres", technique="reference", size=(64, 40),
                       progress=lambda done, expected: reports.append((done, expected, threading.get_ident())))
        self.assertEqual(reports[-1], (40, 40, threading.get_ident()))
        self.assertEqual(reports, sorted(reports))
        reports.clear()
        tessera.compare("spheres", techniques="deferred", progress=lambda done, expected: reports.append((done, expected)), **SIZE)
        self.assertEqual(*reports[-1])

    def testWhatProgressRaisesEndsTheWork(self):
        def refuse(done, expected):
            raise LookupError("enough")
        for _ in range(2):
            with self.assertRaisesRegex(LookupError, "enough"):
                tessera.render("hall", technique="reference", size=(1280, 720), progress=refuse)
        self.assertGreater(tessera.render("spheres", **SIZE).rgb.max(), 0)

    def testControlCEndsTheWorkSoon(self):
        says = textwrap.dedent("""
            import os, signal, time, tessera
            begun = []
            def interrupt(done, expected):
                if not begun:
                    begun.append(time.monotonic())
                    os.kill(os.getpid(), signal.SIGINT)
            try:
                tessera.render("hall", technique="reference", size=(1280, 720), progress=interrupt)
            except KeyboardInterrupt:
                assert time.monotonic() - begun[0] < 20, "it goes on"
                assert tessera.render("spheres", size=(16, 9)).rgb.max() > 0
                print("interrupted, and goes on")
        """)
        result = subprocess.run([sys.executable, "-c", says], capture_output=True, text=True, timeout=180)
        self.assertEqual((result.returncode, result.stdout), (0, "interrupted, and goes on\n"), result.stderr)

    def testOtherThreadsGoOnAndMayRenderToo(self):
        turns, isDone = [0], threading.Event()

        def count():
            while not isDone.wait(0.001):
                turns[0] += 1

        counter = threading.Thread(target=count)
        counter.start()
        tessera.render("spheres", technique="reference", size=(320, 180))
        isDone.set()
        counter.join()
        self.assertGreater(turns[0], 20)

        pictures = []
        threads = [threading.Thread(target=lambda: pictures.append(tessera.render("spheres", **SIZE).rgba)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(pictures), 4)
        for picture in pictures[1:]:
            numpy.testing.assert_array_equal(picture, pictures[0])

    def testTheInterpreterEndsWhatIsStillHeld(self):
        says = "import tessera; scene = tessera.load('spheres'); picture = tessera.render(scene, size=(16, 9)); print('end')"
        result = subprocess.run([sys.executable, "-X", "dev", "-c", says], capture_output=True, text=True, timeout=120)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "end\n", ""))


class Documents(Folder):
    def testTheCodeOfThePageRuns(self):
        page = (REPOSITORY / "docs/python.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.assertGreater(len(blocks), 4)
        result = subprocess.run([sys.executable, "-c", "".join(blocks)], cwd=self.folder, capture_output=True, text=True,
                                timeout=600)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater((self.folder / "hall.exr").stat().st_size, 0)
        self.assertIn("36 36\n", result.stdout)

    def testThePackageForPipHasTheVersionOfTheProject(self):
        try:
            import setuptools  # noqa: F401
        except ImportError:
            self.skipTest("setuptools is missing (Debian 12: apt-get install python3-setuptools)")
        result = subprocess.run([sys.executable, "-B", "setup.py", "--version"], cwd=REPOSITORY / "python", capture_output=True,
                                text=True, timeout=60)
        self.assertEqual(result.stdout.split()[-1], tessera.__version__, result.stderr)


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse((REPOSITORY / "python/tessera.pyi").read_text())

    @staticmethod
    def namesIn(body):
        for node in body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                yield node.name
            elif isinstance(node, ast.AnnAssign):
                yield node.target.id

    def testTheyNameAllOfTheModuleAndNothingElse(self):
        public = {name for name in dir(tessera) if not name.startswith("_")} | {"__version__", "__commit__"}
        self.assertEqual(set(self.namesIn(self.tree.body)) - {"Keywords"}, public)
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef) and node.name in ("Scene", "Picture"):
                named = set(self.namesIn(node.body)) - {"_repr_png_", "__array__"}
                self.assertEqual(named, {name for name in dir(getattr(tessera, node.name)) if not name.startswith("_")})

    def testTheyNameTheSettings(self):
        (keywords,) = [node for node in self.tree.body if isinstance(node, ast.ClassDef) and node.name == "Keywords"]
        self.assertEqual(set(self.namesIn(keywords.body)),
                         {row["keyword"] for row in tessera.settings() + tessera.load_options()})

    def testParametersAreThoseOfTheDocstrings(self):
        for node in self.tree.body:
            if not isinstance(node, ast.FunctionDef):
                continue
            parameters = [one.arg for one in node.args.args + node.args.kwonlyargs]
            signature = getattr(tessera, node.name).__doc__.split(" -> ")[0]
            self.assertTrue(signature.startswith(node.name + "("), signature)
            for parameter in parameters:
                self.assertIn(parameter, signature)

    def testEverythingHasADocstring(self):
        for name in dir(tessera):
            if not name.startswith("__"):
                self.assertTrue(getattr(tessera, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
