#include "renderer/frame/CameraView.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "scenes/LookAt.h"
#include "tests/support/Random.h"

namespace tessera::frame {
namespace {

constexpr glm::ivec2 kSize{641, 359};

scenes::Camera perspective(double nearMetres, double farMetres) {
    scenes::Camera camera;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(0.2, 1.0, -0.3)));
    camera.worldFromCamera = glm::translate(glm::dmat4(1.0), {1.0e5, -2.5, 3.0}) * turned;
    camera.nearMetres = nearMetres;
    camera.farMetres = farMetres;
    return camera;
}

scenes::Camera orthographic(double nearMetres, double farMetres) {
    scenes::Camera camera = perspective(nearMetres, farMetres);
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 7.0;
    return camera;
}

constexpr double kEndless = std::numeric_limits<double>::infinity();

CameraView sizedView(const scenes::Camera& camera, LightingSpace space) {
    return makeCameraView(camera, kSize, space, glm::vec3(0.0f));
}

struct Projected {
    glm::vec2 pixel; ///< window coordinates, lower-left origin
    float depth;     ///< as D32F stores it
};

Projected project(const CameraView& view, const glm::dvec3& positionLS) {
    const glm::dvec4 clip = view.clipFromLS * glm::dvec4(positionLS, 1.0);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {glm::vec2((glm::dvec2(ndc) * 0.5 + 0.5) * glm::dvec2(kSize)), float(ndc.z)};
}

/// viewpointFromDepth of shaders/lib/surface/camera.glsl, in fp32 as it runs there.
glm::vec3 rebuilt(const shared::ViewConstants& c, const Projected& p) {
    const float ahead =
        (c.aheadFromDepth.x + c.aheadFromDepth.y * p.depth) / (c.aheadFromDepth.z + c.aheadFromDepth.w * p.depth);
    const glm::vec2 place = p.pixel - glm::vec2(c.rayFromPixel.z, c.rayFromPixel.w);
    const glm::vec3 across = place.x * glm::vec3(c.rayDxLS) + place.y * glm::vec3(c.rayDyLS);
    const float width = c.forwardLS.w != 0.0f ? 1.0f : c.eyeLS.w + ahead;
    return width * across + ahead * glm::vec3(c.forwardLS);
}

/// A random point of the view volume between two depths, uniform in the image.
glm::dvec3 pointInView(test::Random& random, const CameraView& view, const scenes::Camera& camera, double nearest,
                       double farthest) {
    const double depth = random.logarithmic(nearest, farthest);
    const double halfHeight = camera.projection == scenes::Projection::Perspective
                                  ? depth * std::tan(0.5 * camera.fovYRadians)
                                  : camera.halfHeightMetres;
    const glm::dvec3 positionVS(random.between(-0.999, 0.999) * halfHeight * kSize.x / kSize.y,
                                random.between(-0.999, 0.999) * halfHeight, -depth);
    return view.lsFromWorld * (glm::dmat3(camera.worldFromCamera) * positionVS);
}

double depthAt(const CameraView& view, double viewDepth) {
    const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.forwardLS * viewDepth, 1.0);
    return clip.z / clip.w;
}

TEST(CameraView, depthIsExactlyOneAtTheNearPlaneAndZeroAtTheFarOne) {
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        for (const scenes::Camera& camera :
             {perspective(0.1, 100.0), orthographic(0.1, 100.0), orthographic(0.0, 100.0)}) {
            const CameraView view = sizedView(camera, space);
            EXPECT_NEAR(depthAt(view, camera.nearMetres), 1.0, 1e-12); // rounding of a rotation in double
            EXPECT_NEAR(depthAt(view, camera.farMetres), 0.0, 1e-12);
            EXPECT_GT(depthAt(view, 1.0), depthAt(view, 2.0));
        }
        const CameraView endless = sizedView(perspective(0.1, kEndless), space);
        EXPECT_NEAR(depthAt(endless, 0.1), 1.0, 1e-12);
        EXPECT_NEAR(depthAt(endless, 1e12), 0.0, 1e-12);
        EXPECT_GT(depthAt(endless, 1e12), 0.0); // a point at any distance is drawn: 0 is the background
    }
}

TEST(CameraView, aPointIsRebuiltFromItsPixelAndDepth) {
    test::Random random(1);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        for (const scenes::Camera& camera :
             {perspective(0.1, kEndless), perspective(0.1, 100.0), orthographic(0.1, 100.0)}) {
            const CameraView view = sizedView(camera, space);
            const bool flat = camera.projection == scenes::Projection::Orthographic;
            for (int i = 0; i < 5000; ++i) {
                const glm::dvec3 point = pointInView(random, view, camera, 0.11, 99.0);
                const glm::dvec3 back(rebuilt(view.constants, project(view, point)));
                // Perspective: depth has half an ulp of itself, so the distance keeps about 4 roundings of 6e-8; a
                // finite far plane adds a = near / far = 1e-3 to depths that are 1e-5 there, so up to 1e-3 / depth
                // more. Orthographic: half an ulp of one over the whole range of 100 m, and roundings of it.
                const double depth = glm::dot(point, view.forwardLS);
                const bool endless = std::isinf(camera.farMetres);
                const double bound =
                    flat ? 100.0 * 3e-7 : glm::length(point) * (endless ? 1e-6 : 1e-6 + 1e-7 * depth / 100.0);
                ASSERT_LE(glm::distance(point, back), bound) << "at " << depth << " m";
            }
        }
    }
}

TEST(CameraView, anOffsetShiftsThePictureByThatManyPixelsAndItsRaysWithIt) {
    test::Random random(3);
    const glm::dvec2 offset(0.375, -0.25);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View})
        for (const scenes::Camera& camera : {perspective(0.1, kEndless), orthographic(0.1, 100.0)}) {
            const CameraView still = sizedView(camera, space);
            const CameraView shifted = makeCameraView(camera, kSize, space, glm::vec3(0.0f), {}, 0.0f, offset);
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 point = pointInView(random, still, camera, 0.11, 99.0);
                const Projected before = project(still, point), after = project(shifted, point);
                constexpr float kRounding = 1e-4f; // of pixels up to 641 in fp32
                ASSERT_LE(glm::distance(before.pixel + glm::vec2(offset), after.pixel), kRounding);
                ASSERT_EQ(before.depth, after.depth);
                const float metres = float(glm::length(point));
                ASSERT_LE(glm::distance(rebuilt(still.constants, before), rebuilt(shifted.constants, after)),
                          1e-5f * metres);
            }
            const glm::dvec4 left = shifted.frustumPlanesLS[0] - still.frustumPlanesLS[0];
            EXPECT_NE(left, glm::dvec4(0.0)) << "what it sees is shifted too";
        }
}

TEST(CameraView, bothLightingSpacesPutAWorldPointAtTheSamePixelAndDepth) {
    test::Random random(2);
    for (const scenes::Camera& camera : {perspective(0.1, kEndless), orthographic(0.1, 100.0)}) {
        const CameraView world = sizedView(camera, LightingSpace::World);
        const CameraView eye = sizedView(camera, LightingSpace::View);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 pointWS = world.eyeWS + random.direction() * 20.0;
            const glm::dvec4 a = world.clipFromLS * glm::dvec4(world.positionLS(pointWS), 1.0);
            const glm::dvec4 b = eye.clipFromLS * glm::dvec4(eye.positionLS(pointWS), 1.0);
            ASSERT_LE(glm::distance(a, b), 1e-11); // rounding of rotations of 20 m in double
        }
        EXPECT_EQ(world.constants.worldFromLS, glm::mat4(1.0f));
        EXPECT_EQ(world.constants.clipFromRWS, world.constants.clipFromLS);
        EXPECT_EQ(eye.constants.clipFromRWS, world.constants.clipFromRWS) << "vertices lie where they lie";
        const glm::vec3 forwardWS = glm::mat3(eye.constants.worldFromLS) * glm::vec3(eye.constants.forwardLS);
        EXPECT_LE(glm::distance(forwardWS, glm::vec3(world.constants.forwardLS)), 1e-6f);
        EXPECT_LE(glm::distance(eye.forwardLS, glm::dvec3(0.0, 0.0, -1.0)), 1e-15); // rounding of a rotation in double
    }
}

TEST(CameraView, frustumPlanesEncloseTheVisiblePoints) {
    test::Random random(3);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        for (const scenes::Camera& camera : {perspective(0.5, kEndless), orthographic(0.5, 100.0)}) {
            const CameraView view = sizedView(camera, space);
            for (const glm::dvec4& plane : view.frustumPlanesLS)
                EXPECT_NEAR(glm::length(glm::dvec3(plane)), 1.0, 1e-12);
            int seen = 0;
            for (int i = 0; i < 20000; ++i) {
                const glm::dvec3 point = view.forwardLS * 10.0 + random.direction() * random.between(0.0, 20.0);
                const glm::dvec4 clip = view.clipFromLS * glm::dvec4(point, 1.0);
                const bool inPicture =
                    std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && glm::dot(point, view.forwardLS) >= 0.5;
                bool inPlanes = true;
                for (const glm::dvec4& plane : view.frustumPlanesLS)
                    inPlanes = inPlanes && glm::dot(plane, glm::dvec4(point, 1.0)) >= 0.0;
                ASSERT_EQ(inPlanes, inPicture);
                seen += inPicture;
            }
            EXPECT_GT(seen, 1000);
        }
    }
}

/// A cube with sides of a metre by default.
SurfaceBounds cube(const glm::dvec3& centerWS = glm::dvec3(0.0), double halfMetres = 0.5) {
    return {{centerWS - halfMetres, centerWS + halfMetres}, halfMetres * std::sqrt(3.0)};
}

/// A camera on the axis (1, 1, 1), looking at the origin, where its view has a half height of 0.9 m.
scenes::Camera farCamera(double eyeMetres, scenes::Projection projection = scenes::Projection::Perspective) {
    scenes::Camera camera;
    camera.worldFromCamera = scenes::worldFromLookAt(glm::normalize(glm::dvec3(1.0)) * eyeMetres, glm::dvec3(0.0));
    camera.fovYRadians = 2.0 * std::atan(0.9 / eyeMetres);
    camera.projection = projection;
    camera.halfHeightMetres = 0.9;
    return camera;
}

TEST(CameraView, pointsOfAMetreKeepTheirDigitsFromAnyDistance) {
    test::Random random(4);
    const SurfaceBounds bounds = cube();
    for (const auto projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        for (const double eyeMetres : {10.0, 1e3, 1e6, 1e9}) {
            for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
                const CameraView view =
                    makeCameraView(farCamera(eyeMetres, projection), kSize, space, glm::vec3(0.0f), {&bounds, 1});
                for (int i = 0; i < 2000; ++i) {
                    const glm::dvec3 pointWS(random.between(-0.5, 0.5), random.between(-0.5, 0.5),
                                             random.between(-0.5, 0.5));
                    const glm::dvec3 pointLS = view.positionLS(pointWS);
                    ASSERT_LT(glm::length(pointLS), 2.0);
                    const Projected projected = project(view, pointLS);
                    ASSERT_GT(projected.depth, 0.0f);
                    ASSERT_LT(projected.depth, 1.0f);
                    // About eight roundings of 2^-24, of a depth interval of 2.2 m and of pixel positions up to 641
                    // pixels of 2.8 mm each. At 1e9 m, doubles have steps of 1.2e-7 m.
                    const double bound = 8.0 * 0x1p-24 * (2.2 + 1.8) + 4e-16 * eyeMetres;
                    ASSERT_LE(glm::distance(glm::dvec3(rebuilt(view.constants, projected)), pointLS), bound)
                        << eyeMetres << " m";
                }
            }
        }
    }
}

TEST(CameraView, anEyeAmongSurfacesHasItsOwnDepths) {
    const scenes::Camera camera = farCamera(10.0);
    for (const SurfaceBounds& bounds : {cube({}, 20.0), cube({}, 5.0)}) {
        const CameraView fitted = makeCameraView(camera, kSize, LightingSpace::World, glm::vec3(0.0f), {&bounds, 1});
        EXPECT_EQ(fitted.originWS, fitted.eyeWS);
        EXPECT_EQ(fitted.depths.nearMetres, camera.nearMetres);
        EXPECT_TRUE(std::isinf(fitted.depths.farMetres));
    }
}

TEST(CameraView, invisibleSurfacesDoNotChangeTheDepthInterval) {
    const std::vector<SurfaceBounds> bounds{cube(), cube({40.0, -40.0, 0.0}), cube({600.0, 600.0, 600.0})};
    scenes::Camera camera = farCamera(1e3); // 39 m before the last box, which is behind the eye
    const auto depthsOf = [&](std::size_t count) {
        return makeCameraView(camera, kSize, LightingSpace::World, glm::vec3(0.0f), {bounds.data(), count}).depths;
    };
    EXPECT_EQ(depthsOf(1).nearMetres, depthsOf(3).nearMetres) << "beside the picture and behind the eye";
    EXPECT_EQ(depthsOf(1).farMetres, depthsOf(3).farMetres);
    camera.nearMetres = 999.9;
    camera.farMetres = 1000.1;
    EXPECT_EQ(depthsOf(1).nearMetres, 999.9) << "the camera's own planes cut";
    EXPECT_EQ(depthsOf(1).farMetres, 1000.1);
}

TEST(CameraView, surfacesThatRoundingMayMoveIntoTheImageExtendTheDepthInterval) {
    const scenes::Camera camera = farCamera(1e6); // its image shows 1.8 m, roundings may move points by 1 m
    const glm::dvec3 up(camera.worldFromCamera[1]), back(camera.worldFromCamera[2]);
    const std::vector<SurfaceBounds> bounds{cube(), cube(1.5 * up - 10.0 * back, 0.1)};
    const auto farOf = [&](std::size_t count) {
        return makeCameraView(camera, kSize, LightingSpace::World, glm::vec3(0.0f), {bounds.data(), count})
            .depths.farMetres;
    };
    EXPECT_GT(farOf(2), farOf(1) + 5.0);
}

TEST(CameraView, theBackgroundIsUncovered) {
    const CameraView view = makeCameraView(perspective(0.1, kEndless), kSize, LightingSpace::World, {1.0f, 2.0f, 3.0f});
    EXPECT_EQ(view.constants.background, glm::vec4(1.0f, 2.0f, 3.0f, 0.0f));
}

} // namespace
} // namespace tessera::frame
