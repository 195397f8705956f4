#include "renderer/frame/CameraView.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

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

struct Projected {
    glm::vec2 pixel; ///< window coordinates, lower-left origin
    float depth;     ///< as D32F stores it
};

Projected project(const CameraView& view, const glm::dvec3& positionLS) {
    const glm::dvec4 clip = view.clipFromLS * glm::dvec4(positionLS, 1.0);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {glm::vec2((glm::dvec2(ndc) * 0.5 + 0.5) * glm::dvec2(kSize)), float(ndc.z)};
}

/// viewpointFromDepth of shaders/lib/camera.glsl, in fp32 as it runs there.
glm::vec3 rebuilt(const shared::FrameConstants& c, const Projected& p) {
    const float viewDepth = (c.depthToViewDepth.x + c.depthToViewDepth.y * p.depth) /
                            (c.depthToViewDepth.z + c.depthToViewDepth.w * p.depth);
    const glm::vec3 ray =
        glm::vec3(c.rayOriginLS) + p.pixel.x * glm::vec3(c.rayDxLS) + p.pixel.y * glm::vec3(c.rayDyLS);
    return c.forwardLS.w != 0.0f ? ray + viewDepth * glm::vec3(c.forwardLS) : viewDepth * ray;
}

/// A random point of the view volume between two depths, by its place in the picture.
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
            const CameraView view = makeCameraView(camera, kSize, space, glm::vec3(0.0f));
            EXPECT_NEAR(depthAt(view, camera.nearMetres), 1.0, 1e-12); // double rounding of a rotation
            EXPECT_NEAR(depthAt(view, camera.farMetres), 0.0, 1e-12);
            EXPECT_GT(depthAt(view, 1.0), depthAt(view, 2.0));
        }
        const CameraView endless = makeCameraView(perspective(0.1, kEndless), kSize, space, glm::vec3(0.0f));
        EXPECT_NEAR(depthAt(endless, 0.1), 1.0, 1e-12);
        EXPECT_NEAR(depthAt(endless, 1e12), 0.0, 1e-12);
        EXPECT_GT(depthAt(endless, 1e12), 0.0); // a point at any distance is still drawn: 0 is the background
    }
}

TEST(CameraView, aPointIsAlwaysRebuiltFromItsPixelAndDepth) {
    test::Random random(1);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        for (const scenes::Camera& camera :
             {perspective(0.1, kEndless), perspective(0.1, 100.0), orthographic(0.1, 100.0)}) {
            const CameraView view = makeCameraView(camera, kSize, space, glm::vec3(0.0f));
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

TEST(CameraView, bothLightingSpacesAlwaysPutAWorldPointAtTheSamePixelAndDepth) {
    test::Random random(2);
    for (const scenes::Camera& camera : {perspective(0.1, kEndless), orthographic(0.1, 100.0)}) {
        const CameraView world = makeCameraView(camera, kSize, LightingSpace::World, glm::vec3(0.0f));
        const CameraView eye = makeCameraView(camera, kSize, LightingSpace::View, glm::vec3(0.0f));
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 pointWS = world.eyeWS + random.direction() * 20.0;
            const glm::dvec4 a = world.clipFromLS * glm::dvec4(world.positionLS(pointWS), 1.0);
            const glm::dvec4 b = eye.clipFromLS * glm::dvec4(eye.positionLS(pointWS), 1.0);
            ASSERT_LE(glm::distance(a, b), 1e-11); // double rounding of rotations of 20 m
        }
        EXPECT_EQ(world.constants.worldFromLS, glm::mat4(1.0f));
        EXPECT_EQ(world.constants.clipFromES, world.constants.clipFromLS);
        EXPECT_EQ(eye.constants.clipFromES, world.constants.clipFromES) << "vertices lie where they lie";
        const glm::vec3 forwardWS = glm::mat3(eye.constants.worldFromLS) * glm::vec3(eye.constants.forwardLS);
        EXPECT_LE(glm::distance(forwardWS, glm::vec3(world.constants.forwardLS)), 1e-6f);
        EXPECT_LE(glm::distance(eye.forwardLS, glm::dvec3(0.0, 0.0, -1.0)), 1e-15); // double rounding of a rotation
    }
}

TEST(CameraView, frustumPlanesAlwaysHoldExactlyWhatTheCameraSees) {
    test::Random random(3);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        for (const scenes::Camera& camera : {perspective(0.5, kEndless), orthographic(0.5, 100.0)}) {
            const CameraView view = makeCameraView(camera, kSize, space, glm::vec3(0.0f));
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

TEST(CameraView, theBackgroundIsAlwaysUncovered) {
    const CameraView view = makeCameraView(perspective(0.1, kEndless), kSize, LightingSpace::World, {1.0f, 2.0f, 3.0f});
    EXPECT_EQ(view.constants.background, glm::vec4(1.0f, 2.0f, 3.0f, 0.0f));
}

} // namespace
} // namespace tessera::frame
