// Area lights visible in an image: their pixel bounds and depths.
#include "renderer/frame/SeenLights.h"

#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/LookAt.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"
#include "tests/unit/frame/Lights.h"

namespace tessera::frame {
namespace {

using scenes::LightType;
using test::giveSizes;
using test::kAreaTypes;

/// An area light 5 m before the default camera, which looks along -z, and facing it.
scenes::Light lamp(LightType type) {
    scenes::Light light;
    light.type = type;
    light.positionWS = {0.0, 0.0, -5.0};
    light.directionWS = {0.0, 0.0, 1.0};
    light.radiusMetres = 0.5f;
    return light;
}

std::vector<SeenLight> seenOf(const scenes::Light& light, const scenes::Camera& camera = {},
                              const FrameSettings& settings = {}) {
    scenes::Scene scene;
    scene.lights = {light};
    return seenLights(scene, camera, settings);
}

/// A random point on the surface, including the ends of a tube.
glm::dvec3 placeOn(const scenes::Light& light, test::Random& random) {
    const glm::dvec3& front = light.directionWS;
    const glm::dvec3 outwards = random.around(front, 0.0, 0.0);
    const double radius = light.radiusMetres, share = std::sqrt(random.unit());
    switch (light.type) {
    case LightType::Rectangle:
        return light.positionWS + (random.unit() - 0.5) * double(light.widthMetres) * light.alongWS +
               (random.unit() - 0.5) * double(light.heightMetres) * glm::cross(front, light.alongWS);
    case LightType::Polygon: // within the triangle of its first corners
        return light.positionWS +
               glm::dmat2x3(light.alongWS, glm::cross(front, light.alongWS)) *
                   glm::mix(glm::dvec2(light.corners.metres[0]),
                            glm::dvec2(glm::mix(light.corners.metres[1], light.corners.metres[2], random.unit())),
                            share);
    case LightType::Disk:
        return light.positionWS + share * radius * outwards;
    case LightType::Sphere:
        return light.positionWS + radius * random.direction();
    default: {
        const double half = 0.5 * double(light.lengthMetres);
        if (random.index(3) > 0) return light.positionWS + radius * outwards + random.between(-half, half) * front;
        return light.positionWS + share * radius * outwards + (random.index(2) == 0 ? half : -half) * front;
    }
    }
}

TEST(SeenLights, aPlaceInThePictureAlwaysLiesInItsLightsWindow) {
    test::Random random(7);
    const glm::ivec2 sizePixels(200, 120);
    FrameSettings settings;
    settings.sizePixels = sizePixels;
    int shown = 0, clipped = 0;
    for (int i = 0; i < 4000; ++i) {
        scenes::Camera camera;
        const glm::dvec3 eyeWS = random.logarithmic(1.0, 1e4) * random.direction();
        camera.worldFromCamera = scenes::worldFromLookAt(eyeWS, eyeWS + random.direction());
        if (i % 2 == 0) camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = 2.0;
        camera.nearMetres = random.logarithmic(0.01, 1.0);
        scenes::Light light = lamp(kAreaTypes[i / 2 % kAreaTypes.size()]);
        light.isTwoSided = true;
        light.positionWS =
            eyeWS + glm::dmat3(camera.worldFromCamera) *
                        glm::dvec3(random.between(-4.0, 4.0), random.between(-4.0, 4.0), -random.between(-1.0, 8.0));
        light.directionWS = random.direction();
        light.alongWS = random.around(light.directionWS, 0.0, 0.0);
        giveSizes(light, random, 0.01, 4.0);
        for (glm::vec2& corner : light.corners.metres) corner *= glm::vec2(light.widthMetres, light.heightMetres);
        const std::vector<SeenLight> seen = seenOf(light, camera, settings);
        const CameraView view = makeCameraView(camera, sizePixels, LightingSpace::World, glm::vec3(0.0f));
        // A solid light around the eye is not visible.
        const bool isInside = camera.projection == scenes::Projection::Perspective && seen.empty() &&
                              glm::distance(eyeWS, light.positionWS) < 5.0 && !scenes::infoOf(light.type).isFlat;
        for (int place = 0; place < 50 && !isInside; ++place) {
            const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.positionLS(placeOn(light, random)), 1.0);
            const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
            const double ahead = camera.projection == scenes::Projection::Perspective ? clip.w : 1.0;
            if (!(ahead > 0.0) || std::abs(ndc.x) > 1.0 || std::abs(ndc.y) > 1.0 || ndc.z > 1.0 || ndc.z < 0.0) {
                ++clipped;
                continue;
            }
            ++shown;
            ASSERT_EQ(seen.size(), 1u) << scenes::infoOf(light.type).name << " " << i;
            for (int c = 0; c < 2; ++c) {
                ASSERT_GE(ndc[c], seen[0].leastNdc[c]) << scenes::infoOf(light.type).name << " " << i;
                ASSERT_LE(ndc[c], seen[0].mostNdc[c]) << scenes::infoOf(light.type).name << " " << i;
            }
        }
    }
    EXPECT_GT(shown, 10000);
    EXPECT_GT(clipped, 10000);
}

TEST(SeenLights, aWindowIsNoWiderThanItsLightAndTwoPixels) {
    scenes::Camera camera;
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 1.0;
    FrameSettings settings;
    settings.sizePixels = {400, 400};
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        const std::vector<SeenLight> seen = seenOf(lamp(type), camera, settings);
        ASSERT_EQ(seen.size(), 1u);
        for (int c = 0; c < 2; ++c) {
            EXPECT_NEAR(seen[0].mostNdc[c], 0.5 + 2.0 * 2.0 / 400.0, 1e-12);
            EXPECT_NEAR(seen[0].leastNdc[c], -seen[0].mostNdc[c], 1e-12);
        }
    }
}

TEST(SeenLights, areThoseThatShineAndAreInViewAndToBeSeen) {
    const scenes::Camera camera;
    FrameSettings settings;
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        ASSERT_EQ(seenOf(lamp(type)).size(), 1u);
        const auto isGone = [&](const char* why, const std::function<void(scenes::Light&)>& change) {
            scenes::Light light = lamp(type);
            change(light);
            EXPECT_TRUE(seenOf(light).empty()) << why;
        };
        isGone("off", [](scenes::Light& light) { light.enabled = false; });
        isGone("not to be seen", [](scenes::Light& light) { light.isSeen = false; });
        isGone("no intensity", [](scenes::Light& light) { light.intensity = 0.0f; });
        isGone("black", [](scenes::Light& light) { light.color = glm::vec3(0.0f); });
        isGone("no range", [](scenes::Light& light) { light.rangeMetres = 0.0f; });
        isGone("no surface", [](scenes::Light& light) {
            light.radiusMetres = light.widthMetres = 0.0f;
            for (glm::vec2& corner : light.corners.metres) corner *= 1e-7f;
        });
        isGone("behind the eye", [](scenes::Light& light) { light.positionWS.z = 5.0; });
        isGone("beside the picture", [](scenes::Light& light) { light.positionWS.x = 50.0; });
        isGone("at the eye", [](scenes::Light& light) { light.positionWS.z = 0.0; });
        scenes::Light turned = lamp(type);
        turned.directionWS.z = -1.0;
        EXPECT_EQ(seenOf(turned).empty(), scenes::infoOf(type).isFlat);
        turned.isTwoSided = true;
        EXPECT_EQ(seenOf(turned).size(), 1u);
        scenes::Camera shortSighted;
        shortSighted.farMetres = 3.0;
        EXPECT_TRUE(seenOf(lamp(type), shortSighted).empty());
        settings.soloLight = 1;
        EXPECT_TRUE(seenOf(lamp(type), camera, settings).empty());
        settings.soloLight = 0;
        EXPECT_EQ(seenOf(lamp(type), camera, settings).size(), 1u);
        // A range limits the illumination, not the visibility of the surface.
        scenes::Light ranged = lamp(type);
        ranged.rangeMetres = 0.1f;
        EXPECT_EQ(seenOf(ranged).size(), 1u);
    }
    for (const scenes::LightTypeInfo& info : scenes::lightTypes()) {
        EXPECT_EQ(seenOf(lamp(info.type)).size(), info.isArea ? 1u : 0u) << info.name;
    }
}

TEST(SeenLights, anAnimatedLightIsSeenWhereItIs) {
    scenes::Light light = lamp(LightType::Sphere);
    scenes::LightAnimation& animation = light.animation.emplace();
    animation.kind = scenes::LightAnimationKind::Keyframes;
    animation.keys.timesSeconds = {0.0, 1.0};
    animation.keys.values = {{0.0, 0.0, -5.0}, {0.0, 0.0, 5.0}};
    FrameSettings settings;
    EXPECT_EQ(seenOf(light, {}, settings).size(), 1u);
    settings.timeSeconds = 1.0;
    EXPECT_TRUE(seenOf(light, {}, settings).empty());
}

TEST(SeenLights, aLightThatKeyframesLightIsSeenOnceItShines) {
    scenes::Light light = lamp(LightType::Sphere);
    light.intensity = 0.0f;
    scenes::LightKeys& keys = light.keyframes.emplace_back();
    keys.of = scenes::LightKeyed::Intensity;
    keys.timesSeconds = {0.0, 1.0};
    keys.values = {glm::dvec3(0.0), glm::dvec3(5.0)};
    FrameSettings settings;
    EXPECT_TRUE(seenOf(light, {}, settings).empty());
    settings.timeSeconds = 0.5;
    EXPECT_EQ(seenOf(light, {}, settings).size(), 1u);
}

TEST(SeenLights, aFarViewHasTheDepthsOfItsLights) {
    scenes::Camera camera;
    camera.worldFromCamera[3].z = 1000.0;
    camera.fovYRadians = 0.01;
    const SurfaceBounds surface{.boxWS = {glm::dvec3(-1.0), glm::dvec3(1.0)}, .reachMetres = 2.0};
    scenes::Light light = lamp(LightType::Sphere);
    light.positionWS = {0.0, 0.0, 100.0};
    const std::vector<SeenLight> seen = seenOf(light, camera);
    ASSERT_EQ(seen.size(), 1u);
    const glm::dvec2 half(0.01);
    const SurfaceBounds both[] = {surface, seen[0].bounds};
    EXPECT_GT(depthInterval(camera, half, {both, 1}).nearMetres, 990.0);
    const DepthInterval interval = depthInterval(camera, half, both);
    EXPECT_LT(interval.nearMetres, 899.5);
    EXPECT_GT(interval.farMetres, 1001.0);
    EXPECT_TRUE(interval.isEven);
}

TEST(SeenLights, arePackedRelativeToTheOriginOfLightingSpace) {
    scenes::Camera camera;
    camera.worldFromCamera = scenes::worldFromLookAt({1e6, 2.0, 3.0}, {1e6 + 1.0, 2.0, 3.0});
    scenes::Light light = lamp(LightType::Rectangle);
    light.positionWS = {1e6 + 4.0, 2.25, 3.5};
    light.directionWS = {-1.0, 0.0, 0.0};
    light.alongWS = {0.0, 0.0, 1.0};
    light.widthMetres = 3.0f;
    light.heightMetres = 0.5f;
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 8.0f;
    light.isTwoSided = true;
    const std::vector<SeenLight> seen = seenOf(light, camera);
    ASSERT_EQ(seen.size(), 1u);
    const auto packed = [&](LightingSpace space) {
        return packSeenLights(seen, makeCameraView(camera, {64, 64}, space, glm::vec3(0.0f))).at(0);
    };
    const shared::SeenLightTexels world = packed(LightingSpace::World);
    EXPECT_EQ(world.middle, glm::vec4(4.0f, 0.25f, 0.5f, float(int(LightType::Rectangle))));
    EXPECT_EQ(world.radiance, glm::vec4(8.0f, 4.0f, 2.0f, 1.0f));
    EXPECT_EQ(world.along, glm::vec4(0.0f, 0.0f, 1.0f, 1.5f));
    EXPECT_EQ(glm::cross(glm::vec3(world.along), glm::vec3(world.across)), glm::vec3(light.directionWS));
    EXPECT_EQ(world.across.w, 0.25f);
    const shared::SeenLightTexels eye = packed(LightingSpace::View);
    EXPECT_NEAR(eye.middle.z, -4.0, 1e-6);
    EXPECT_NEAR(eye.along.x, 1.0, 1e-6) << "to the right";
}

TEST(SeenLights, aPolygonBringsItsCornersInMetresInTheirOrder) {
    scenes::Light light = lamp(LightType::Polygon);
    light.corners.metres[4] = {-2.0f, 0.125f};
    light.corners.count = 5;
    const std::vector<SeenLight> seen = seenOf(light);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_NEAR(seen[0].bounds.boxWS.max.x, 2.0, 1e-12) << "as far to either side";
    const shared::SeenLightTexels texels =
        packSeenLights(seen, makeCameraView({}, {64, 64}, LightingSpace::World, glm::vec3(0.0f))).at(0);
    EXPECT_EQ(texels.along.w, 5.0f);
    EXPECT_EQ(texels.corners[0], glm::vec4(-0.5f, -0.5f, 0.5f, -0.5f));
    EXPECT_EQ(texels.corners[2], glm::vec4(-2.0f, 0.125f, 0.0f, 0.0f));
}

TEST(SeenLights, aPlanReportsWhyThereAreNone) {
    scenes::Scene scene;
    FrameSettings settings;
    EXPECT_EQ(whyNoSeenLights(scene, settings), "no light has one");
    scene.lights = {lamp(LightType::Disk)};
    scene.lights[0].isSeen = false;
    EXPECT_EQ(whyNoSeenLights(scene, settings), "no light that has one shines and is to be seen");
    scene.lights[0].isSeen = true;
    scene.lights[0].positionWS.z = 5.0;
    EXPECT_EQ(whyNoSeenLights(scene, settings), "none that shines is in view from a side that shines");
    settings.view = DebugView::Ids;
    EXPECT_EQ(whyNoSeenLights(scene, settings), "the view shows no lit picture");
}

} // namespace
} // namespace tessera::frame
