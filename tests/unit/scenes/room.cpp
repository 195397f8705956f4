#include "scenes/builtin/Room.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/builtin/Builtin.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"

namespace tessera::scenes::builtin {
namespace {

/// The nearest front-facing triangle hit by a ray, by brute force over the scene's geometry.
struct Hit {
    double along = kInfinity;
    int material = kNone;
    glm::dvec3 normalWS{0.0};
};

Hit trace(const Scene& scene, const glm::dvec3& originWS, const glm::dvec3& directionWS) {
    Hit hit;
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
                const auto corner = [&](std::size_t k) {
                    return glm::dvec3(worldFromNode[n] *
                                      glm::dvec4(glm::dvec3(mesh.positionsOS[mesh.indices[t + k]]), 1.0));
                };
                const glm::dvec3 e1 = corner(1) - corner(0);
                const glm::dvec3 e2 = corner(2) - corner(0);
                const glm::dvec3 front = glm::cross(e1, e2);
                const double approach = glm::dot(front, directionWS);
                if (approach >= 0.0) continue;
                const glm::dvec3 arm = originWS - corner(0);
                const double along = -glm::dot(front, arm) / approach;
                const glm::dvec3 across = glm::cross(directionWS, arm);
                const double u = glm::dot(e2, across) / approach;
                const double v = -glm::dot(e1, across) / approach;
                if (along <= 0.0 || along >= hit.along || u < 0.0 || v < 0.0 || u + v > 1.0) continue;
                hit = {along, instance.material, glm::normalize(front)};
            }
        }
    }
    return hit;
}

TEST(Room, closedFormMatchesTheSceneAlongEveryRay) {
    const Scene scene = underLedger(makeRoom, LoadOptions{});
    int seen[kRoomMaterialCount] = {};
    for (const Camera& camera : scene.cameras) {
        for (int i = 0; i < 41; ++i) {
            for (int j = 0; j < 31; ++j) {
                const glm::dvec3 directionCS((i - 20) / 17.3, (j - 15) / 19.7, -1.0);
                const glm::dvec3 directionWS(camera.worldFromCamera * glm::dvec4(directionCS, 0.0));
                const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
                const auto point = roomPointAlong(eyeWS, directionWS);
                const Hit hit = trace(scene, eyeWS, directionWS);
                ASSERT_TRUE(point.has_value()) << "the room is closed";
                ASSERT_EQ(int(point->material), hit.material) << i << ' ' << j;
                // Vertices are in single precision: 2^-24 of up to 3 m, a few times enlarged at grazing rays.
                EXPECT_LT(glm::distance(point->positionWS, eyeWS + hit.along * directionWS), 2e-6);
                EXPECT_GT(glm::dot(point->normalWS, hit.normalWS), 1.0 - 1e-6);
                ++seen[hit.material];
            }
        }
    }
    for (std::size_t m = 0; m < kRoomMaterialCount; ++m) EXPECT_GT(seen[m], 0) << kRoomFinishes[m].name;
}

TEST(Room, radianceIsTheInverseSquareTimesTheCosine) {
    // Straight below the lamp: d = 1.5 m, cos = 1.
    const glm::dvec3 below = roomRadiance({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, RoomMaterial::Floor);
    EXPECT_DOUBLE_EQ(below.x, 0.5 * 1.5 / 2.25);
    // On the far wall, 3 m behind and 1.5 m aside: d^2 = 11.25 m^2, cos = 3 / d; the model divides by pi.
    const glm::dvec3 far = roomRadiance({1.5, 1.5, -3.0}, {0.0, 0.0, 1.0}, RoomMaterial::FarWall);
    EXPECT_DOUBLE_EQ(far.z, 0.8125 / std::numbers::pi * 1.5 * 3.0 / std::pow(11.25, 1.5));
    // Facing away from the lamp, only emission is left; the unlit colour is unaffected.
    EXPECT_EQ(roomRadiance({1.0, 1.5, 0.0}, {1.0, 0.0, 0.0}, RoomMaterial::Panel), glm::dvec3(0.5, 0.375, 0.125));
    EXPECT_EQ(roomRadiance({1.0, 1.5, 0.0}, {1.0, 0.0, 0.0}, RoomMaterial::Floor), glm::dvec3(0.0));
    EXPECT_EQ(roomRadiance({-0.5, 1.75, -2.99}, {0.0, 0.0, 1.0}, RoomMaterial::Sign), glm::dvec3(0.25, 0.5, 0.75));
}

TEST(Room, anyNumberOfLightsSharesTheOneLamp) {
    const Scene scene = underLedger(makeRoom, loading(&LoadOptions::lights, 8));
    ASSERT_EQ(scene.lights.size(), 8u);
    float sum = 0.0f;
    for (const Light& light : scene.lights) {
        EXPECT_EQ(light.positionWS, kRoomLampWS);
        EXPECT_EQ(light.rangeMetres, kInfinity);
        sum += light.intensity;
    }
    EXPECT_EQ(sum, 1.5f) << "eighths of 1.5 are exact";
}

} // namespace
} // namespace tessera::scenes::builtin
