#include "scenes/Defaults.h"
#include "scenes/LoadLedger.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/Pose.h"
#include "scenes/RigLinks.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

constexpr double kDefaultsRounding = 1e-12; // a dozen operations in double on numbers near 10

TEST(DefaultCamera, seesTheWholeFromTheSpecifiedDirection) {
    Scene scene = tinyScene();
    scene.meshes[0].positionsOS[2].z = 3.0f; // otherwise it is flat
    addDefaultCamera(scene);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(suppliedText(scene), "no camera in it: seen whole by the supplied camera 'default'");
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "default");
    EXPECT_DOUBLE_EQ(camera.fovYRadians, std::numbers::pi / 4.0);
    EXPECT_TRUE(std::isinf(camera.farMetres));
    EXPECT_LT(glm::distance(-glm::dvec3(camera.worldFromCamera[2]), -glm::normalize(glm::dvec3(1.0, 0.7, 1.0))),
              kDefaultsRounding);
    EXPECT_GT(camera.worldFromCamera[1].y, 0.0);
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    for (const glm::vec3& positionOS : scene.meshes[0].positionsOS)
        EXPECT_LT(camera.nearMetres, glm::distance(eyeWS, glm::dvec3(positionOS)));
    checkScene(scene);
}

TEST(DefaultCamera, emptyAndPointSizedScenesGetOneToo) {
    Scene empty;
    addDefaultCamera(empty);
    ASSERT_EQ(empty.cameras.size(), 1u);
    EXPECT_EQ(suppliedText(empty),
              "no camera in it: seen around the origin by the supplied camera 'default', as there are no triangles");
    checkScene(empty);
    Scene point = tinyScene();
    point.meshes[0].positionsOS.assign(3, glm::vec3(5.0f));
    addDefaultCamera(point);
    checkScene(point);
}

TEST(DefaultCamera, neverReplacesTheAuthors) {
    Scene scene = tinyScene();
    scene.cameras.emplace_back().name = "eye";
    addDefaultCamera(scene);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(suppliedText(scene), "");
}

TEST(DefaultCamera, inThePlaceOfTheAuthorsItStandsWhereItWouldWithoutThemAndNoClipMovesIt) {
    Scene scene = riggedScene();
    ASSERT_FALSE(scene.cameras.empty());
    scene.options.camera = scene.cameras[0].name;
    Scene bare = scene;
    dropCameras(bare);
    addDefaultCamera(bare);
    leaveOutCameras(scene);
    addDefaultCamera(scene);
    EXPECT_EQ(scene.cameras, bare.cameras);
    EXPECT_FALSE(scene.options.camera) << "there is no such camera any more";
    EXPECT_EQ(suppliedText(scene), "seen whole by the supplied camera 'default' in the place of its own");
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.cameras, bare.cameras);

    Scene without = tinyScene();
    leaveOutCameras(without);
    addDefaultCamera(without);
    EXPECT_EQ(suppliedText(without), "no camera in it: seen whole by the supplied camera 'default'");
}

Scene litByDefault(Scene scene) {
    LoadLedger ledger;
    if (scene.cameras.empty()) scene.cameras.emplace_back();
    addDefaultLight(scene, ledger);
    return scene;
}

TEST(DefaultLight, isTheStudioBeforeABlurredBackdrop) {
    const Scene scene = litByDefault(tinyScene());
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->source, "builtin:studio");
    EXPECT_EQ(scene.options.requested.at("backdrop"), OptionValue("blurred"));
    constexpr const char* kOthers = " (--environment, --backdrop or --no-default-light change that)";
    const std::string lit = "no light in it: lit by the environment 'studio'";
    EXPECT_EQ(suppliedText(scene), lit + ", blurred behind it" + kOthers);
    EXPECT_EQ(suppliedText(scene, Advice::Panels), lit + ", blurred behind it (the panel Environment changes that)");
    EXPECT_TRUE(scene.warnings.empty());
    Scene sharp = tinyScene();
    sharp.options.requested["backdrop"] = "sharp";
    const Scene unblurred = litByDefault(sharp);
    EXPECT_EQ(unblurred.options.requested.at("backdrop"), OptionValue("sharp"));
    EXPECT_EQ(suppliedText(unblurred), lit + kOthers);
}

TEST(DefaultLight, standsAroundAnyCameraAsAroundTheDefaultOne) {
    Scene plain = tinyScene();
    plain.meshes[0].positionsOS[2].z = 3.0f; // a flat scene is viewed face-on
    addDefaultCamera(plain);
    EXPECT_NEAR(litByDefault(plain).environment->rotationDegrees, 0.0, 1e-4);

    // The map is rotated so that every camera faces the same part of it as the default one.
    Scene scene = tinyScene();
    scene.cameras.resize(3);
    scene.cameras[1].name = "side"; // looks along -X
    scene.cameras[1].worldFromCamera = {{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}};
    scene.cameras[2].worldFromCamera = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}; // straight down
    const auto turnedFor = [&](const char* camera) {
        scene.options.camera = camera;
        return litByDefault(scene).environment->rotationDegrees;
    };
    EXPECT_NEAR(turnedFor("0"), -45.0, 1e-4);
    EXPECT_NEAR(turnedFor("side"), 45.0, 1e-4);
    EXPECT_NEAR(turnedFor("1"), 45.0, 1e-4);
    EXPECT_EQ(turnedFor("2"), 0.0f);
}

TEST(DefaultToneMap, isNeutralUnlessAFileRequestsAnotherOrEverythingInUseIsUnlit) {
    Scene lit = tinyScene();
    addDefaultToneMap(lit);
    EXPECT_EQ(lit.options.requested.at("toneMap"), OptionValue("khronos_neutral"));
    EXPECT_EQ(lit.supplied.requested, std::set<std::string>{"toneMap"});
    Scene requesting = tinyScene();
    requesting.options.requested["toneMap"] = "aces";
    addDefaultToneMap(requesting);
    EXPECT_EQ(requesting.options.requested.at("toneMap"), OptionValue("aces"));
    EXPECT_TRUE(requesting.supplied.requested.empty());
    Scene unlit = tinyScene();
    unlit.materials[0].model = MaterialModel::SingleColor;
    addDefaultToneMap(unlit);
    EXPECT_FALSE(unlit.options.requested.contains("toneMap"));
}

TEST(DefaultLight, shinesUnlessThereIsLightOrEverythingInUseIsUnlit) {
    const auto isGiven = [](const Scene& scene) { return litByDefault(scene).environment.has_value(); };
    Scene lit = tinyScene();
    lit.lights.emplace_back().enabled = false;
    EXPECT_FALSE(isGiven(lit)) << "the author's";
    Scene surrounded = tinyScene();
    surrounded.environment.emplace().source = "own";
    EXPECT_EQ(litByDefault(surrounded).environment->source, "own");
    Scene glowing = tinyScene();
    glowing.materials[0].emissive.z = 0.1f;
    EXPECT_TRUE(isGiven(glowing)) << "it may be black where it does not glow";
    Scene unlit = tinyScene();
    unlit.materials[0].model = MaterialModel::SingleColor;
    EXPECT_FALSE(isGiven(unlit));
    Scene partlyUnlit = unlit;
    partlyUnlit.materials.emplace_back().name = "lit";
    EXPECT_FALSE(isGiven(partlyUnlit)) << "nothing uses it";
    partlyUnlit.nodes[0].instances.push_back({0, 1});
    EXPECT_TRUE(isGiven(partlyUnlit));
    Scene unusedUnlit = tinyScene();
    unusedUnlit.materials.emplace_back().model = MaterialModel::SingleColor;
    EXPECT_TRUE(isGiven(unusedUnlit));
}

} // namespace
} // namespace tessera::scenes
