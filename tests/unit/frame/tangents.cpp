#include "renderer/frame/Tangents.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/MikkTSpaceTruth.h"
#include "tests/support/Random.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

using scenes::TangentMethod;
using test::quad;

/// Tangents of all corners, one per index.
std::vector<glm::vec4> cornerTangents(const scenes::Mesh& mesh, const TangentBasis& basis) {
    const TangentMesh split = meshWithTangents(mesh, basis);
    std::vector<glm::vec4> corners;
    for (const std::uint32_t vertex : split.indices) corners.push_back(split.tangentsOS[vertex]);
    return corners;
}

class TangentMethods : public testing::TestWithParam<TangentMethod> {
protected:
    std::vector<glm::vec4> tangents(const scenes::Mesh& mesh, int texCoordSet = 0) const {
        return cornerTangents(mesh, {GetParam(), texCoordSet});
    }
};
INSTANTIATE_TEST_SUITE_P(Tangents, TangentMethods, testing::Values(TangentMethod::MikkTSpace, TangentMethod::Lengyel));

TEST_P(TangentMethods, aQuadHasTheTangentThatIsFoundByHand) {
    for (const glm::vec4& tangent : tangents(quad())) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
    scenes::Mesh turned = quad(); // the image turned by a quarter: u grows along y, v (down) along x
    turned.texCoords[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    for (const glm::vec4& tangent : tangents(turned)) EXPECT_EQ(tangent, glm::vec4(0, 1, 0, 1));
}

TEST_P(TangentMethods, mirroredCoordinatesAlwaysKeepTheirHandedness) {
    scenes::Mesh mirrored = quad();
    for (glm::vec2& uv : mirrored.texCoords[0]) uv.x = 1.0f - uv.x;
    for (const glm::vec4& tangent : tangents(mirrored)) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
    scenes::Mesh upsideDown = quad();
    for (glm::vec2& uv : upsideDown.texCoords[0]) uv.y = 1.0f - uv.y;
    for (const glm::vec4& tangent : tangents(upsideDown)) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, -1));
}

TEST_P(TangentMethods, theRequestedSetIsAlwaysTheOneUsed) {
    scenes::Mesh mesh = quad();
    mesh.texCoords[1] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    EXPECT_EQ(tangents(mesh, 1).front(), glm::vec4(0, 1, 0, 1));
}

TEST_P(TangentMethods, framesAreAlwaysOfUnitLengthAndPerpendicularToTheNormal) {
    test::Random random(1);
    scenes::Mesh mesh;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        mesh.positionsOS.emplace_back(random.direction());
        mesh.normalsOS.emplace_back(random.direction());
        mesh.texCoords[0].emplace_back(random.unit(), random.unit());
        mesh.indices.push_back(i);
    }
    const std::vector<glm::vec4> all = tangents(mesh);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::vec3 t(all[i]);
        // Rounding of a unit vector to fp32: half an ulp per component.
        ASSERT_NEAR(glm::length(t), 1.0f, 3e-7f) << i;
        ASSERT_NEAR(glm::dot(t, mesh.normalsOS[i]), 0.0f, 3e-7f) << i;
        ASSERT_TRUE(all[i].w == 1.0f || all[i].w == -1.0f) << i;
    }
}

TEST_P(TangentMethods, coordinatesWithoutAreaAlwaysGiveAStableFrame) {
    test::Random random(2);
    scenes::Mesh mesh = quad();
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 n = i == 0 ? glm::dvec3(0, 0, 1) : i == 1 ? glm::dvec3(0, 0, -1) : random.direction();
        mesh.normalsOS.assign(4, glm::vec3(n));
        mesh.texCoords[0].assign(4, glm::vec2(0.3f, 0.7f));
        const std::vector<glm::vec4> points = tangents(mesh);
        mesh.texCoords[0] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}}; // a line: no area either
        const std::vector<glm::vec4> line = tangents(mesh);
        mesh.texCoords[0].clear();
        const std::vector<glm::vec4> none = tangents(mesh);
        ASSERT_EQ(points[0], line[0]);
        ASSERT_EQ(points[0], none[0]);
        ASSERT_NEAR(glm::length(glm::vec3(points[0])), 1.0f, 3e-7f);
        ASSERT_NEAR(glm::dot(glm::vec3(points[0]), mesh.normalsOS[0]), 0.0f, 3e-7f);
        ASSERT_EQ(points[0].w, GetParam() == TangentMethod::MikkTSpace ? -1.0f : 1.0f);
        // Stable: a small change of the normal changes the frame little, except at the seam near n = -z (n.z < 0 and
        // back).
        const glm::dvec3 aside = glm::normalize(n + 1e-4 * random.direction());
        if ((aside.z < 0.0) != (n.z < 0.0) || n.z < -0.999) continue;
        mesh.normalsOS.assign(4, glm::vec3(aside));
        ASSERT_LE(glm::distance(tangents(mesh)[0], points[0]), 1e-3f);
    }
}

TEST_P(TangentMethods, aTangentAlongTheNormalNeverGivesNaN) {
    scenes::Mesh mesh = quad();
    mesh.normalsOS.assign(4, {1, 0, 0}); // along u: the remainder after Gram-Schmidt has no direction
    for (const glm::vec4& tangent : tangents(mesh)) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 3e-7f);
        EXPECT_NEAR(tangent.x, 0.0f, 3e-7f);
    }
}

/// The reference values have seven decimals; single precision in that program is off by 2e-6 from the formulas.
TEST(Tangents, theyAreThoseOfAnOutsideProgramWithMikkTSpace) {
    for (const bool isIndexed : {true, false}) {
        std::size_t compared = 0;
        for (const test::MikkTSpaceTruth& truth : test::mikkTSpaceTruth(isIndexed)) {
            const std::vector<glm::vec4> own = cornerTangents(truth.mesh, {});
            ASSERT_EQ(own.size(), truth.tangentsOS.size());
            for (std::size_t i = 0; i < own.size(); ++i)
                ASSERT_LE(glm::distance(own[i], truth.tangentsOS[i]), 1e-5f) << truth.name << ' ' << i;
            compared += own.size();
        }
        EXPECT_EQ(compared, 4344u);
    }
}

TEST(Tangents, verticesAreSplitExactlyWhereTheirTrianglesHaveDifferentTangents) {
    for (const test::MikkTSpaceTruth& truth : test::mikkTSpaceTruth(true)) {
        const TangentMesh split = meshWithTangents(truth.mesh, {});
        const std::size_t own = truth.mesh.positionsOS.size();
        ASSERT_EQ(split.tangentsOS.size(), own + split.copiedOf.size());
        // The torus has 13 vertices between its mirrored halves.
        const std::map<std::string, std::size_t> expected = {
            {"torus_mirrored", 13}, {"degenerate_uv", 0}, {"torus", 0}};
        if (const auto known = expected.find(truth.name); known != expected.end()) {
            EXPECT_EQ(split.copiedOf.size(), known->second) << truth.name;
        }
        for (std::size_t i = 0; i < split.indices.size(); ++i) {
            const std::uint32_t vertex = split.indices[i];
            EXPECT_EQ(vertex < own ? vertex : split.copiedOf[vertex - own], truth.mesh.indices[i]);
        }
        EXPECT_TRUE(meshWithTangents(truth.mesh, {TangentMethod::Lengyel}).copiedOf.empty()) << "Lengyel never splits";
    }
}

TEST(Tangents, trianglesWithoutAreaInSpaceTakeTheTangentOfTheFirstOtherAtTheirVertices) {
    scenes::Mesh mesh = quad();
    mesh.indices.insert(mesh.indices.begin(), {0, 0, 1});
    for (const glm::vec4& tangent : cornerTangents(mesh, {})) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

/// Transforms of texture coordinates (KHR_texture_transform) and the expected tangents of a quad.
TEST(Tangents, theTexturesTransformIsAppliedFirst) {
    const auto material = [](glm::vec2 scale, float rotationRadians) {
        scenes::Material result;
        scenes::TextureUse& use = result.texture(scenes::TextureSlot::Normal);
        use.image = 0;
        use.transform = {{0.3f, 0.4f}, scale, rotationRadians};
        return result;
    };
    const float quarter = glm::radians(90.0f), root = std::sqrt(0.5f);
    const auto expectTangent = [&](glm::vec2 scale, float rotationRadians, const glm::vec4& expected) {
        const TangentBasis basis = *tangentBasis(material(scale, rotationRadians));
        scenes::Mesh own = quad();
        own.tangentsOS.assign(4, {1, 0, 0, 1});
        for (const scenes::Mesh& mesh : {quad(), own}) {
            for (const glm::vec4& tangent : cornerTangents(mesh, basis))
                EXPECT_LE(glm::distance(tangent, expected), 1e-6f) << tangent.x << ' ' << tangent.y << ' ' << tangent.w;
        }
    };
    expectTangent({1, 1}, 0, {1, 0, 0, 1});
    expectTangent({30, 30}, 0, {1, 0, 0, 1});
    expectTangent({1, -1}, 0, {1, 0, 0, -1});
    expectTangent({-1, 1}, 0, {-1, 0, 0, -1});
    expectTangent({-1, -1}, 0, {-1, 0, 0, 1});
    // Coordinates that turn counter-clockwise turn the image clockwise: its right is the quad's bottom.
    expectTangent({1, 1}, quarter, {0, -1, 0, 1});
    expectTangent({1, 1}, quarter / 2, {root, -root, 0, 1});
    expectTangent({1, -1}, quarter, {0, 1, 0, -1});
}

TEST(Tangents, aTextureThatIsScaledToNothingLeavesAMeshesOwnAndGivesOthersAnyFrame) {
    const TangentBasis nothing{TangentMethod::MikkTSpace, 0, glm::dmat2(0.0)};
    EXPECT_EQ(cornerTangents(quad(), nothing)[0], glm::vec4(1, 0, 0, -1));
    scenes::Mesh own = quad();
    own.tangentsOS.assign(4, {0, 1, 0, 1});
    EXPECT_EQ(cornerTangents(own, nothing)[0], glm::vec4(0, 1, 0, 1));
}

/// Reference: the coordinates transformed themselves, on meshes with stretched and sheared textures.
TEST(Tangents, aTransformEqualsTransformedCoordinates) {
    for (const test::MikkTSpaceTruth& truth : test::mikkTSpaceTruth(true)) {
        if (truth.name == "degenerate_uv") continue; // rounding gives its triangles an area
        scenes::Material material;
        scenes::TextureUse& use = material.texture(scenes::TextureSlot::Normal);
        use.image = 0;
        use.transform = {{0.0f, 0.0f}, {2.0f, -0.5f}, 0.7f};
        scenes::Mesh transformed = truth.mesh;
        const double c = std::cos(double(0.7f)), s = std::sin(double(0.7f));
        for (glm::vec2& uv : transformed.texCoords[0]) {
            const glm::dvec2 scaled = 2.0 * glm::dvec2(uv) * glm::dvec2(1.0, -0.25);
            uv = glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
        }
        for (const TangentMethod method : {TangentMethod::MikkTSpace, TangentMethod::Lengyel}) {
            material.tangents = method;
            const std::vector<glm::vec4> once = cornerTangents(truth.mesh, *tangentBasis(material));
            const std::vector<glm::vec4> same = cornerTangents(transformed, {method});
            for (std::size_t i = 0; i < once.size(); ++i) {
                // The sums of Lengyel's method may cancel.
                if (method == TangentMethod::Lengyel && truth.name != "sheet_sheared") continue;
                ASSERT_LE(glm::distance(once[i], same[i]), 2e-5f) << truth.name << ' ' << i;
            }
        }
    }
}

TEST(Tangents, texturesAreTurnedByTheirTransformsAgainstTheOneThatTangentsFollow) {
    using scenes::TextureSlot;
    scenes::Material material;
    material.clearcoat = 1.0f;
    material.anisotropyStrength = 0.5f;
    const auto expectTurn = [&](TextureSlot slot, const glm::dmat2& expected) {
        const glm::dmat2 turn = tangentsFromTexture(material, slot);
        for (glm::length_t i = 0; i < 2; ++i) EXPECT_LE(glm::distance(turn[i], expected[i]), 1e-7) << int(slot);
    };
    const glm::dmat2 none(1.0), quarterRight(0, -1, 1, 0), mirrored(1, 0, 0, -1);
    scenes::TextureUse& coat = material.texture(TextureSlot::ClearcoatNormal);
    coat.image = 0;
    coat.transform.rotationRadians = glm::radians(90.0f);
    expectTurn(TextureSlot::ClearcoatNormal, quarterRight); // relative to the anisotropy direction without a texture
    scenes::TextureUse& normal = material.texture(TextureSlot::Normal);
    normal.image = 0;
    normal.transform = coat.transform;
    expectTurn(TextureSlot::Normal, none);
    expectTurn(TextureSlot::ClearcoatNormal, none);
    expectTurn(TextureSlot::Anisotropy, glm::transpose(quarterRight));
    normal.transform = {{0, 0}, {3, -3}, 0.0f};
    expectTurn(TextureSlot::ClearcoatNormal, mirrored * quarterRight);
    expectTurn(TextureSlot::Anisotropy, mirrored);
    material.texture(TextureSlot::Anisotropy) = normal;
    expectTurn(TextureSlot::Anisotropy, none);
    material.model = scenes::MaterialModel::MicrofacetAnisotropic; // its texture stores a scalar
    expectTurn(TextureSlot::Anisotropy, mirrored);
}

} // namespace
} // namespace tessera::frame
