"""The checks of this folder find what they are there to find."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))

import check_assets
import check_batches
import check_clang
import check_floors
import check_packages
import check_reference
import check_words
import run_document


class Assets(unittest.TestCase):
    SOURCE = """class Scan : public GlTest {
    void SetUp() override {
        if (!assets) GTEST_SKIP() << "TESSERA_ASSETS is not set";
    }
};
TEST_F(Scan, isThere) {
}
TEST(Models, areDrawn) {
    if (!file) GTEST_SKIP() << "there is no folder of third-party models";
}
TEST(Driver, isNew) {
    if (!driver) GTEST_SKIP() << "the driver is old";
}
"""

    def testATestThatIsSkippedWithoutModelsNeedsARow(self):
        skipped = check_assets.skippedIn(self.SOURCE)
        self.assertEqual(skipped, {"Scan.isThere", "Models.areDrawn"})
        rows = [["scan", "`Scan.isThere`", "`Plane.isThere`"], ["models", "`Models.areDrawn`", "nothing"]]
        self.assertEqual(check_assets.faultsOf(skipped, rows), [])
        self.assertEqual(len(check_assets.faultsOf(skipped, rows[:1])), 1)
        self.assertEqual(len(check_assets.faultsOf(skipped, [["scan", "`Scan.isThere`", "`Models.areDrawn`"], rows[1]])), 1)


class Batches(unittest.TestCase):
    GUESTS = check_batches.guestsOf({
        "tests/CMakeLists.txt": """tessera_test(test_unit unit unit SLOW ${floors})
            foreach(part Numbers # of a line
                    Outputs)
                target_sources(test_unit PRIVATE ${PROJECT_SOURCE_DIR}/apps/${part}.cpp)
            endforeach()
            tessera_test(test_viewer cli viewer)
            target_sources(test_viewer PRIVATE support/Process.cpp support/Screen.cpp)""",
        "python/CMakeLists.txt": "target_sources(tessera_python PRIVATE ${PROJECT_SOURCE_DIR}/viewer/save/OptionText.cpp)"})

    def faults(self, first, second, where=("apps/A.cpp", "apps/B.cpp")):
        wrapped = [f"namespace tessera::app {{\nnamespace {{\n{text}\n}} // namespace\n}} // namespace tessera::app\n"
                   for text in (first, second)]
        return check_batches.faultsOf(dict(zip(where, wrapped)), self.GUESTS)

    def testANameThatTwoSourcesOfATargetDefineIsNamedWithBothPlaces(self):
        self.assertEqual(self.faults("constexpr int kSteps = 4;", "\nconstexpr double kSteps[] = {0.5};"),
                         ["apps/B.cpp:4: kSteps has the name of that of apps/A.cpp:3, which may be compiled in one batch with it"])
        for text in ("struct Row {", "template <class T>\nT sum(T a, T b = 0) {", "std::string sum(const std::vector<int>& a,\n   int b) {"):
            self.assertEqual(len(self.faults(text, text)), 1, text)

    def testSourcesThatATargetTakesFromElsewhereAreItsOwnToo(self):
        self.assertEqual(self.GUESTS, {"tests/unit": {"apps/Numbers.cpp", "apps/Outputs.cpp"},
                                       "tests/viewer": {"tests/support/Process.cpp", "tests/support/Screen.cpp"},
                                       "python": {"viewer/save/OptionText.cpp"}})
        self.assertEqual(len(self.faults("struct Row {", "struct Row {", ("apps/Outputs.cpp", "tests/unit/apps/A.cpp"))), 1)
        self.assertEqual(len(self.faults("struct Row {", "struct Row {", ("tests/support/Process.cpp", "tests/viewer/A.cpp"))), 1)
        self.assertEqual(self.faults("struct Row {", "struct Row {", ("apps/main.cpp", "tests/unit/apps/A.cpp")), [])

    def testOverloadsMembersDeclarationsAndOtherTargetsAreNoFaults(self):
        self.assertEqual(self.faults("int sum(int a) {", "int sum(int a, int b) {"), [])
        self.assertEqual(self.faults("class A {\nprivate:\n    int sum() { return 1; }\n};",
                                     "class B {\nprivate:\n    int sum() { return 1; }\n};"), [])
        self.assertEqual(self.faults("int sum(int a);", "int sum(int a);"), [])
        self.assertEqual(self.faults('const char* kA = R"(\nvoid main() {\n)";', 'const char* kB = R"(\nvoid main() {\n)";'), [])
        self.assertEqual(self.faults("struct Row {", "struct Row {", ("apps/A.cpp", "viewer/B.cpp")), [])


class Clang(unittest.TestCase):
    def testEachWantedSourceIsCompiledOnceToNothing(self):
        def entry(target, name):
            return {"directory": "/b", "file": f"/s/{name}", "command": f"ccache /usr/bin/c++ -DA=1 -O1 -o x/CMakeFiles/{target}.dir/{name}.o -c /s/{name}"}

        entries = [entry("tessera_base", "a.cpp"), entry("tessera_glad", "gl.c"), entry("fuzz_gltf", "One.cpp"), entry("fuzz_glb", "One.cpp"),
                   entry("tessera_base_verify_interface_header_sets", "A.h.cxx")]
        commands = check_clang.commandsOf(entries, [], "clang++", ["-Werror"])
        self.assertEqual([command[-1 - len(check_clang.FOREIGN) - 2] for _, command in commands], ["/s/a.cpp", "/s/One.cpp"])
        self.assertEqual(check_clang.commandsOf(entries, ["fuzz_gltf"], "clang++", ["-Werror"]),
                         [("/b", ["clang++", "-DA=1", "-O1", "-c", "/s/One.cpp", *check_clang.FOREIGN, "-Werror", "-fsyntax-only"])])


class Floors(unittest.TestCase):
    def messages(self, files):
        """What check_floors says of a repository holding `files` (path: text)."""
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            return [message for path in files for message in check_floors.checkFile(root, root / path)]

    def testAnIncludeUpwardsIsAlwaysNamedWithItsLine(self):
        self.assertEqual(
            self.messages({"scenes/A.cpp": '#include "scenes/A.h"\n#include "renderer/gpu/B.h"\n'}),
            ["scenes/A.cpp:2: includes renderer/gpu/B.h: scenes may include base; "
             "renderer/gpu is not below it"])

    def testANeighbourIncludedByItsBareNameIsNeverMistakenForAnotherFloor(self):
        self.assertEqual(self.messages({"shaders/shared/a.h": '#include "b.h"\n', "shaders/shared/b.h": ""}), [])
        self.assertEqual(len(self.messages({"renderer/graph/A.h": '#include "../gpu/B.h"\n', "renderer/gpu/B.h": ""})), 1)

    def testTheReferenceNeverIncludesAnythingOfTheProductButTheScene(self):
        self.assertEqual(self.messages({"validation/reference/A.cpp": '#include "scenes/Scene.h"\n'}), [])
        self.assertEqual(self.messages({"validation/A.cpp": '#include "validation/reference/Render.h"\n'}), [])
        for path in ("shaders/shared/models.h", "renderer/frame/LightRange.h", "base/Srgb.h"):
            self.assertEqual(len(self.messages({"validation/reference/A.cpp": f'#include "{path}"\n'})), 1)

    def testAPassNeverIncludesAnotherPass(self):
        self.assertEqual(
            self.messages({"passes/ForwardPass.cpp": '#include "passes/ForwardPass.h"\n#include "passes/DepthPrepass.h"\n'}),
            ["passes/ForwardPass.cpp:2: includes passes/DepthPrepass.h: "
             "a pass does not know another pass; let the engine wire them"])
        self.assertEqual(len(self.messages({"passes/ForwardPass.h": '#include "engine/Renderer.h"\n'})), 1)
        self.assertEqual(self.messages({"engine/R.cpp": '#include "passes/ForwardPass.h"\n'}), [])

    def testOpenGlIsAlwaysKeptInTheSourcesOfRendererGpu(self):
        line = "#include <glad/gl.h>\n"
        self.assertEqual(self.messages({"renderer/gpu/Buffer.cpp": line}), [])
        self.assertEqual(
            self.messages({"renderer/gpu/Buffer.h": line}),
            ["renderer/gpu/Buffer.h:1: includes glad/gl.h: "
             "OpenGL stays inside the sources of renderer/gpu; use its wrapper"])
        self.assertEqual(len(self.messages({"passes/A.cpp": line, "validation/B.cpp": line, "apps/C.cpp": line})), 3)

    def cycles(self, files):
        """What check_floors says of the folders of a repository holding `files` (path: text)."""
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            return check_floors.cyclesOf(root, [root / path for path in files])

    def testFoldersOfOneFloorThatIncludeEachOtherAreAlwaysNamed(self):
        self.assertEqual(
            self.cycles({"viewer/a/A.h": '#include "viewer/b/B.h"\n', "viewer/b/B.h": "", "viewer/b/C.cpp": '#include "viewer/a/A.h"\n'}),
            ["viewer/b/C.cpp:1: includes viewer/a/A.h: folders include each other: viewer/a -> viewer/b -> viewer/a"])
        self.assertEqual(
            self.cycles({"shaders/lib/a/x.glsl": '#include "lib/b/y.glsl"\n', "shaders/lib/b/y.glsl": '#include "lib/c/z.glsl"\n',
                         "shaders/lib/c/z.glsl": '#include "lib/a/x.glsl"\n'}),
            ["shaders/lib/c/z.glsl:1: includes shaders/lib/a/x.glsl: folders include each other: "
             "shaders/lib/a -> shaders/lib/b -> shaders/lib/c -> shaders/lib/a"])

    def testFoldersThatLeadToOthersOneWayAndAFolderWithItsOwnAreNoFault(self):
        self.assertEqual(self.cycles({"viewer/a/A.h": '#include "viewer/b/B.h"\n', "viewer/b/B.h": '#include "viewer/c/C.h"\n',
                                      "viewer/a/D.h": '#include "viewer/c/C.h"\n', "viewer/c/C.h": ""}), [])
        self.assertEqual(self.cycles({"scenes/Load.cpp": '#include "scenes/import/I.h"\n', "scenes/import/I.h": '#include "scenes/S.h"\n',
                                      "scenes/S.h": ""}), [])

    def testTheGraphNeverIncludesTheGpu(self):
        self.assertEqual(len(self.messages({"renderer/graph/A.cpp": '#include "renderer/gpu/Buffer.h"\n'})), 1)
        self.assertEqual(self.messages({"renderer/gpu/A.cpp": '#include "renderer/graph/Graph.h"\n'}), [])


class Packages(unittest.TestCase):
    table = "# comment\nlibfmt-dev build fmt text\ng++ build - compiler\n"

    def testALibraryOnOneSideOnlyIsAlwaysNamed(self):
        self.assertEqual(check_packages.faultsOf(self.table, {"dependencies": ["fmt"]}), [])
        self.assertEqual(
            check_packages.faultsOf(self.table, {"dependencies": [{"name": "glm"}]}),
            ["vcpkg.json: lacks fmt, which tools/packages.txt gives for Debian's libfmt-dev",
             "tools/packages.txt: names no Debian package for glm of vcpkg.json"])

    def testALineWithoutItsColumnsIsAlwaysNamed(self):
        self.assertEqual(
            check_packages.faultsOf("g++\n", {"dependencies": []}),
            ["tools/packages.txt:1: a line is: package, set (build, test, package, python, cluster, fit, zink, fuzz), vcpkg port or -, what for"])


class Reference(unittest.TestCase):
    TABLES = """x
## What both sides share

| headers | what | between |
|---|---|---|
| `scenes/Scene.h` `scenes/Light.h` | data | `Room.isClosed` |

| step | between |
|---|---|
| decoding | nothing |

## Next
| `scenes/Other.h` | | |
"""

    def testAHeaderBeyondTheTableIsNamedHoweverItIsReached(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in {"validation/reference/A.cpp": '#include "validation/reference/B.h"\n#include "scenes/Scene.h"\n',
                               "validation/reference/B.h": "#include <vector>\n", "scenes/Scene.h": '#include "scenes/Light.h"\n',
                               "scenes/Light.h": '#include "../shaders/shared/light.h"\n', "shaders/shared/light.h": ""}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            included = check_reference.includedBy(root)
        self.assertEqual(check_reference.faultsOf(included, check_reference.rowsIn(self.TABLES)),
                         ["scenes/Light.h: includes shaders/shared/light.h, which stands in no row of docs/reference.md"])

    def testRowsOfWhatIsNotSharedOrHasNothingBetweenAreNamed(self):
        included = {"scenes/Scene.h": "a", "scenes/Light.h": "a"}
        faults = lambda old, new: check_reference.faultsOf(included, check_reference.rowsIn(self.TABLES.replace(old, new)))
        self.assertEqual(faults("", ""), [])
        self.assertEqual(faults("`scenes/Light.h`", "`scenes/Light.h` `scenes/Sky.h`"),
                         ["docs/reference.md: lists scenes/Sky.h, which validation/reference does not include"])
        self.assertEqual(len(faults("`Room.isClosed`", "the room")), 1)
        self.assertEqual(len(faults("| decoding | nothing |", "| decoding | |")), 1)


class Documents(unittest.TestCase):
    def testExactlyTheLinesOfShBlocksAreCommands(self):
        text = "```sh\n# why\none \\\n  two\n\nthree\n```\n```console\nfour\n```\nfive\n  ```sh\n  six\n  ```\n"
        self.assertEqual(run_document.commandsOf(text), [(3, "one two"), (6, "three"), (13, "six")])

    def testACommandIsNeverLeftOutForItsBeginningAlone(self):
        self.assertEqual(run_document.limited("render a --size 320x180 -o b", "160x90"), "render a --size 160x90 -o b")
        self.assertEqual(run_document.limited("render a --size 120x120", "160x90"), "render a --size 120x120")
        self.assertEqual(run_document.limited("render a --size 320x180", None), "render a --size 320x180")
        self.assertIsNone(run_document.exceptionOf("./tester"))
        self.assertIsNone(run_document.exceptionOf("tessera render hall -o view.png"))
        self.assertIsNotNone(run_document.exceptionOf("./test -R Graph   # one test"))


class Words(unittest.TestCase):
    def testCoinedWordsAreFoundInCommentsAlone(self):
        source = 'int wish = 0; // told once\nlog("told");\n/* the leeway\n of it */ const char* t = R"(// told)"; // `leeway`\n'
        faults = list(check_words.faultsOf("a.cpp", check_words.commentsOf(source)))
        self.assertEqual([fault.split(";")[0] for fault in faults], ["a.cpp:1: 'told'", "a.cpp:3: 'leeway'"])

    def testCoinedWordsAreFoundInNamesAndStrings(self):
        source = 'int heeds_size;\nlog("was asked");\nvoid isToldWhy(); // task\nauto ofWhat = mask;\n'
        faults = list(check_words.faultsOf("a.cpp", check_words.wordsOf(source), check_words.OF_WHAT))
        self.assertEqual([fault.split(";")[0] for fault in faults], ["a.cpp:1: 'heeds'", "a.cpp:2: 'asked'", "a.cpp:3: 'Told'"])

    def testBlocksOfCodeInDocumentsAreFree(self):
        text = "The user is told.\n```\nit tells\n```\n`heeds` is a name.\n"
        faults = list(check_words.faultsOf("a.md", check_words.proseOf(text)))
        self.assertEqual([fault.split(";")[0] for fault in faults], ["a.md:1: 'told'"])


if __name__ == "__main__":
    unittest.main()
