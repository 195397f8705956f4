#include "renderer/frame/Tangents.h"

#include <gtest/gtest.h>

#include "tests/support/Random.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

using test::quad;

TEST(Tangents, aQuadAlwaysHasTheTangentThatIsFoundByHand) {
    for (const glm::vec4& tangent : computeTangents(quad(), 0)) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
    scenes::Mesh turned = quad(); // the picture turned by a quarter: u grows along y, v (down) along x
    turned.texCoords[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    for (const glm::vec4& tangent : computeTangents(turned, 0)) EXPECT_EQ(tangent, glm::vec4(0, 1, 0, 1));
}

TEST(Tangents, mirroredCoordinatesAlwaysKeepTheirHandedness) {
    scenes::Mesh mirrored = quad();
    for (glm::vec2& uv : mirrored.texCoords[0]) uv.x = 1.0f - uv.x;
    for (const glm::vec4& tangent : computeTangents(mirrored, 0)) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
    scenes::Mesh upsideDown = quad();
    for (glm::vec2& uv : upsideDown.texCoords[0]) uv.y = 1.0f - uv.y;
    for (const glm::vec4& tangent : computeTangents(upsideDown, 0)) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, -1));
}

TEST(Tangents, theAskedForSetIsAlwaysTheOneUsed) {
    scenes::Mesh mesh = quad();
    mesh.texCoords[1] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    EXPECT_EQ(computeTangents(mesh, 1).front(), glm::vec4(0, 1, 0, 1));
}

TEST(Tangents, framesAreAlwaysOfUnitLengthAndPerpendicularToTheNormal) {
    test::Random random(1);
    scenes::Mesh mesh;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        mesh.positionsOS.emplace_back(random.direction());
        mesh.normalsOS.emplace_back(random.direction());
        mesh.texCoords[0].emplace_back(random.unit(), random.unit());
        mesh.indices.push_back(i);
    }
    const std::vector<glm::vec4> tangents = computeTangents(mesh, 0);
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        const glm::vec3 t(tangents[i]);
        // Rounding of a unit vector to fp32: half an ulp a component.
        ASSERT_NEAR(glm::length(t), 1.0f, 3e-7f) << i;
        ASSERT_NEAR(glm::dot(t, mesh.normalsOS[i]), 0.0f, 3e-7f) << i;
        ASSERT_TRUE(tangents[i].w == 1.0f || tangents[i].w == -1.0f) << i;
    }
}

TEST(Tangents, coordinatesWithoutAreaAlwaysGiveAStableFrame) {
    test::Random random(2);
    scenes::Mesh mesh = quad();
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 n = i == 0 ? glm::dvec3(0, 0, 1) : i == 1 ? glm::dvec3(0, 0, -1) : random.direction();
        mesh.normalsOS.assign(4, glm::vec3(n));
        mesh.texCoords[0].assign(4, glm::vec2(0.3f, 0.7f));
        const std::vector<glm::vec4> points = computeTangents(mesh, 0);
        mesh.texCoords[0] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}}; // a line: no area either
        const std::vector<glm::vec4> line = computeTangents(mesh, 0);
        mesh.texCoords[0].clear();
        const std::vector<glm::vec4> none = computeTangents(mesh, 0);
        ASSERT_EQ(points[0], line[0]);
        ASSERT_EQ(points[0], none[0]);
        ASSERT_NEAR(glm::length(glm::vec3(points[0])), 1.0f, 3e-7f);
        ASSERT_NEAR(glm::dot(glm::vec3(points[0]), mesh.normalsOS[0]), 0.0f, 3e-7f);
        ASSERT_EQ(points[0].w, 1.0f);
        // Stable: a normal a little aside has a frame a little aside, except at the seam near n = -z (n.z < 0 and
        // back).
        const glm::dvec3 aside = glm::normalize(n + 1e-4 * random.direction());
        if ((aside.z < 0.0) != (n.z < 0.0) || n.z < -0.999) continue;
        mesh.normalsOS.assign(4, glm::vec3(aside));
        ASSERT_LE(glm::distance(computeTangents(mesh, 0)[0], points[0]), 1e-3f);
    }
}

TEST(Tangents, aTangentAlongTheNormalNeverGivesNaN) {
    scenes::Mesh mesh = quad();
    mesh.normalsOS.assign(4, {1, 0, 0}); // along u: what is left after Gram-Schmidt has no direction
    for (const glm::vec4& tangent : computeTangents(mesh, 0)) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 3e-7f);
        EXPECT_NEAR(tangent.x, 0.0f, 3e-7f);
    }
}

} // namespace
} // namespace tessera::frame
