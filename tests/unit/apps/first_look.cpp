#include "apps/FirstLook.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/Error.h"

namespace tessera::app {
namespace {

using engine::Technique;

scenes::Scene sceneRequesting(const std::map<std::string, scenes::OptionValue>& requested = {}) {
    scenes::Scene scene;
    scene.cameras.emplace_back().name = "front";
    scene.options.requested.insert(requested.begin(), requested.end());
    return scene;
}

viewer::Preferences remembered() {
    viewer::Preferences preferences;
    preferences.settings = {{"technique", "forward_plus"}, {"layout", "slim"}, {"toneMap", "agx"},
                            {"culling", "tile_2.5d"},      {"tile", "32"},     {"samples", "4"}};
    return preferences;
}

frame::GBufferLayout layoutNamed(std::string_view name) {
    for (const frame::LayoutInfo& info : frame::layoutTable())
        if (info.name == name) return info.layout;
    throw InputError("no such layout");
}

TEST(FirstLook, preferencesApplyWithoutOptionsOfUserAndScene) {
    const viewer::Look look = firstLook({}, remembered(), sceneRequesting(), "x.json").look;
    EXPECT_EQ(look.technique, Technique::ForwardPlus);
    EXPECT_EQ(look.settings.layout, layoutNamed("slim"));
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Agx);
    EXPECT_EQ(look.settings.culling.method, culling::Method::Tile25d);
    EXPECT_EQ(look.settings.culling.tilePixels, 32);
    EXPECT_EQ(look.settings.samples, 4);
}

TEST(FirstLook, theScenesOptionsOverridePreferences) {
    const scenes::Scene scene = sceneRequesting({{"technique", "forward"}, {"layout", "exact"}, {"toneMap", "aces"}});
    const viewer::Look look = firstLook({}, remembered(), scene, "x.json").look;
    EXPECT_EQ(look.technique, Technique::Forward);
    EXPECT_EQ(look.settings.layout, layoutNamed("exact"));
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Aces);
    EXPECT_EQ(look.settings.samples, 4) << "of which it says nothing";
    EXPECT_FALSE(look.settings.culling.tilePixels) << "forward has no tiles";
    EXPECT_EQ(viewer::requested(look).settings.culling.tilePixels, 32);
}

TEST(FirstLook, preferencesOverrideWhatTheSceneWasGivenByDefault) {
    scenes::Scene scene = sceneRequesting({{"toneMap", "khronos_neutral"}});
    scene.supplied.requested = {"toneMap"};
    EXPECT_EQ(firstLook({}, remembered(), scene, "x.glb").look.settings.toneMap, frame::ToneMap::Agx);
    EXPECT_EQ(firstLook({}, {}, scene, "x.glb").look.settings.toneMap, frame::ToneMap::KhronosNeutral);
}

TEST(FirstLook, theCommandLineOverridesSceneAndPreferences) {
    FrameOptions said;
    said.settings = {{"technique", "deferred"}, {"toneMap", "aces"}, {"samples", "1"}};
    const viewer::Look look = firstLook(said, remembered(), sceneRequesting({{"technique", "forward"}}), "x.json").look;
    EXPECT_EQ(look.technique, Technique::Deferred);
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Aces);
    EXPECT_EQ(look.settings.samples, 1);
    EXPECT_EQ(viewer::requested(look).settings.samples, 1);
}

TEST(FirstLook, aRememberedNameThatThereIsNoMoreIsAsIfNothingWere) {
    viewer::Preferences preferences;
    preferences.settings = {{"technique", "raster_of_old"}, {"tile", "7"}, {"samples", "3"}, {"toneMap", "agx"}};
    const viewer::Look look = firstLook({}, preferences, sceneRequesting(), "x.json").look;
    viewer::Look expected = firstLook({}, {}, sceneRequesting(), "x.json").look;
    expected.settings.toneMap = frame::ToneMap::Agx;
    EXPECT_EQ(look, expected);
}

TEST(FirstLook, optionsThatNameThingsOfTheFirstSceneDoNotApplyToAnother) {
    FrameOptions said;
    said.settings = {{"camera", "side"}, {"solo", "3"}, {"technique", "forward"}};
    said.pose.fovYDegrees = 30.0;
    EXPECT_THROW(firstLook(said, {}, sceneRequesting(), "x.json"), InputError);
    const viewer::FirstLook first = firstLook(forAnyScene(said), {}, sceneRequesting(), "x.json");
    EXPECT_EQ(first.look.technique, Technique::Forward);
    EXPECT_EQ(first.look.settings.camera, 0);
    EXPECT_FALSE(first.look.settings.soloLight);
    EXPECT_EQ(first.pose, scenes::CameraChange());
    said.defaultCamera = true;
    EXPECT_FALSE(forAnyScene(said).defaultCamera);
}

TEST(FirstLook, aCameraOfTheSceneAndTheOneInItsPlaceAreRefusedTogether) {
    FrameOptions said;
    said.defaultCamera = true;
    EXPECT_NO_THROW(resolveWithoutScene(said));
    said.settings["camera"] = "0";
    EXPECT_THROW(resolveWithoutScene(said), InputError);
    said.defaultCamera = false;
    EXPECT_NO_THROW(resolveWithoutScene(said));
}

TEST(FirstLook, theMostExposureOfTheWindowIsExactlyThatOfTheCommandLine) {
    FrameOptions options;
    for (const double sign : {-1.0, 1.0}) {
        options.settings["exposureEV"] = fmt::format("{}", sign * double(frame::kMostExposureEV));
        EXPECT_NO_THROW(resolveWithoutScene(options));
        options.settings["exposureEV"] = fmt::format("{}", sign * (double(frame::kMostExposureEV) + 0.1));
        EXPECT_THROW(resolveWithoutScene(options), InputError);
    }
}

} // namespace
} // namespace tessera::app
