#include "apps/FirstLook.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/Error.h"

namespace tessera::app {
namespace {

using engine::Technique;

scenes::Scene wishing(const scenes::SceneOptions& options) {
    scenes::Scene scene;
    scene.cameras.emplace_back().name = "front";
    scene.options = options;
    return scene;
}

viewer::Preferences remembered() {
    viewer::Preferences preferences;
    preferences.settings["technique"] = "forward_plus";
    preferences.settings["layout"] = "slim";
    preferences.settings["toneMap"] = "agx";
    preferences.settings["culling"] = "tile_2.5d";
    preferences.settings["tile"] = "32";
    preferences.settings["samples"] = "4";
    return preferences;
}

frame::GBufferLayout layoutNamed(std::string_view name) {
    for (const frame::LayoutInfo& info : frame::layoutTable())
        if (info.name == name) return info.layout;
    throw InputError("no such layout");
}

TEST(FirstLook, preferencesApplyWithoutOptionsOfUserAndScene) {
    const viewer::Look look = firstLook({}, remembered(), wishing({}), "x.json").look;
    EXPECT_EQ(look.technique, Technique::ForwardPlus);
    EXPECT_EQ(look.settings.layout, layoutNamed("slim"));
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Agx);
    EXPECT_EQ(look.settings.culling.method, culling::Method::Tile25d);
    EXPECT_EQ(look.settings.culling.tilePixels, 32);
    EXPECT_EQ(look.settings.samples, 4);
}

TEST(FirstLook, theScenesOptionsOverridePreferences) {
    scenes::SceneOptions wish;
    wish.wishes["technique"] = "forward";
    wish.wishes["layout"] = "exact";
    wish.wishes["toneMap"] = "aces";
    const viewer::Look look = firstLook({}, remembered(), wishing(wish), "x.json").look;
    EXPECT_EQ(look.technique, Technique::Forward);
    EXPECT_EQ(look.settings.layout, layoutNamed("exact"));
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Aces);
    EXPECT_EQ(look.settings.samples, 4) << "of which it says nothing";
    EXPECT_FALSE(look.settings.culling.tilePixels) << "forward has no tiles";
    EXPECT_EQ(viewer::asked(look).settings.culling.tilePixels, 32);
}

TEST(FirstLook, preferencesOverrideWhatTheSceneWasGivenByDefault) {
    scenes::SceneOptions wish;
    wish.wishes["toneMap"] = "khronos_neutral";
    scenes::Scene scene = wishing(wish);
    scene.supplied.wishes = {"toneMap"};
    EXPECT_EQ(firstLook({}, remembered(), scene, "x.glb").look.settings.toneMap, frame::ToneMap::Agx);
    EXPECT_EQ(firstLook({}, {}, scene, "x.glb").look.settings.toneMap, frame::ToneMap::KhronosNeutral);
}

TEST(FirstLook, theCommandLineOverridesSceneAndPreferences) {
    scenes::SceneOptions wish;
    wish.wishes["technique"] = "forward";
    FrameOptions said;
    said.settings["technique"] = "deferred";
    said.settings["toneMap"] = "aces";
    said.settings["samples"] = "1";
    const viewer::Look look = firstLook(said, remembered(), wishing(wish), "x.json").look;
    EXPECT_EQ(look.technique, Technique::Deferred);
    EXPECT_EQ(look.settings.toneMap, frame::ToneMap::Aces);
    EXPECT_EQ(look.settings.samples, 1);
    EXPECT_EQ(viewer::asked(look).settings.samples, 1);
}

TEST(FirstLook, aRememberedNameThatThereIsNoMoreIsAsIfNothingWere) {
    viewer::Preferences preferences;
    preferences.settings["technique"] = "raster_of_old";
    preferences.settings["tile"] = "7";
    preferences.settings["samples"] = "3";
    preferences.settings["toneMap"] = "agx";
    const viewer::Look look = firstLook({}, preferences, wishing({}), "x.json").look;
    viewer::Look expected = firstLook({}, {}, wishing({}), "x.json").look;
    expected.settings.toneMap = frame::ToneMap::Agx;
    EXPECT_EQ(look, expected);
}

TEST(FirstLook, optionsThatNameThingsOfTheFirstSceneDoNotApplyToAnother) {
    FrameOptions said;
    said.settings["camera"] = "side";
    said.settings["solo"] = "3";
    said.pose.fovYDegrees = 30.0;
    said.settings["technique"] = "forward";
    EXPECT_THROW(firstLook(said, {}, wishing({}), "x.json"), InputError);
    const viewer::FirstLook first = firstLook(forAnyScene(said), {}, wishing({}), "x.json");
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
