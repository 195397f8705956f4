#include <cmath>

#include <gtest/gtest.h>

#include "scenes/builtin/Builtin.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"

namespace tessera::scenes::builtin {
namespace {

Scene lattice(std::optional<int> lights = {}) {
    return underLedger(makeLattice, loading(&LoadOptions::lights, lights));
}

TEST(Lattice, hasExactlyTheSpecifiedCountsAndBounds) {
    const Scene scene = lattice();
    EXPECT_EQ(triangleCount(scene), 192000u);
    EXPECT_EQ(scene.materials.size(), 9u);
    EXPECT_EQ(scene.lights.size(), 256u);
    EXPECT_EQ(scene.nodes.size(), 257u);
    const Box3 boundsWS = worldBounds(scene);
    EXPECT_EQ(boundsWS.min, glm::dvec3(-10.0, 0.0, -10.0)) << "the floor";
    EXPECT_EQ(boundsWS.max.x, 10.0);
    EXPECT_EQ(boundsWS.max.z, 10.0);
    EXPECT_NEAR(boundsWS.max.y, 0.9, 1e-7) << "a sphere's pole, stored in single precision";
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t vertices = mesh.positionsOS.size();
        const std::size_t triangles = mesh.indices.size() / 3;
        EXPECT_TRUE((mesh.name == "sphere" && vertices == 33u * 25u && triangles == 1472u) ||
                    (mesh.name == "box" && vertices == 24u && triangles == 12u) ||
                    (mesh.name == "floor" && vertices == 33u * 33u && triangles == 2048u))
            << mesh.name << ' ' << vertices << ' ' << triangles;
    }
}

TEST(Lattice, shapesPlacesAndMaterialsFollowTheGrid) {
    const Scene scene = lattice();
    std::array<std::array<bool, 16>, 16> seen{};
    for (const Node& node : scene.nodes) {
        ASSERT_EQ(node.instances.size(), 1u);
        const std::string& shape = scene.meshes[std::size_t(node.instances[0].mesh)].name;
        if (shape == "floor") {
            EXPECT_EQ(node.instances[0].material, 8);
            continue;
        }
        const glm::dvec3 centerWS(node.parentFromNode[3]);
        const int i = int(std::lround((centerWS.x + 10.0) / 1.25 - 0.5));
        const int j = int(std::lround((centerWS.z + 10.0) / 1.25 - 0.5));
        const bool sphere = (i + j) % 2 == 0;
        EXPECT_EQ(shape, sphere ? "sphere" : "box");
        EXPECT_EQ(centerWS, glm::dvec3((i + 0.5) * 1.25 - 10.0, sphere ? 0.45 : 0.35, (j + 0.5) * 1.25 - 10.0));
        EXPECT_EQ(node.instances[0].material, (i + 2 * j) % 8);
        EXPECT_FALSE(std::exchange(seen.at(std::size_t(i)).at(std::size_t(j)), true));
    }
    const glm::vec3 gold(scene.materials[5].baseColor);
    EXPECT_EQ(gold, glm::vec3(1.0f, 0.8f, 0.3f));
    EXPECT_EQ(scene.materials[5].metallic, 1.0f);
    EXPECT_EQ(scene.materials[5].perceptualRoughness, 0.3f);
    EXPECT_EQ(scene.materials[8].perceptualRoughness, 0.6f);
}

TEST(Lattice, sphereVerticesLieOnTheSphereFromItsPole) {
    const Scene scene = lattice();
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name != "sphere") continue;
        EXPECT_EQ(mesh.positionsOS.front(), glm::vec3(0.0f, 0.45f, 0.0f));
        // Half an ulp of 0.45 per axis.
        for (const glm::vec3& p : mesh.positionsOS) EXPECT_NEAR(glm::length(glm::dvec3(p)), 0.45, 1e-7);
        const glm::vec3 slice0 = mesh.positionsOS[12 * 33]; // on the equator
        EXPECT_NEAR(slice0.x, 0.45f, 1e-7);
        EXPECT_NEAR(slice0.z, 0.0f, 1e-7);
    }
}

TEST(Lattice, lightsAreThoseOfTheIntegerGenerator) {
    const Scene scene = lattice(8);
    ASSERT_EQ(scene.lights.size(), 8u);
    std::uint64_t state = 12345;
    const auto draw = [&] {
        state = (state * 1664525u + 1013904223u) & 0xffffffffu;
        return std::ldexp(double(state), -32);
    };
    for (const Light& light : scene.lights) {
        const float x = float(-10 + 20 * draw());
        const float y = float(1 + 1.2 * draw());
        const float z = float(-10 + 20 * draw());
        const double hue = draw();
        EXPECT_EQ(light.positionWS, glm::dvec3(x, y, z));
        for (int k = 0; k < 3; ++k) {
            const double angle = 6.283185307179586 * (hue + k / 3.0);
            // One rounding to single precision of a value up to 1.
            EXPECT_NEAR(light.color[k], 0.25 + 0.75 * (0.5 + 0.5 * std::cos(angle)), 6e-8);
        }
        EXPECT_EQ(light.type, LightType::Point);
        EXPECT_EQ(light.falloff, Falloff::InverseSquare);
        EXPECT_EQ(light.rangeMetres, 2.5f);
    }
    // The first state of the sequence, worked out by hand: 12345 * 1664525 + 1013904223 mod 2^32 = 87628868.
    EXPECT_EQ(scene.lights[0].positionWS.x, double(float(-10.0 + 20.0 * 87628868.0 / 4294967296.0)));
}

TEST(Lattice, moreLightsBeginWithTheSameOnes) {
    const Scene few = lattice(16);
    const Scene many = lattice(65536);
    ASSERT_EQ(many.lights.size(), 65536u);
    EXPECT_EQ(lattice(0).lights.size(), 0u);
    for (std::size_t i = 0; i < few.lights.size(); ++i) {
        EXPECT_EQ(few.lights[i].positionWS, many.lights[i].positionWS);
        EXPECT_EQ(few.lights[i].color, many.lights[i].color);
    }
}

TEST(Lattice, intensityIsExactlyTabulatedAndInterpolatedInLogLog) {
    const auto candela = [](int lights) { return lattice(lights).lights[0].intensity; };
    EXPECT_EQ(candela(1), 6.0f);
    EXPECT_EQ(candela(16), 6.0f);
    EXPECT_EQ(candela(64), 3.0f);
    EXPECT_EQ(candela(256), 1.0f);
    EXPECT_EQ(candela(1024), 0.3f);
    // Half way in the logarithm: the geometric mean. Single precision.
    EXPECT_NEAR(candela(32), std::sqrt(18.0), 1e-6);
    EXPECT_NEAR(candela(128), std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(candela(65536), 0.3 / 64.0, 1e-9);
}

TEST(Lattice, cameraIsExactlyTheSpecifiedOne) {
    const Scene scene = lattice();
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[3]), glm::dvec3(0.0, 7.0, 9.0));
    const glm::dvec3 forwardWS = glm::normalize(glm::dvec3(0.0, -7.0, -10.0));
    EXPECT_LT(glm::distance(-glm::dvec3(camera.worldFromCamera[2]), forwardWS), 1e-15);
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[0]), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_DOUBLE_EQ(camera.fovYRadians, 0.7853981633974483);
    EXPECT_EQ(camera.nearMetres, 0.1);
    EXPECT_EQ(camera.farMetres, 100.0);
    EXPECT_EQ(scene.background, glm::vec3(0.0f));
    EXPECT_EQ(scene.options.requested.at("size"), OptionValue(std::vector<double>{1280, 720}));
}

} // namespace
} // namespace tessera::scenes::builtin
