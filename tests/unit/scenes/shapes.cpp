#include "scenes/builtin/Shapes.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/Pictures.h"
#include "tests/unit/scenes/MeshRules.h"

namespace tessera::scenes::builtin {
namespace {

using std::numbers::pi;

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positionsOS[mesh.indices[i]]);
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positionsOS[mesh.indices[i + 1]]) - a,
                                            glm::dvec3(mesh.positionsOS[mesh.indices[i + 2]]) - a));
    }
    return sum;
}

/// Signed volume of a closed mesh, positive if its triangles face outwards (divergence theorem).
double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positionsOS[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positionsOS[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positionsOS[mesh.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

TEST(Shapes, boxHasItsVolumeAndFacesOutwards) {
    Mesh mesh;
    appendBox(mesh, {1.0, -2.0, 0.5}, {2.0, 1.0, 4.5});
    expectMeshRules(mesh);
    EXPECT_DOUBLE_EQ(volume(mesh), 12.0);
    EXPECT_EQ(mesh.indices.size(), 36u);
}

TEST(Shapes, sphereNearsItsVolumeFromBelow) {
    Mesh mesh;
    appendSphere(mesh, {0.0, 1.0, 0.0}, 2.0, 96, 64);
    expectMeshRules(mesh);
    const double exact = 4.0 / 3.0 * pi * 8.0;
    EXPECT_LT(volume(mesh), exact);
    EXPECT_GT(volume(mesh), 0.995 * exact); // inscribed: short by about (2 pi / 96)^2 / 3
}

TEST(Shapes, latheOfAConeHasItsVolumeAndOutwardNormals) {
    Mesh mesh;
    appendLathe(mesh, Profile({0.0, 0.0}).lineTo({1.0, 0.0}).lineTo({0.0, 3.0}), 256);
    expectMeshRules(mesh);
    EXPECT_NEAR(volume(mesh), pi, 1e-3 * pi); // inscribed polygon of 256 sides: 1e-4 short
}

TEST(Shapes, archSweepsTheUpperHalfCircle) {
    Mesh mesh; // a band of radius 2, facing inwards, 0.5 m wide
    appendArch(mesh, Profile({2.0, 0.5}).lineTo({2.0, 0.0}), {0.0, 1.0, 0.0}, 256);
    expectMeshRules(mesh);
    EXPECT_NEAR(area(mesh), 0.5 * 2.0 * pi, 1e-3);
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::dvec3 arm = glm::dvec3(mesh.positionsOS[i]) - glm::dvec3(0.0, 1.0, 0.0);
        EXPECT_NEAR(std::hypot(arm.x, arm.y), 2.0, 1e-6);
        EXPECT_GE(arm.y, -1e-6);
        EXPECT_LT(glm::dot(arm, glm::dvec3(mesh.normalsOS[i])), 0.0);
    }
}

TEST(Shapes, mouldingRunsAlongZ) {
    Mesh mesh;
    appendMoulding(mesh, Profile({1.0, 0.0}).lineTo({1.0, 1.0}), -2.0, 3.0);
    expectMeshRules(mesh);
    EXPECT_DOUBLE_EQ(area(mesh), 5.0);
    EXPECT_EQ(mesh.normalsOS[0], glm::vec3(1.0f, 0.0f, 0.0f));
}

TEST(Shapes, archedWallHasTheAreaOfItsFacesAndSoffit) {
    ArchedWall wall;
    wall.sillY = 1.0;
    wall.archSteps = 256;
    Mesh mesh;
    appendArchedWall(mesh, wall);
    expectMeshRules(mesh);
    const double face = 4.0 * 6.0 - 2.0 * 2.0 - 0.5 * pi;
    const double soffit = 0.5 * (pi + 2.0 * 2.0 + 2.0);
    EXPECT_NEAR(area(mesh), 2.0 * face + soffit, 1e-3);
}

TEST(Shapes, profileArcsAndCurvesHaveUnitNormalsToTheRight) {
    // Counter-clockwise about the origin from +X: travelling up, the outside on the right is away from the centre.
    const Profile arc = Profile({1.0, 0.0}).arcAround({0.0, 0.0}, pi / 2.0, 8);
    for (std::size_t i = 0; i < arc.runs()[0].points.size(); ++i) {
        EXPECT_LT(glm::distance(arc.runs()[0].points[i], arc.runs()[0].normals[i]), 1e-12);
    }
    const Profile line = Profile({1.0, 0.0}).curveThrough({{1.0, 1.0}, {1.0, 3.0}}, 4);
    for (const glm::dvec2& normal : line.runs()[0].normals) EXPECT_LT(glm::distance(normal, {1.0, 0.0}), 1e-12);
    EXPECT_EQ(line.runs()[0].points.back(), glm::dvec2(1.0, 3.0));
}

TEST(Shapes, mirroredAndStretchedPartsKeepTheirFrontOutside) {
    Mesh ball;
    appendSphere(ball, {0.0, 0.0, 0.0}, 1.0, 24, 16);
    Mesh mesh;
    appendMesh(mesh, ball, glm::scale(glm::translate(glm::dmat4(1.0), {1.0, 2.0, 3.0}), {-2.0, 1.0, 0.5}));
    expectMeshRules(mesh);
    EXPECT_NEAR(volume(mesh), volume(ball), 1e-5);
}

TEST(Noise, repeatsWithItsPeriodAndVanishesAtIntegers) {
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 p(0.37 * i, 0.21 * i, 0.5);
        EXPECT_NEAR(gradientNoise(p, 7, {4, 6}), gradientNoise(p + glm::dvec3(4.0, -6.0, 0.0), 7, {4, 6}), 1e-9);
        EXPECT_LE(std::abs(fractalNoise(p, 4, 7)), 1.5);
    }
    EXPECT_EQ(gradientNoise({3.0, -2.0, 5.0}, 7), 0.0);
    EXPECT_NE(gradientNoise({3.3, -2.0, 5.0}, 7), gradientNoise({3.3, -2.0, 5.0}, 8));
}

TEST(Pictures, coloursAreStoredWithTheSrgbTransferFunction) {
    const Image image = drawColors("ramp", 3, 1, [](int x, int) { return glm::dvec3(x * 0.5, 0.0, 1.0); });
    EXPECT_EQ(image.texels[0], std::byte{0});
    EXPECT_EQ(image.texels[4], std::byte{188}); // 255 (1.055 * 0.5^(1/2.4) - 0.055) = 187.5
    EXPECT_EQ(image.texels[8], std::byte{255});
    EXPECT_EQ(image.texels[7], std::byte{255});
}

TEST(Pictures, normalsOfASlopeLeanDownhill) {
    // A saw tooth that rises by one texel's width per texel to the right.
    const Image image = normalsFromHeights("slope", 8, 0.01, [](int x, int) { return 0.01 * x; });
    std::uint16_t red = 0;
    std::memcpy(&red, image.texels.data() + 8 * (8 * 3 + 3), sizeof(red));
    EXPECT_NEAR(red / 65535.0 * 2.0 - 1.0, -std::sqrt(0.5), 2e-5); // one step of 16 bits
}

} // namespace
} // namespace tessera::scenes::builtin
