#include "scenes/Defaults.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

constexpr double kDefaultsRounding = 1e-12; // a dozen operations in double on numbers near 10

TEST(DefaultCamera, seesTheBoundsFromTheSpecifiedPlace) {
    Scene scene = tinyScene();
    addDefaultCamera(scene);
    ASSERT_EQ(scene.cameras.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "default");
    EXPECT_DOUBLE_EQ(camera.fovYRadians, std::numbers::pi / 4.0);
    EXPECT_TRUE(std::isinf(camera.farMetres));
    const glm::dvec3 centerWS(1.0, 2.0, 0.0);
    const double radius = std::sqrt(5.0);
    const double distance = 1.2 * radius / std::sin(std::numbers::pi / 8.0);
    const glm::dvec3 eyeWS = centerWS + distance * glm::normalize(glm::dvec3(1.0, 0.7, 1.0));
    EXPECT_LT(glm::distance(glm::dvec3(camera.worldFromCamera[3]), eyeWS), kDefaultsRounding);
    EXPECT_LT(glm::distance(-glm::dvec3(camera.worldFromCamera[2]), -glm::normalize(glm::dvec3(1.0, 0.7, 1.0))),
              kDefaultsRounding);
    EXPECT_GT(camera.worldFromCamera[1].y, 0.0);
    EXPECT_LT(camera.nearMetres, distance - radius);
    checkScene(scene);
}

TEST(DefaultCamera, emptyAndPointSizedScenesGetOneToo) {
    Scene empty;
    addDefaultCamera(empty);
    ASSERT_EQ(empty.cameras.size(), 1u);
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
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(DefaultLight, shinesAlongTheViewedCamera) {
    Scene scene = tinyScene();
    scene.cameras.emplace_back().name = "front";
    Camera& side = scene.cameras.emplace_back();
    side.name = "side"; // looks along -X
    side.worldFromCamera = {{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}};
    addDefaultLight(scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "default");
    EXPECT_EQ(scene.lights[0].type, LightType::Directional);
    EXPECT_EQ(scene.lights[0].intensity, 3.0f);
    EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0f));
    EXPECT_EQ(scene.lights[0].directionWS, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(scene.warnings.size(), 1u);

    scene.lights.clear();
    scene.options.camera = "side";
    addDefaultLight(scene);
    EXPECT_EQ(scene.lights[0].directionWS, glm::dvec3(-1.0, 0.0, 0.0));

    scene.lights.clear();
    scene.options.camera = "1"; // as it may be asked for too
    addDefaultLight(scene);
    EXPECT_EQ(scene.lights[0].directionWS, glm::dvec3(-1.0, 0.0, 0.0));
}

TEST(DefaultLight, isTurnedAlongTheCameraThatIsDrawnAndAnAuthorsLightNever) {
    Scene scene = tinyScene();
    scene.cameras.emplace_back();
    Camera side; // looks along -X
    side.worldFromCamera = {{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}};
    addDefaultLight(scene);
    aimDefaultLight(scene, side);
    EXPECT_EQ(scene.lights.at(0).directionWS, glm::dvec3(-1.0, 0.0, 0.0));

    Scene lit = tinyScene();
    lit.cameras.emplace_back();
    lit.lights = {scene.lights[0]}; // the same, but the author's
    lit.lights[0].directionWS = glm::dvec3(0.0, -1.0, 0.0);
    addDefaultLight(lit);
    aimDefaultLight(lit, side);
    EXPECT_EQ(lit.lights.at(0).directionWS, glm::dvec3(0.0, -1.0, 0.0));
}

TEST(DefaultLight, shinesUnlessThereAreLightsOrEverythingInUseIsUnlit) {
    const auto lightsOf = [](Scene scene) {
        scene.cameras.emplace_back();
        addDefaultLight(scene);
        return scene.lights.size();
    };
    Scene lit = tinyScene();
    lit.lights.emplace_back().enabled = false;
    EXPECT_EQ(lightsOf(lit), 1u);
    Scene glowing = tinyScene();
    glowing.materials[0].emissive.z = 0.1f;
    EXPECT_EQ(lightsOf(glowing), 1u) << "it may be black where it does not glow";
    Scene unlit = tinyScene();
    unlit.materials[0].model = MaterialModel::SingleColor;
    EXPECT_EQ(lightsOf(unlit), 0u);
    Scene partlyUnlit = unlit;
    partlyUnlit.materials.emplace_back().name = "lit";
    EXPECT_EQ(lightsOf(partlyUnlit), 0u) << "nothing uses it";
    partlyUnlit.nodes[0].instances.push_back({0, 1});
    EXPECT_EQ(lightsOf(partlyUnlit), 1u);
    Scene unusedUnlit = tinyScene();
    unusedUnlit.materials.emplace_back().model = MaterialModel::SingleColor;
    EXPECT_EQ(lightsOf(unusedUnlit), 1u);
}

} // namespace
} // namespace tessera::scenes
