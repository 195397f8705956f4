#include "validation/reference/Tangents.h"

#include <gtest/gtest.h>

#include "renderer/frame/Tangents.h"
#include "scenes/Load.h"
#include "tests/support/MikkTSpaceTruth.h"
#include "tests/support/Random.h"
#include "tests/support/TestScenes.h"

namespace tessera::reference {
namespace {

using scenes::TangentMethod;
using test::quad;

/// A material with a normal map in the first set of texture coordinates.
scenes::Material mapped(TangentMethod method = TangentMethod::MikkTSpace,
                        const scenes::TextureTransform& transform = {}) {
    scenes::Material material;
    material.tangents = method;
    material.texture(scenes::TextureSlot::Normal).image = 0;
    material.texture(scenes::TextureSlot::Normal).transform = transform;
    return material;
}

TEST(ReferenceTangents, aQuadHasTheTangentThatIsFoundByHand) {
    for (const TangentMethod method : {TangentMethod::MikkTSpace, TangentMethod::Lengyel}) {
        for (const glm::dvec4& tangent : tangentsOS(quad(), mapped(method))) EXPECT_EQ(tangent, glm::dvec4(1, 0, 0, 1));
        scenes::Mesh mirrored = quad();
        for (glm::vec2& uv : mirrored.texCoords[0]) uv.x = 1.0f - uv.x;
        for (const glm::dvec4& tangent : tangentsOS(mirrored, mapped(method)))
            EXPECT_EQ(tangent, glm::dvec4(-1, 0, 0, -1));
    }
}

/// The reference values have seven decimals; single precision in that program is off by 2e-6 from the formulas.
TEST(ReferenceTangents, theyAreThoseOfAnOutsideProgramWithMikkTSpace) {
    for (const bool isIndexed : {true, false}) {
        for (const test::MikkTSpaceTruth& truth : test::mikkTSpaceTruth(isIndexed)) {
            const std::vector<glm::dvec4> own = tangentsOS(truth.mesh, mapped());
            ASSERT_EQ(own.size(), truth.tangentsOS.size());
            for (std::size_t i = 0; i < own.size(); ++i)
                ASSERT_LE(glm::distance(own[i], glm::dvec4(truth.tangentsOS[i])), 1e-5) << truth.name << ' ' << i;
        }
    }
}

TEST(ReferenceTangents, aMeshesOwnAreTurnedAndMirroredAsTheTextureIs) {
    scenes::Mesh mesh = quad();
    mesh.tangentsOS.assign(4, {1, 0, 0, 1});
    const auto expectAll = [&](glm::vec2 scale, float degrees, const glm::dvec4& expected) {
        for (const glm::dvec4& tangent : tangentsOS(mesh, mapped({}, {{}, scale, glm::radians(degrees)})))
            EXPECT_LE(glm::distance(tangent, expected), 1e-7) << scale.x << ' ' << scale.y << ' ' << degrees;
    };
    expectAll({2, 2}, 0.0f, {1, 0, 0, 1});
    expectAll({1, -1}, 0.0f, {1, 0, 0, -1});
    expectAll({-1, 1}, 0.0f, {-1, 0, 0, -1});
    expectAll({1, 1}, 90.0f, {0, -1, 0, 1});
    expectAll({1, -1}, 90.0f, {0, 1, 0, -1});
    mesh.tangentsOS.clear();
    expectAll({1, -1}, 90.0f, {0, 1, 0, -1}); // same for derived tangents
}

TEST(ReferenceTangents, coordinatesWithoutAreaGiveAUnitFrameAcrossTheNormal) {
    scenes::Mesh mesh = quad();
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::normalize(glm::vec3(1, 2, -3))}) {
        mesh.normalsOS.assign(4, normal);
        for (const std::vector<glm::vec2>& uv : {std::vector<glm::vec2>(4, {0.3f, 0.3f}), std::vector<glm::vec2>()}) {
            mesh.texCoords[0] = uv;
            for (const TangentMethod method : {TangentMethod::MikkTSpace, TangentMethod::Lengyel}) {
                for (const glm::dvec4& tangent : tangentsOS(mesh, mapped(method))) {
                    EXPECT_NEAR(glm::length(glm::dvec3(tangent)), 1.0, 1e-7); // length of the float normal
                    EXPECT_NEAR(glm::dot(glm::dvec3(tangent), glm::dvec3(normal)), 0.0, 1e-7);
                }
            }
        }
    }
}

/// The largest distance between the reference's tangents and the product's.
double worstDistance(const scenes::Mesh& mesh, const scenes::Material& material) {
    const std::vector<glm::dvec4> own = tangentsOS(mesh, material);
    const frame::TangentMesh product = frame::meshWithTangents(mesh, *frame::tangentBasis(material));
    double worst = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i)
        worst = std::max(worst, glm::distance(own[i], glm::dvec4(product.tangentsOS[product.indices[i]])));
    return worst;
}

/// Two independent implementations of one definition.
TEST(ReferenceTangents, onBuiltinScenesTheyAreTheProducts) {
    std::size_t compared = 0;
    for (const char* name : {"hall", "head"}) {
        const scenes::Scene scene = scenes::loadScene(name);
        for (const scenes::Mesh& mesh : scene.meshes) {
            if (mesh.texCoords[0].empty() || mesh.positionsOS.size() > 50000) continue;
            // fp32 storage; coordinates that hardly span an area magnify their own rounding.
            for (const TangentMethod method : {TangentMethod::MikkTSpace, TangentMethod::Lengyel})
                ASSERT_LT(worstDistance(mesh, mapped(method, {{}, {2, -3}, 0.5f})), 1e-4) << mesh.name;
            compared += mesh.positionsOS.size();
        }
    }
    EXPECT_GT(compared, 10000u);
}

/// Few points, normals and coordinates, so that triangles lie on each other, meet in twos and threes along an edge,
/// have no area in space or in the texture, and are mirrored against their neighbours.
TEST(ReferenceTangents, tangentsOfTangledMeshesEqualTheProducts) {
    test::Random random(7);
    std::size_t split = 0;
    for (int round = 0; round < 300; ++round) {
        scenes::Mesh mesh;
        for (int i = 0; i < 24; ++i) {
            const auto below = [&](double count) { return float(std::floor(count * random.unit())); };
            mesh.positionsOS.emplace_back(below(3), below(3), below(2) * 0.3f);
            mesh.normalsOS.emplace_back(glm::normalize(glm::vec3(below(2) * 0.2f, round % 3 == 0 ? 0.0f : 0.1f, 1)));
            mesh.texCoords[0].emplace_back(below(3), below(3));
        }
        for (int i = 0; i < 120; ++i) mesh.indices.push_back(std::uint32_t(24.0 * random.unit()));
        ASSERT_LT(worstDistance(mesh, mapped({}, {{}, {1, round % 2 == 0 ? 1 : -1}, 0.1f * float(round)})), 1e-5)
            << round;
        split += frame::meshWithTangents(mesh, {}).copiedOf.size();
    }
    EXPECT_GT(split, 1000u);
}

} // namespace
} // namespace tessera::reference
