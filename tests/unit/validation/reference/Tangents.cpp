#include "validation/reference/Tangents.h"

#include <gtest/gtest.h>

#include "renderer/frame/Tangents.h"
#include "scenes/Load.h"
#include "tests/support/TestScenes.h"

namespace tessera::reference {
namespace {

using test::quad;

TEST(ReferenceTangents, aQuadAlwaysHasTheTangentThatIsFoundByHand) {
    for (const glm::dvec4& tangent : tangentsOS(quad(), 0)) EXPECT_EQ(tangent, glm::dvec4(1, 0, 0, 1));
    scenes::Mesh mirrored = quad();
    for (glm::vec2& uv : mirrored.texCoords[0]) uv.x = 1.0f - uv.x;
    for (const glm::dvec4& tangent : tangentsOS(mirrored, 0)) EXPECT_EQ(tangent, glm::dvec4(-1, 0, 0, -1));
}

TEST(ReferenceTangents, coordinatesWithoutAreaAlwaysGiveAUnitFrameAcrossTheNormal) {
    scenes::Mesh mesh = quad();
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::normalize(glm::vec3(1, 2, -3))}) {
        mesh.normalsOS.assign(4, normal);
        for (const std::vector<glm::vec2>& uv : {std::vector<glm::vec2>(4, {0.3f, 0.3f}), std::vector<glm::vec2>()}) {
            mesh.texCoords[0] = uv;
            for (const glm::dvec4& tangent : tangentsOS(mesh, 0)) {
                EXPECT_NEAR(glm::length(glm::dvec3(tangent)), 1.0, 1e-7); // the float normal's own length
                EXPECT_NEAR(glm::dot(glm::dvec3(tangent), glm::dvec3(normal)), 0.0, 1e-7);
            }
        }
    }
}

/// Two programs of one definition, written apart.
TEST(ReferenceTangents, onBuiltinScenesTheyAreAlwaysTheProducts) {
    std::size_t compared = 0;
    for (const char* name : {"hall", "head"}) {
        const scenes::Scene scene = scenes::loadScene(name);
        for (const scenes::Mesh& mesh : scene.meshes) {
            if (mesh.texCoords[0].empty() || mesh.positionsOS.size() > 50000) continue;
            const std::vector<glm::dvec4> own = tangentsOS(mesh, 0);
            const std::vector<glm::vec4> product = frame::computeTangents(mesh, 0);
            for (std::size_t i = 0; i < own.size(); ++i) {
                // fp32 storage; coordinates that hardly span an area magnify their own rounding.
                ASSERT_LT(glm::distance(own[i], glm::dvec4(product[i])), 1e-4) << mesh.name << ' ' << i;
            }
            compared += own.size();
        }
    }
    EXPECT_GT(compared, 10000u);
}

} // namespace
} // namespace tessera::reference
