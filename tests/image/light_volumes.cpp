// deferred_volumes against deferred: a proxy volume that misses a lit pixel, or covers one twice, changes a bit.
#include <functional>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ImageTest.h"
#include "tests/support/CullingScenes.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

scenes::Light spotLight(const glm::dvec3& positionWS, const glm::dvec3& directionWS, double outerConeRadians) {
    scenes::Light light = pointLight(positionWS, 40.0f);
    light.type = scenes::LightType::Spot;
    light.directionWS = glm::normalize(directionWS);
    light.outerConeRadians = float(outerConeRadians);
    light.innerConeRadians = 0.0f;
    light.rangeMetres = 12.0f;
    return light;
}

scenes::Light rangedLight(const glm::dvec3& positionWS, float rangeMetres) {
    scenes::Light light = pointLight(positionWS, 4.0f);
    light.rangeMetres = rangeMetres;
    return light;
}

scenes::Light randomLight(Random& random, const glm::dvec3& eyeWS) {
    scenes::Light light = pointLight({}, float(random.logarithmic(0.1, 30.0)));
    light.color = glm::vec3(random.unit(), random.unit(), 0.2 + 0.8 * random.unit());
    const bool nearEye = random.index(4) == 0;
    light.positionWS =
        (nearEye ? eyeWS : glm::dvec3(0.0)) + random.direction() * random.between(0.0, nearEye ? 1.5 : 7.0);
    light.directionWS = random.direction();
    const int kind = random.index(10);
    light.type = kind == 0  ? scenes::LightType::Directional
                 : kind < 5 ? scenes::LightType::Spot
                            : scenes::LightType::Point;
    if (kind == 9) light.falloff = scenes::Falloff::Attenuation;
    light.attenuation = {0.5f, 0.3f, 0.6f};
    if (random.index(12) != 0) light.rangeMetres = float(random.logarithmic(0.03, 60.0));
    light.outerConeRadians = float(random.index(4) == 0 ? random.between(1.3, pi) : random.logarithmic(0.003, 1.6));
    light.innerConeRadians = light.outerConeRadians * float(random.unit());
    return light;
}

scenes::Camera randomCamera(Random& random) {
    scenes::Camera camera;
    const glm::dvec3 eyeWS = random.direction() * random.between(0.5, 8.0) + glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 targetWS = random.direction() * random.between(0.0, 2.0);
    camera.worldFromCamera = glm::inverse(glm::lookAt(eyeWS, targetWS, random.direction()));
    camera.fovYRadians = random.between(0.2, 2.2);
    camera.nearMetres = random.logarithmic(0.005, 0.5);
    if (random.index(3) == 0) camera.farMetres = random.between(3.0, 30.0);
    if (random.index(4) == 0) {
        makeOrthographic(camera, random.between(0.5, 6.0));
    }
    return camera;
}

/// A quad that fills the image, 3 m ahead.
scenes::Scene wall() {
    scenes::Material material = lambert();
    return quadScene(material);
}

class LightVolumes : public ImageTest {
protected:
    /// Returns whether the lights change the image; fails where the two techniques differ. The renderer of `scene`
    /// reads lights and cameras anew at each frame, so one renderer, and its programs, serve all of them.
    bool expectEqual(engine::Renderer& renderer, scenes::Scene& scene, const frame::FrameSettings& settings) {
        const std::vector<float> deferred = renderer.render(Technique::Deferred, settings).radiance;
        const std::vector<float> volumes = renderer.render(Technique::DeferredVolumes, settings).radiance;
        std::size_t different = 0;
        float worst = 0.0f;
        for (std::size_t i = 0; i < deferred.size(); ++i) {
            if (deferred[i] == volumes[i]) continue;
            ++different;
            worst = std::max(worst, std::abs(deferred[i] - volumes[i]) / std::max(deferred[i], 1e-20f));
        }
        if (context().capabilities().isSoftware) {
            EXPECT_EQ(different, 0u) << "by up to " << worst;
        } else {
            // Hardware may contract the two programs differently: some 100 roundings of 2^-24.
            EXPECT_LE(worst, 1e-5f) << different << " values";
        }
        return sumOf(deferred) > sumOf(unlit(renderer, scene, settings));
    }

    /// The scene's image with all lights off.
    static std::vector<float> unlit(engine::Renderer& renderer, scenes::Scene& scene,
                                    const frame::FrameSettings& settings) {
        const std::vector<scenes::Light> lights = scene.lights;
        for (scenes::Light& light : scene.lights) light.enabled = false;
        std::vector<float> picture = renderer.render(Technique::Deferred, settings).radiance;
        scene.lights = lights;
        return picture;
    }
    static double sumOf(const std::vector<float>& values) {
        double sum = 0.0;
        for (const float value : values) sum += value;
        return sum;
    }

    static frame::FrameSettings sized(int width, int height) { return ofSize(width, height); }

    /// Pixels lit by the only light of the scene, and pixels covered by its volume.
    struct Share {
        int lit = 0;
        int visited = 0;
    };
    Share shareOf(const scenes::Scene& scene) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = sized(240, 160);
        const std::vector<float> picture = renderer.render(Technique::Deferred, settings).radiance;
        settings.view = frame::DebugView::Lights;
        const std::vector<float> counts = renderer.render(Technique::DeferredVolumes, settings).radiance;
        Share share;
        for (std::size_t i = 0; i < picture.size(); i += 4) {
            share.lit += picture[i] > 0.0f;
            share.visited += int(counts[i]);
            EXPECT_TRUE(!(picture[i] > 0.0f) || counts[i] == 1.0f) << "pixel " << i / 4;
        }
        return share;
    }
};

scenes::Scene sceneOfVolumes() {
    return isWholeSweep() ? everythingScene() : lambertScene();
}

struct ViewerAndLight {
    const char* name;
    std::vector<scenes::Light> lights;
    std::function<void(scenes::Camera&)> arrange = [](scenes::Camera&) {};
};

// The camera stands at (0, 1.5, 6) and looks at the origin, over a floor at y = -1; mirrored objects stand on it.
std::vector<ViewerAndLight> cases() {
    const glm::dvec3 eyeWS(0.0, 1.5, 6.0);
    const auto farPlane = [](scenes::Camera& camera) { camera.farMetres = 7.0; };
    const auto nearPlane = [](scenes::Camera& camera) { camera.nearMetres = 4.5; };
    const auto orthographic = [](scenes::Camera& camera) { makeOrthographic(camera, 2.5); };
    std::vector<ViewerAndLight> all{
        {"the eye inside", {rangedLight(eyeWS + glm::dvec3(0.3, 0.2, 0.1), 6.0f), rangedLight(eyeWS, 5.0f)}},
        {"the eye on the sphere", {rangedLight({0.0, 1.5, 2.0}, 4.0f)}},
        {"behind the eye", {rangedLight({0.5, 2.0, 8.0}, 9.0f), rangedLight({9.0, 0.0, 7.0}, 12.0f)}},
        {"beyond the far plane", {rangedLight({0.0, 0.0, -4.0}, 4.0f)}, farPlane},
        {"across the near plane", {rangedLight({0.5, 0.0, 1.5}, 2.5f), rangedLight({0.0, 1.0, 3.0}, 4.0f)}, nearPlane},
        {"a tiny range", {rangedLight({0.0, -0.99, 0.0}, 0.04f), rangedLight({0.31, -0.97, 0.4}, 0.06f)}},
        {"a huge range", {rangedLight({0.0, 3.0, 0.0}, 1e6f), rangedLight({1.0, 3.0, 0.0}, 1e18f)}},
        {"no range", {pointLight({0.0, 2.0, 2.0}, 3.0f)}},
        {"an orthographic camera",
         {rangedLight({0.0, 0.5, 0.0}, 2.0f), spotLight({1.0, 3.0, 1.0}, {0, -1, 0}, 0.4)},
         orthographic},
        {"an orthographic camera and a huge range",
         {rangedLight({0.0, 3.0, 0.0}, 1e3f), rangedLight({0.0, 3.0, 0.0}, 1e6f), rangedLight({1.0, 3.0, 0.0}, 1e9f),
          rangedLight({1.0, 3.0, 0.0}, 1e18f)},
         orthographic},
        {"an orthographic camera amid lights",
         {rangedLight(eyeWS, 7.0f), rangedLight(eyeWS + glm::dvec3(0.0, 0.0, 3.0), 8.0f)},
         orthographic},
    };
    for (const double degrees : {1.0, 10.0, 30.0, 45.0, 60.0, 84.0, 84.5, 89.0, 90.0, 91.0, 135.0, 179.0, 180.0}) {
        const double outer = degrees * pi / 180.0;
        all.push_back({"a spot from above", {spotLight({0.0, 3.0, 0.0}, {0.0, -1.0, 0.0}, outer)}});
        all.push_back({"a spot at the eye", {spotLight(eyeWS, {0.0, -0.45, -1.0}, outer)}});
        all.push_back({"a spot behind the eye", {spotLight({0.2, 2.0, 8.0}, {0.0, -0.4, -1.0}, outer)}});
        all.push_back({"a spot towards the eye", {spotLight({0.6, 0.6, -5.0}, {0.0, -0.3, 1.0}, outer)}});
    }
    return all;
}

// Lambert materials in a short sweep: the pixels that a volume covers do not depend on materials.
TEST_SWEEP(LightVolumes, everyPlaceOfALightIsExactlyAsInDeferred) {
    const scenes::Scene before = sceneOfVolumes();
    scenes::Scene scene = before;
    engine::Renderer renderer(context(), scene);
    for (const ViewerAndLight& example : cases()) {
        scene.cameras = before.cameras;
        example.arrange(scene.cameras[0]);
        for (const scenes::Light& light : example.lights) {
            SCOPED_TRACE(fmt::format("{}, outer cone {} rad, range {} m", example.name, light.outerConeRadians,
                                     light.rangeMetres));
            scene.lights = {light};
            EXPECT_TRUE(expectEqual(renderer, scene, sized(321, 201))) << "no light reaches the picture";
        }
    }
}

TEST_SWEEP(LightVolumes, randomScenesAreExactlyAsInDeferred) {
    scenes::Scene scene = sceneOfVolumes();
    engine::Renderer renderer(context(), scene);
    int lit = 0;
    int scenes = 0;
    for (int seed = 1; seed <= 72; seed += isWholeSweep() ? 1 : 6, ++scenes) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        Random random{std::uint64_t(seed)};
        scene.cameras = {randomCamera(random)};
        const glm::dvec3 eyeWS(scene.cameras[0].worldFromCamera[3]);
        if (seed > 48) scene.cameras[0] = seenFromAfar(scene.cameras[0], std::pow(10.0, double(1 + seed % 6)));
        scene.lights.clear();
        const int count = 1 + random.index(40);
        for (int i = 0; i < count; ++i) scene.lights.push_back(randomLight(random, eyeWS));
        frame::FrameSettings settings = sized(97, 61);
        settings.space = seed % 5 == 0 ? frame::LightingSpace::View : frame::LightingSpace::World;
        settings.prune = !isWholeSweep() || seed % 6 != 0;
        lit += expectEqual(renderer, scene, settings);
    }
    EXPECT_GE(lit, scenes * 3 / 4) << "too many pictures without light to say anything";
}

// Outlines of a few pixels, so many that some pixel centres lie within a vertex's snapping error.
TEST_F(LightVolumes, thousandsOfSmallLightsAreExactlyAsInDeferred) {
    scenes::Scene scene = wall();
    Random random(7);
    for (int i = 0; i < 6000; ++i) {
        const glm::dvec3 positionWS(random.between(-1.0, 1.0), random.between(-0.6, 0.6), random.between(0.0, 0.01));
        scene.lights.push_back(rangedLight(positionWS, float(random.between(0.02, 0.08))));
    }
    engine::Renderer renderer(context(), scene);
    EXPECT_TRUE(expectEqual(renderer, scene, sized(97, 61)));
}

// Viewed from the side, so that the lit part ends at the hull's outline. The whole scene is rotated at random: the
// corners of an octagon protrude by 8 % and hide a hull that is too narrow.
TEST_F(LightVolumes, spotsAlongAWallAreExactlyAsInDeferred) {
    const scenes::Scene upright = wall();
    Random random(11);
    for (int turn = 0; turn < 24; ++turn) {
        const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), random.between(0.0, 2.0 * pi), random.direction());
        scenes::Scene scene = upright;
        scene.nodes[0].parentFromNode = turned * scene.nodes[0].parentFromNode;
        scene.cameras[0].worldFromCamera = turned * scene.cameras[0].worldFromCamera;
        engine::Renderer renderer(context(), scene);
        for (const double degrees : {3.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 84.0}) {
            SCOPED_TRACE(fmt::format("{} degrees, turn {}", degrees, turn));
            scene.lights = {spotLight(glm::dvec3(turned * glm::dvec4(0.0, -0.6, 0.01, 1.0)),
                                      glm::dvec3(turned * glm::dvec4(0.0, 1.0, 0.0, 0.0)), degrees * pi / 180.0)};
            scene.lights[0].rangeMetres = 1.2f;
            EXPECT_TRUE(expectEqual(renderer, scene, sized(320, 200)));
        }
    }
}

TEST_SWEEP(LightVolumes, mirroredNodesAreExactlyAsInDeferred) {
    scenes::Scene scene = sceneOfVolumes();
    for (scenes::Node& node : scene.nodes) node.parentFromNode = glm::scale(node.parentFromNode, glm::dvec3(-1, 1, 1));
    engine::Renderer renderer(context(), scene);
    EXPECT_TRUE(expectEqual(renderer, scene, sized(193, 121)));
}

TEST_F(LightVolumes, aSphereNeverVisitsMuchMoreThanItsCircle) {
    scenes::Scene scene = wall();
    scene.lights = {rangedLight({0.1, 0.05, 0.0001}, 0.4f)};
    const Share share = shareOf(scene);
    ASSERT_GT(share.lit, 5000);
    // 1.055 for the octagon; the sphere's outline is 1.02 times its section's at this distance; the rest is pixels at
    // the edge, where the light has faded below the smallest step of the image.
    EXPECT_LE(share.visited, 1.12 * share.lit);
}

TEST_F(LightVolumes, aConeNeverVisitsMuchMoreThanItsSpot) {
    scenes::Scene scene = wall();
    scene.lights = {spotLight({0.0, 0.0, 1.5}, {0.0, 0.0, -1.0}, 0.2)};
    scene.lights[0].rangeMetres = 1.6f;
    const Share share = shareOf(scene);
    ASSERT_GT(share.lit, 2000);
    // The hull is viewed from 1.5 m behind its apex, so the cone's nearer part lies in front of the spot and enlarges
    // it little; 1.055 is for the octagon, and the cap's profile adds up to a tenth to the radius.
    EXPECT_LE(share.visited, 1.3 * share.lit);
}

// Up to 84 degrees the hull is drawn instead of the sphere, which is more than twice as large.
TEST_F(LightVolumes, aWideConeNeverVisitsItsWholeSphere) {
    scenes::Scene scene = wall();
    scene.lights = {spotLight({0.0, -0.2, 0.01}, {0.0, 1.0, 0.0}, 82.0 * pi / 180.0)};
    scene.lights[0].rangeMetres = 0.6f;
    const Share share = shareOf(scene);
    ASSERT_GT(share.lit, 5000);
    EXPECT_LE(share.visited, 1.5 * share.lit) << share.visited << " " << share.lit;
}

// The eye is just outside of the sphere, which still has an outline and does not cover the whole image.
TEST_F(LightVolumes, aSphereThatAlmostHoldsTheEyeNeverVisitsTheWholePicture) {
    scenes::Scene scene = wall();
    scene.lights = {rangedLight({40.0, 0.0, 3.0}, 39.8f)};
    const Share share = shareOf(scene);
    EXPECT_LE(share.visited, 0.6 * 240 * 160) << share.visited << " " << share.lit;
}

TEST_F(LightVolumes, aLightThatFloatsBeforeAllSurfacesIsNotVisited) {
    scenes::Scene scene = wall();
    scene.lights = {rangedLight({0.0, 0.0, 1.0}, 0.9f), spotLight({0.3, 0.0, 2.0}, {0.0, 1.0, 0.0}, 0.5),
                    spotLight({0.0, 0.0, 1.5}, {0.0, 0.0, -1.0}, 0.2)};
    scene.lights[1].rangeMetres = 1.5f;
    scene.lights[2].rangeMetres = 1.495f; // ends 5 mm before the wall, where an eighth of a pixel is 1.2 mm
    EXPECT_EQ(shareOf(scene).visited, 0);
}

TEST_F(LightVolumes, aLightWithoutEndVisitsEveryPixelOnce) {
    scenes::Scene scene = wall();
    scene.cameras[0].fovYRadians = 0.4; // the wall extends beyond the image on every side
    scene.lights = {sunLight({0.0, 0.0, -1.0}, 3.0f)};
    EXPECT_EQ(shareOf(scene).visited, 240 * 160);
}

TEST_F(LightVolumes, uncoveredPixelsKeepTheBackground) {
    scenes::Scene scene = wall();
    scene.cameras[0].fovYRadians = 2.0;
    scene.background = {0.25f, 0.5f, 0.75f};
    scenes::Light sun = pointLight({}, 3.0f);
    sun.type = scenes::LightType::Directional;
    scene.lights = {sun, pointLight({0.0, 0.0, 1.0}, 2.0f), rangedLight({0.0, 0.0, 3.0}, 50.0f)};
    engine::Renderer renderer(context(), scene);
    const std::vector<float> picture = renderer.render(Technique::DeferredVolumes, sized(97, 61)).radiance;
    int uncovered = 0;
    for (std::size_t i = 0; i < picture.size(); i += 4) {
        if (picture[i + 3] != 0.0f) {
            EXPECT_EQ(picture[i + 3], 1.0f);
            continue;
        }
        ++uncovered;
        EXPECT_EQ(glm::vec3(picture[i], picture[i + 1], picture[i + 2]), scene.background);
    }
    EXPECT_GT(uncovered, 1000);
}

} // namespace
} // namespace tessera
