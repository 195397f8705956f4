#include "viewer/session/DrawnLook.h"

#include <set>
#include <string>

#include "tests/unit/viewer/Scenes.h"
#include "viewer/edit/Brightness.h"

namespace tessera::viewer {
namespace {

/// A dim lamp, a brighter one, and a still brighter one that is off, above the camera's target.
State lamps() {
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights.assign(3, {});
    const CameraPose home = poseOf(scene.cameras.front(), 2.0);
    const glm::dvec3 targetWS = home.eyeWS + 2.0 * home.heading.forwardWS();
    for (std::size_t i = 0; i < 3; ++i) {
        scene.lights[i].name = "lamp " + std::to_string(i);
        scene.lights[i].positionWS = targetWS + glm::dvec3(0.0, 1.0, 0.0);
        scene.lights[i].intensity = float(1 + i);
    }
    scene.lights[2].enabled = false;
    return test::stateOf(std::move(scene));
}

TEST(DrawnLook, viewsOfATermShowTheSelectedLightElseTheBrightest) {
    State state = lamps();
    for (const frame::DebugViewInfo& info : frame::debugViewTable()) {
        state.looks[0].settings.view = info.view;
        const bool isOfOne = info.name == "distribution" || info.name == "geometry" || info.name == "fresnel";
        const auto shown = [&] { return drawnLook(state, 0).settings.soloLight; };
        state.selectedLight = scenes::kNone;
        EXPECT_EQ(shown(), isOfOne ? std::optional(1) : std::nullopt) << info.name;
        state.selectedLight = 0;
        EXPECT_EQ(shown(), isOfOne ? std::optional(0) : std::nullopt) << info.name;
        state.selectedLight = 2;
        EXPECT_EQ(shown(), isOfOne ? std::optional(1) : std::nullopt) << "one that is off shows nothing";
        state.looks[0].settings.soloLight = 2;
        EXPECT_EQ(shown(), 2) << "the user's own";
        state.looks[0].settings.soloLight.reset();
    }
}

TEST(DrawnLook, theBrightestLightIsTheBrightestThere) {
    std::vector<scenes::Light> lights(2);
    lights[0].positionWS = {1.0, 0.0, 0.0};
    lights[1].positionWS = {10.0, 0.0, 0.0};
    lights[1].intensity = 50.0f * lights[0].intensity;
    EXPECT_EQ(brightestAt(lights, {0, 0, 0}, 0.0), 0) << "a hundredth of the distance squared";
    EXPECT_EQ(brightestAt(lights, {8, 0, 0}, 0.0), 1);
    lights[0].rangeMetres = 0.5f;
    EXPECT_EQ(brightestAt(lights, {0, 0, 0}, 0.0), 1) << "the other ends before";
    lights[1].type = scenes::LightType::Spot;
    lights[1].directionWS = {1.0, 0.0, 0.0};
    EXPECT_EQ(brightestAt(lights, {0, 0, 0}, 0.0), std::nullopt) << "and this one points away";
    lights[1].directionWS = {-1.0, 0.0, 0.0};
    EXPECT_EQ(brightestAt(lights, {0, 0, 0}, 0.0), 1);
}

TEST(DrawnLook, aTermIsNamedWithItsLight) {
    State state = lamps();
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    state.looks[0].technique = engine::Technique::Forward;
    state.looks[0].settings.view = frame::DebugView::Geometry;
    EXPECT_EQ(lookName(drawnLook(state, 0), &lights), "forward / geometry of lamp 1");
    EXPECT_EQ(lookName(drawnLook(state, 0)), "forward / geometry");
    state.looks[0].settings.soloLight = 9; // deleted since
    EXPECT_EQ(lookName(drawnLook(state, 0), &lights), "forward / geometry");
}

TEST(DrawnLook, everyViewHasALineOfMeaning) {
    std::set<std::string> meanings;
    for (const frame::DebugViewInfo& info : frame::debugViewTable()) {
        const std::string meaning = viewMeaning(info.view);
        EXPECT_TRUE(meanings.insert(meaning).second) << info.name << " means the same as another: " << meaning;
        // Views of one light show the selected or the brightest one, not the light that the command line chooses.
        const bool namesPanel = meaning.find("the panel Lights selects another") != std::string::npos;
        EXPECT_EQ(namesPanel, showsTermOfOne(info.view)) << meaning;
        const bool saysDark = viewMeaning(info.view, false).find("no light is on") != std::string::npos;
        EXPECT_EQ(saysDark, showsTermOfOne(info.view)) << meaning;
    }
}

TEST(DrawnLook, twoSidesAreNamedByWhatDiffers) {
    Look left, right;
    left.technique = right.technique = engine::Technique::ForwardPlus;
    using Names = std::array<std::string, 2>;
    EXPECT_EQ(sideNames(left, right), (Names{"forward_plus / final", "forward_plus / final"}));
    right.settings.samples = 4;
    EXPECT_EQ(sideNames(left, right), (Names{"forward_plus, samples 1", "forward_plus, samples 4"}));
    right.technique = engine::Technique::Deferred;
    right.settings.samples = 1;
    right.settings.sizePixels /= 2;
    EXPECT_EQ(sideNames(left, right), (Names{"forward_plus", "deferred"})) << "a size on its way is no difference";
    right.settings.view = frame::DebugView::Normal;
    EXPECT_EQ(sideNames(left, right), (Names{"forward_plus / final", "deferred / normal"}));
}

} // namespace
} // namespace tessera::viewer
