// Editing lights and materials, and changing, saving and reopening scenes, through the panels.
#include <algorithm>
#include <csignal>
#include <map>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerEdits : public ViewerTest {
protected:
    /// Opens a built-in scene from the list; returns its whole image.
    static Shot change(const DrivenViewer& viewer, const std::string& builtin) {
        const std::size_t mark = viewer.mark();
        chooseScene(viewer, builtin);
        viewer.waitFor("opened " + builtin, mark);
        return pictureIn(viewer, viewer.waitForWhole(mark));
    }
};

TEST_F(ViewerEdits, aLightSwitchedOffIsSavedAndOnAgainBringsThePictureBackExactly) {
    Shot dark;
    std::string saved;
    {
        DrivenViewer viewer = open(kSpheres);
        const Shot lit = pictureIn(viewer, viewer.waitForWhole(0));
        toggle(viewer, Section::Lights);
        const glm::ivec2 onOff = lightSwitch(viewer, 2);
        dark = after(viewer, [&] { viewer.click(onOff); });
        EXPECT_GT(differingShare(dark, lit, 4), 0.2);
        long long brighter = 0;
        for (std::size_t i = 0; i < dark.rgb.size(); ++i) brighter += dark.rgb[i] > lit.rgb[i] ? 1 : 0;
        EXPECT_EQ(brighter, 0) << "something became brighter without a light";
        saved = saveScene(viewer);
        EXPECT_TRUE(rendered(saved, dark.sizePixels) == dark) << saved;
        EXPECT_TRUE(after(viewer, [&] { viewer.click(onOff); }) == lit);
        // Edits are discarded only by an answer; pressing ctrl+q twice is none.
        const std::size_t mark = viewer.mark();
        for (int i = 0; i < 2; ++i) {
            viewer.key("ctrl+q");
            viewer.waitFor("edits are not saved", mark);
            viewer.pause(0.5);
            EXPECT_NE(viewer.lines().back(), "closed");
        }
        viewer.key("Escape");
        viewer.pause(0.5);
        EXPECT_TRUE(pictureIn(viewer, lit.sizePixels) == lit) << "the dialog stays";
        viewer.key("ctrl+q");
        viewer.pause(0.5);
        viewer.key("d");
        EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
    }
    DrivenViewer again = open({saved});
    EXPECT_TRUE(pictureIn(again, again.waitForWhole(0)) == dark) << "the saved scene does not load back identically";
}

TEST_F(ViewerEdits, anEditIsUndoneAndRedoneByKeys) {
    DrivenViewer viewer = open(kSpheres);
    const Shot lit = pictureIn(viewer, viewer.waitForWhole(0));
    toggle(viewer, Section::Lights);
    const glm::ivec2 onOff = lightSwitch(viewer, 2);
    const Shot dark = after(viewer, [&] { viewer.click(onOff); });
    EXPECT_GT(differingShare(dark, lit, 4), 0.2);
    // Except for the selected light's handles, which are not part of the image.
    EXPECT_LT(differingShare(after(viewer, [&] { viewer.key("ctrl+z"); }), lit), 0.02);
    EXPECT_LT(differingShare(after(viewer, [&] { viewer.key("ctrl+shift+z"); }), dark), 0.02);
    after(viewer, [&] { viewer.key("ctrl+z"); });
    viewer.key("ctrl+q"); // without a question: nothing is edited
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

TEST_F(ViewerEdits, severalLightsAreSelectedInTheListAndDeletedAtOnce) {
    folder_.write("row.json", R"({"tessera": 1, "base": {"file": "builtin:room"}, "lights": [
        {"name": "a", "type": "point", "position": [-1, 1.5, 0], "intensity": 8,
         "falloff": {"type": "inverse_square", "range": 3}},
        {"name": "b", "type": "point", "position": [0, 1.5, 0], "intensity": 8},
        {"name": "c", "type": "point", "position": [0.5, 1.5, 0], "intensity": 8},
        {"name": "d", "type": "point", "position": [1, 1.5, 0], "intensity": 8}]})");
    DrivenViewer viewer = open({"row.json"});
    const Shot lit = pictureIn(viewer, viewer.waitForWhole(0));
    toggle(viewer, Section::Lights);
    viewer.click(lightName(viewer, 0));
    viewer.moveTo(middlePixel());
    viewer.pause(0.5);
    EXPECT_GT(differingShare(pictureIn(viewer, lit.sizePixels), lit), 0.001) << "its range is not drawn";
    viewer.click(lightName(viewer, 1), "shift");
    viewer.click(lightName(viewer, 3), "ctrl");
    const Shot dark = after(viewer, [&] { viewer.key("Delete"); });
    EXPECT_GT(differingShare(dark, lit, 4), 0.2);
    const nlohmann::json lights = readJson(saveScene(viewer)).at("lights");
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights.at(0).at("name"), "c");
    after(viewer, [&] { viewer.key("ctrl+z"); }); // undoes all in one step
    EXPECT_EQ(readJson(saveScene(viewer)).at("lights").size(), 4u);
    viewer.key("ctrl+q");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

TEST_F(ViewerEdits, aLightIsRenamedByF2AndByADoubleClickOnItsName) {
    DrivenViewer viewer = open(kSpheres);
    viewer.waitForWhole(0);
    toggle(viewer, Section::Lights);
    viewer.click(lightName(viewer, 1));
    viewer.pause(0.5);
    viewer.key("F2");
    viewer.pause(0.5);
    viewer.type("lantern");
    viewer.key("Return");
    viewer.pause(0.5);
    viewer.doubleClick(lightName(viewer, 0));
    viewer.pause(0.5);
    viewer.type("sun");
    viewer.key("Return");
    viewer.moveTo(middlePixel());
    viewer.pause(0.5);
    const nlohmann::json lights = readJson(saveScene(viewer)).at("lights");
    EXPECT_EQ(lights.at(0).at("name"), "sun");
    EXPECT_EQ(lights.at(1).at("name"), "lantern");
}

TEST_F(ViewerEdits, editsOfAViewerThatASignalEndsAreOfferedAtTheNextStart) {
    Shot dark;
    {
        DrivenViewer viewer = open({"spheres"});
        viewer.waitForWhole(0);
        toggle(viewer, Section::Lights);
        const glm::ivec2 onOff = lightSwitch(viewer, 2);
        dark = after(viewer, [&] { viewer.click(onOff); });
        viewer.send(SIGTERM);
        EXPECT_EQ(viewer.wait(), std::nullopt) << "it ends by the signal";
    }
    DrivenViewer again = open({"room"});
    again.waitFor("edits were left in ", 0);
    again.waitForWhole(0);
    const std::size_t mark = again.mark();
    again.key("r");
    again.waitFor("recovered ", mark);
    EXPECT_TRUE(pictureIn(again, again.waitForWhole(mark)) == dark);
    // The recovered edits are not saved yet.
    again.key("ctrl+q");
    again.waitFor("edits are not saved", mark);
    again.pause(0.5);
    again.key("d");
    EXPECT_EQ(again.wait(), 0) << again.errors();
    DrivenViewer last = open({"room"});
    last.waitForWhole(0);
    for (const std::string& line : last.lines()) EXPECT_FALSE(line.starts_with("edits were left")) << line;
}

TEST_F(ViewerEdits, aClickRightAfterASaveIsHeard) {
    DrivenViewer viewer = open({"hall", "--lights", "64"}); // its images take longer than the click
    viewer.waitForWhole(0);
    const int below = barOf(viewer, Section::Environment);
    const glm::ivec2 view(200, barOf(viewer, Section::View));
    const std::size_t mark = viewer.mark();
    viewer.key("F12");
    viewer.click(view); // while the image is drawn and written
    viewer.waitFor("saved ", mark);
    viewer.moveTo(middlePixel());
    viewer.pause(1.0);
    EXPECT_LT(barOf(viewer, Section::Environment), below) << "the section above was not closed";
}

TEST_F(ViewerEdits, editsDuringALoadAreNotDiscardedWithoutRequest) {
    const std::string room = R"({"tessera": 1, "base": {"file": "builtin:room"}})";
    folder_.write("slow.json", room);
    DrivenViewer viewer = open({"slow.json"});
    viewer.waitForWhole(0);
    change(viewer, "spheres");
    toggle(viewer, Section::Lights);
    const glm::ivec2 onOff = lightSwitch(viewer, 2);
    folder_.write("slow.json", room + std::string(300'000'000, ' ')); // takes seconds to read
    const std::size_t mark = viewer.mark();
    chooseRecentScene(viewer, 0);
    viewer.waitFor("loading ", mark);
    viewer.click(onOff);
    viewer.waitFor("edits are not saved", mark);
    const std::vector<std::string> lines = viewer.lines();
    EXPECT_TRUE(std::none_of(lines.begin() + std::ptrdiff_t(mark), lines.end(),
                             [](const std::string& line) { return line.starts_with("opened"); }));
    folder_.write("slow.json", room);
    viewer.pause(0.5);
    viewer.key("d");
    viewer.waitFor("opened ", mark);
}

TEST_F(ViewerEdits, anotherVariantOfTheMaterialsKeepsEditsAndTheirHistory) {
    folder_.write("red.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "red"}]}}})");
    folder_.write("painted.json", R"({"tessera": 1, "base": {"file": "builtin:spheres", "lights": 0},
        "include": [{"file": "red.gltf"}], "environment": {"map": "builtin:studio"}})");
    DrivenViewer viewer = open({"painted.json"});
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 aside = middlePixel() + glm::ivec2(150, 0);
    const Shot turned = after(viewer, [&] { viewer.drag(middlePixel(), aside, "shift", 3); }); // the environment
    EXPECT_GT(differingShare(turned, before, 4), 0.1);
    // The list of variants is below the list of scenes, a button and a line; its second entry is the first variant.
    constexpr int kListPixels = 90, kRedPixels = 42;
    const glm::ivec2 list(200, barOf(viewer, Section::Scene) + kListPixels);
    const std::size_t mark = viewer.mark();
    viewer.click(list);
    viewer.click(list + glm::ivec2(0, kRedPixels));
    viewer.moveTo(middlePixel());
    viewer.waitFor("opened ", mark);
    EXPECT_TRUE(pictureIn(viewer, viewer.waitForWhole(mark)) == turned) << "the edit is lost";
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+z"); }) == before);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+y"); }) == turned);
    viewer.key("ctrl+q");
    viewer.waitFor("edits are not saved", mark);
    viewer.pause(0.5);
    viewer.key("d");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

TEST_F(ViewerEdits, aLightAddedAndDraggedGoesWithThePointer) {
    DrivenViewer viewer = open({"room"});
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    const Shot added = after(viewer, [&] { addLight(viewer); });
    EXPECT_GT(differingShare(added, before, 4), 0.3);
    // The light is halfway to the camera's pivot, in the centre of the image.
    const glm::ivec2 middle = kPictureCorner + before.sizePixels / 2, there = middle + glm::ivec2(120, -70);
    const Shot moved = after(viewer, [&] { viewer.drag(middle, there); });
    EXPECT_GT(differingShare(moved, added, 4), 0.2);
    const std::string saved = saveScene(viewer);
    // `render` does not draw the marker with its ring at the pointer, the arms that begin there, and the outline of the
    // light's range.
    constexpr glm::ivec3 kRing(140, 195, 255);
    constexpr double kAboutPixels = 30.0;
    constexpr int kSmoothed = 24; // tolerance for inner pixels blended with the rims
    const Shot without = rendered(saved, moved.sizePixels);
    const Shot with = pictureIn(viewer, moved.sizePixels);
    glm::dvec2 sum(0.0);
    double count = 0.0, ringCount = 0.0;
    for (int y = 0; y < with.sizePixels.y; ++y)
        for (int x = 0; x < with.sizePixels.x; ++x)
            if (with.at({x, y}) != without.at({x, y})) {
                count += 1.0;
                if (glm::distance(glm::dvec2(x, y), glm::dvec2(there - kPictureCorner)) > kAboutPixels) continue;
                const glm::ivec3 off = glm::abs(with.at({x, y}) - kRing);
                if (glm::any(glm::greaterThan(off, glm::ivec3(kSmoothed)))) continue;
                sum += glm::dvec2(x, y);
                ringCount += 1.0;
            }
    ASSERT_GT(ringCount, 20.0) << "there is no marker"; // the ring has 56 along the middle of its width
    EXPECT_LT(count, 6000.0) << "more than a marker, its arms and its range differs from what was saved";
    EXPECT_LT(glm::distance(sum / ringCount, glm::dvec2(there - kPictureCorner)), 4.0);
}

/// Rows of the selected light's editor in the section of lights; row 1 is the first below the buttons. For a point
/// light.
enum PointLightRow { kMovesRow = 8, kWayRow = 9, kKeysOfIntensityRow = 11, kFirstPointRow = 10, kClosedRow = 15 };
constexpr int kCheckboxX = 120, kAddKeyX = 140, kKeyTimeX = 40;

class ViewerLightLife : public ViewerEdits {
protected:
    /// Opens a viewer at 1.5 s whose section of lights shows the scene's only light, with space for all its rows.
    DrivenViewer openLight() {
        folder_.write("lamp.json", R"({
            "tessera": 1,
            "base": {"file": "builtin:room"},
            "lights": [{"name": "lamp", "type": "point", "position": [0, 1.5, 0], "intensity": 8}]
        })");
        DrivenViewer viewer = open({"lamp.json", "--time", "1.5"});
        viewer.waitForWhole(0);
        for (const Section closed : {Section::View, Section::Technique, Section::Scene}) toggle(viewer, closed);
        toggle(viewer, Section::Lights);
        viewer.click(lightName(viewer, 0));
        viewer.pause(0.5);
        return viewer;
    }
    nlohmann::json savedLight(const DrivenViewer& viewer) { return readJson(saveScene(viewer)).at("lights").at(0); }
    static void undoOnce(const DrivenViewer& viewer) {
        viewer.moveTo(middlePixel());
        viewer.key("ctrl+z");
        viewer.pause(0.5);
    }
};

TEST_F(ViewerLightLife, aKeyIsAddedAtTheTimeThatIsShownDraggedInTimeSavedAndUndone) {
    DrivenViewer viewer = openLight();
    viewer.click(inLightRow(viewer, kKeysOfIntensityRow, kAddKeyX));
    viewer.pause(0.5);
    nlohmann::json light = savedLight(viewer);
    ASSERT_TRUE(light.contains("keyframes")) << light;
    EXPECT_EQ(light.at("keyframes").at("intensity").at("times"), nlohmann::json::array({1.5})) << light;
    EXPECT_EQ(light.at("keyframes").at("intensity").at("values"), nlohmann::json::array({8.0})) << light;
    const glm::ivec2 time = inLightRow(viewer, kKeysOfIntensityRow + 1, kKeyTimeX);
    viewer.drag(time, time + glm::ivec2(50, 0));
    viewer.pause(0.5);
    light = savedLight(viewer);
    EXPECT_GT(light.at("keyframes").at("intensity").at("times").at(0).get<double>(), 1.9) << light;
    undoOnce(viewer);
    light = savedLight(viewer);
    EXPECT_EQ(light.at("keyframes").at("intensity").at("times"), nlohmann::json::array({1.5})) << "the drag is a step";
    undoOnce(viewer);
    EXPECT_FALSE(savedLight(viewer).contains("keyframes"));
}

TEST_F(ViewerLightLife, aPathIsChosenOpenedItsPointsDraggedSavedAndUndone) {
    DrivenViewer viewer = openLight();
    viewer.click(inLightRow(viewer, kMovesRow, kCheckboxX));
    viewer.pause(0.5);
    EXPECT_EQ(savedLight(viewer).at("animation").at("type"), "orbit");
    const glm::ivec2 way = inLightRow(viewer, kWayRow, 200);
    constexpr int kFirstEntry = 24, kEntry = 18, kPath = 2; // orbit, wobble, path, keyframes
    viewer.click(way);
    viewer.click(way + glm::ivec2(0, kFirstEntry + kPath * kEntry));
    viewer.pause(0.5);
    nlohmann::json path = savedLight(viewer).at("animation");
    EXPECT_EQ(path.at("type"), "path") << path;
    EXPECT_FALSE(path.contains("open"));
    ASSERT_EQ(path.at("points").size(), 4u);
    viewer.click(inLightRow(viewer, kClosedRow, kCheckboxX));
    const glm::ivec2 x = inLightRow(viewer, kFirstPointRow + 1, 125); // x of the second point
    viewer.drag(x, x + glm::ivec2(60, 0));
    viewer.pause(0.5);
    const nlohmann::json edited = savedLight(viewer).at("animation");
    EXPECT_EQ(edited.value("open", false), true) << edited;
    EXPECT_GT(edited.at("points").at(1).at(0).get<double>(), path.at("points").at(1).at(0).get<double>() + 0.01);
    EXPECT_EQ(edited.at("points").at(0), path.at("points").at(0));
    for (int i = 0; i < 2; ++i) undoOnce(viewer);
    EXPECT_EQ(savedLight(viewer).at("animation"), path);
}

TEST_F(ViewerEdits, aMaterialPickedByAClickAndEditedIsSaved) {
    DrivenViewer viewer = open(kSpheres);
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    pickSphere(viewer, before.sizePixels);
    constexpr int kMetallicRow = 4;
    const glm::ivec2 middle = inRow(viewer, Section::Materials, kMetallicRow, 200);
    const std::size_t edited = viewer.mark();
    viewer.drag(middle, {kPanelPixels - 2, middle.y}); // past the slider's end, with or without a scroll bar
    viewer.waitFor("outlined metalness 0/4, roughness 4/10", edited);
    const Shot outlined = pictureIn(viewer, viewer.waitForWhole(edited));
    toggle(viewer, Section::Materials); // removes the outline
    const Shot metal = pictureIn(viewer, outlined.sizePixels);
    EXPECT_GT(differingShare(outlined, metal), 0.0005) << "the sphere has no outline";
    EXPECT_LT(differingShare(outlined, metal), 0.01) << "more than an outline";
    const double share = differingShare(metal, before, 4);
    EXPECT_GT(share, 0.005) << "nothing became metal";
    EXPECT_LT(share, 0.03) << "more than the one sphere changed";
    const std::string saved = saveScene(viewer);
    EXPECT_TRUE(rendered(saved, metal.sizePixels) == metal);
    EXPECT_NE(readJson(saved).dump().find("\"metallic\":1"), std::string::npos) << readJson(saved);
}

TEST_F(ViewerEdits, aSceneChosenFromTheListOpensAndKeepsTheTechnique) {
    DrivenViewer viewer = open({"room", "--technique", "forward_plus"});
    viewer.waitForWhole(0);
    const Shot spheres = change(viewer, "spheres");
    EXPECT_TRUE(spheres ==
                rendered(asOpened("spheres", spheres.sizePixels) + " --technique forward_plus", spheres.sizePixels));
    const Shot models = change(viewer, "models");
    EXPECT_TRUE(models ==
                rendered(asOpened("models", models.sizePixels) + " --technique forward_plus", models.sizePixels));
}

TEST_F(ViewerEdits, aSceneThatCannotBeReadNeverTakesTheOneThatIsOpen) {
    const std::string good = R"({"tessera": 1, "base": {"file": "builtin:lattice"}})";
    folder_.write("other.json", good);
    DrivenViewer viewer = open({"other.json"});
    viewer.waitForWhole(0);
    const Shot room = change(viewer, "room");
    // Reading takes so long that nothing else changes in the window when it fails.
    folder_.write("other.json", good.substr(0, 20) + std::string(30'000'000, ' '));
    const std::size_t mark = viewer.mark();
    chooseRecentScene(viewer, 0);
    const std::string said = viewer.waitFor("error ", mark);
    EXPECT_NE(said.find("other.json"), std::string::npos) << said;
    viewer.pause(1.0);
    const Shot failed = pictureIn(viewer, room.sizePixels);
    const glm::ivec2 upper(room.sizePixels.x, room.sizePixels.y * 3 / 4);
    EXPECT_TRUE(failed.part({0, 0}, upper) == room.part({0, 0}, upper));
    EXPECT_GT(differingShare(failed, room), 0.01) << "nothing is said in the window";
    viewer.key("Escape");
    viewer.pause(0.5);
    EXPECT_TRUE(pictureIn(viewer, room.sizePixels) == room);
    // The viewer still works: the camera moves.
    EXPECT_GT(differingShare(after(viewer, [&] { viewer.drag(middlePixel(), middlePixel() + glm::ivec2(150, 60)); }),
                             room, 4),
              0.2);
}

TEST_F(ViewerEdits, aTraceIsJsonThatHoldsThePassesOfTheFrames) {
    DrivenViewer viewer = open({"room", "--technique", "deferred"});
    viewer.waitForWhole(0);
    toggle(viewer, Section::View);
    toggle(viewer, Section::Save);
    const std::size_t mark = viewer.mark();
    viewer.click(inRow(viewer, Section::Save, 3, 60));
    const nlohmann::json trace = readJson(savedFile(viewer.waitFor("saved ", mark)));
    std::map<std::string, int> seen;
    for (const nlohmann::json& event : trace.at("traceEvents"))
        if (event.value("ph", "") == "X") {
            ++seen[event.at("name").get<std::string>()];
            EXPECT_GE(event.at("dur").get<double>(), 0.0);
        }
    for (const char* pass : {"gbuffer", "deferred_lighting", "display"}) EXPECT_GE(seen[pass], 2) << pass;
}

} // namespace
} // namespace tessera::test
