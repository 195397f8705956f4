#include "scenes/Framing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/Defaults.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/Pose.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

constexpr double kFovY = std::numbers::pi / 4.0;
constexpr double kShare = 1.0 / 1.05; ///< fraction of the image that is filled, with a margin of 5 percent
constexpr double kFramingRounding = 1e-9;

/// A triangle of these corners.
Scene triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Scene scene = tinyScene();
    scene.meshes[0].positionsOS = {a, b, c};
    return scene;
}

/// The vertices' extents to the right, left, top and bottom, as fractions of half the image, and their least depth.
struct Reached {
    double right = -1e9, left = -1e9, top = -1e9, bottom = -1e9, depth = 1e9;
};
void reach(const Scene& scene, const Framing& framing, double aspect, Reached& reached) {
    const glm::dmat4 cameraFromWorld = glm::inverse(worldFromLookAt(framing.eyeWS, framing.targetWS));
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const MeshInstance& instance : scene.nodes[n].instances)
            for (const glm::vec3& positionOS : scene.meshes[std::size_t(instance.mesh)].positionsOS) {
                const glm::dvec3 p(cameraFromWorld * worldFromNode[n] * glm::dvec4(glm::dvec3(positionOS), 1.0));
                const double y = p.y / (-p.z * std::tan(0.5 * kFovY));
                const double x = p.x / (-p.z * std::tan(0.5 * kFovY) * aspect);
                reached.right = std::max(reached.right, x);
                reached.left = std::max(reached.left, -x);
                reached.top = std::max(reached.top, y);
                reached.bottom = std::max(reached.bottom, -y);
                reached.depth = std::min(reached.depth, -p.z);
            }
}

TEST(Framing, fillsThePictureUpToItsMarginAtAnyAspectAndLeavesNothingOut) {
    for (Scene scene : {triangle({0, 0, 0}, {2, 0, 1}, {0, 4, 3}), triangle({0, 0, 0}, {0.1f, 9, 0.1f}, {0, 9, 0.2f}),
                        triangle({1e4f, 0, 0}, {1e4f + 40.0f, 1, 0}, {1e4f, 0, 30}), loadScene("room")})
        for (const double aspect : {0.1, 0.6, 1.0, 16.0 / 9.0, 8.0}) {
            Reached reached;
            reach(scene, framingOf(scene, kFovY, aspect), aspect, reached);
            EXPECT_GT(reached.depth, 0.0);
            const double across = std::max(reached.left, reached.right), high = std::max(reached.top, reached.bottom);
            EXPECT_LE(std::max(across, high), kShare + kFramingRounding) << scene.name << " " << aspect;
            // The scene touches both sides of one pair.
            const bool isWide = std::min(reached.left, reached.right) > kShare - kFramingRounding;
            const bool isHigh = std::min(reached.top, reached.bottom) > kShare - kFramingRounding;
            EXPECT_TRUE(isWide || isHigh) << scene.name << " " << aspect << ": " << across << " x " << high;
        }
}

TEST(Framing, aFlatSceneIsSeenFaceOnFromTheSideThatItIsTurnedTo) {
    const auto forward = [](Scene scene) {
        const Framing framing = framingOf(scene, kFovY, 1.5);
        return glm::normalize(framing.targetWS - framing.eyeWS);
    };
    const auto expect = [](const glm::dvec3& seen, const glm::dvec3& wanted) {
        EXPECT_LT(glm::distance(seen, wanted), kFramingRounding) << seen.x << ' ' << seen.y << ' ' << seen.z;
    };
    expect(forward(triangle({0, 0, 0}, {2, 0, 0}, {0, 4, 0})), {0, 0, -1});
    expect(forward(triangle({0, 0, 0}, {0, 4, 0}, {2, 0, 0})), {0, 0, 1});
    expect(forward(triangle({0, 0, 0}, {0, 2, 0}, {0, 0, 4})), {-1, 0, 0});
    expect(forward(triangle({0, 0, 0}, {0, 0, 4}, {2, 0.01f, 0})), {0, -1, 0});
    expect(forward(triangle({0, 0, 0}, {2, 0, 0}, {0, 4, 2})), -glm::normalize(glm::dvec3(1.0, 0.7, 1.0)));
    // A line has no unique plane, so the default direction applies.
    expect(forward(triangle({0, 0, 0}, {0, 4, 0}, {0, 9, 0})), -glm::normalize(glm::dvec3(1.0, 0.7, 1.0)));
}

TEST(Framing, whatAClipMovesStaysInThePicture) {
    Scene scene = triangle({0, 0, 0}, {2, 0, 1}, {0, 4, 3});
    Rig& rig = scene.rig;
    rig.nodes.push_back({0, glm::dvec3(0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0), glm::dvec3(1.0)});
    Clip& clip = rig.clips.emplace_back();
    clip.name = "slide";
    clip.samplers.push_back({Interpolation::Linear, 3, {0.0f, 2.0f}, {0, 0, 0, 30, 0, -10}});
    clip.channels.push_back({AnimatedProperty::Translation, 0, 0});
    const Box3 still = boundsOverClips(scene);
    EXPECT_EQ(still.max, glm::dvec3(2, 4, 3)) << "it does not play";
    rig.playing.push_back(0);
    const Box3 moving = boundsOverClips(scene);
    EXPECT_EQ(moving.min, glm::dvec3(0, 0, -10));
    EXPECT_EQ(moving.max, glm::dvec3(32, 4, 3));
    EXPECT_EQ(worldBounds(scene).max, glm::dvec3(2, 4, 3)) << "it is back at time 0";

    const Framing framing = framingOf(scene, kFovY, 1.0);
    for (const double seconds : {0.0, 0.7, 1.3, 2.0}) {
        poseScene(scene, seconds);
        Reached reached;
        reach(scene, framing, 1.0, reached);
        EXPECT_LT(std::max({reached.left, reached.right, reached.top, reached.bottom}), 1.0) << seconds;
    }
}

TEST(Framing, whatHasLittleDepthIsSeenFromTheFront) {
    const auto towardsEye = [](double depth) {
        Scene scene = triangle({0, 0, 0}, {2, 0, depth}, {0, 1, 0});
        const Framing framing = framingOf(scene, kFovY, 1.0);
        return glm::normalize(framing.eyeWS - framing.targetWS);
    };
    const glm::dvec3 panel = towardsEye(0.6), body = towardsEye(0.8);
    EXPECT_NEAR(panel.x, 0.0, 1e-9);
    EXPECT_NEAR(glm::degrees(std::asin(panel.y)), 7.4, 0.1);
    EXPECT_NEAR(body.x, body.z, 1e-9);
}

TEST(Framing, theCameraThatIsSuppliedFitsTheAspectOfThePicture) {
    const auto camera = [](Scene scene, std::optional<double> aspect) {
        addDefaultCamera(scene, aspect);
        EXPECT_TRUE(scene.supplied.camera);
        return scene.cameras.at(0);
    };
    Scene scene = triangle({0, 0, 0}, {20, 0, 1}, {0, 4, 3});
    const Camera wide = camera(scene, 4.0), narrow = camera(scene, 0.25);
    EXPECT_LT(2.0 * glm::length(glm::dvec3(wide.worldFromCamera[3])),
              glm::length(glm::dvec3(narrow.worldFromCamera[3])));
    EXPECT_EQ(wide.nearMetres, narrow.nearMetres) << "so that eye and target say all of it";
    EXPECT_EQ(camera(scene, {}), camera(scene, 16.0 / 9.0));
    scene.options.requested["size"] = std::vector<double>{400, 100};
    EXPECT_EQ(camera(scene, {}), wide);
}

} // namespace
} // namespace tessera::scenes
