// What holds for every built-in scene.
#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/Limits.h"
#include "scenes/builtin/Builtin.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/MeshRules.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {

/// How GoogleTest shows a scene in a test's name.
void PrintTo(const BuiltinScene& scene, std::ostream* out) {
    *out << scene.name;
}

namespace {

using test::withoutAssets;

/// FNV-1a (Fowler, Noll, Vo) over everything a renderer reads.
class Digest {
public:
    template <typename T>
    void add(const std::vector<T>& values) {
        for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) {
            hash_ = (hash_ ^ reinterpret_cast<const unsigned char*>(values.data())[i]) * 1099511628211u;
        }
    }
    template <typename T>
    void add(const T& value) {
        add(std::vector<T>{value});
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

std::uint64_t digest(const Scene& scene) {
    Digest digest;
    for (const Image& image : scene.images) digest.add(image.texels);
    for (const Mesh& mesh : scene.meshes) {
        digest.add(mesh.positionsOS);
        digest.add(mesh.normalsOS);
        digest.add(mesh.texCoords[0]);
        digest.add(mesh.indices);
    }
    for (const Node& node : scene.nodes) {
        digest.add(node.parentFromNode);
        for (const MeshInstance& instance : node.instances) digest.add(glm::ivec2(instance.mesh, instance.material));
    }
    for (const Material& material : scene.materials) {
        digest.add(material.baseColor);
        digest.add(material.emissive);
        digest.add(glm::vec4(material.metallic, material.perceptualRoughness, material.alpha, material.ior));
        digest.add(glm::vec4(material.alphaY, material.exponent, material.anisotropyStrength, material.clearcoat));
        digest.add(material.sheenColor);
        digest.add(glm::vec4(material.attenuationColor, material.transmission));
        digest.add(glm::vec2(material.thicknessMetres, material.attenuationDistanceMetres));
    }
    for (const Light& light : scene.lights) {
        digest.add(light.positionWS);
        digest.add(light.directionWS);
        digest.add(glm::vec4(light.color, light.intensity));
        digest.add(light.rangeMetres);
        digest.add(light.alongWS);
        digest.add(glm::vec4(light.widthMetres, light.heightMetres, light.lengthMetres, light.radiusMetres));
    }
    for (const Camera& camera : scene.cameras) digest.add(camera.worldFromCamera);
    return digest.value();
}

void expectCamerasWithinReach(const Scene& scene) {
    const Box3 boundsWS = worldBounds(scene);
    const double radiusMetres = 0.5 * glm::length(boundsWS.max - boundsWS.min);
    for (const Camera& camera : scene.cameras) {
        const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
        EXPECT_LT(glm::distance(eyeWS, 0.5 * (boundsWS.min + boundsWS.max)), 1.5 * radiusMetres) << camera.name;
        EXPECT_GT(eyeWS.y, boundsWS.min.y) << camera.name;
    }
}

/// Everything stored is used by an instance, and textured meshes have the coordinates for it.
void expectAllUsed(const Scene& scene) {
    std::vector<bool> meshUsed(scene.meshes.size());
    std::vector<bool> materialUsed(scene.materials.size());
    std::vector<bool> imageUsed(scene.images.size());
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            meshUsed[static_cast<std::size_t>(instance.mesh)] = true;
            materialUsed[static_cast<std::size_t>(instance.material)] = true;
            for (const TextureUse& use : scene.materials[static_cast<std::size_t>(instance.material)].textures) {
                if (use.image == kNone) continue;
                imageUsed[static_cast<std::size_t>(use.image)] = true;
                EXPECT_EQ(mesh.texCoords[static_cast<std::size_t>(use.texCoordSet)].size(), mesh.positionsOS.size())
                    << mesh.name;
            }
        }
    }
    for (std::size_t i = 0; i < meshUsed.size(); ++i) EXPECT_TRUE(meshUsed[i]) << scene.meshes[i].name;
    for (std::size_t i = 0; i < materialUsed.size(); ++i) EXPECT_TRUE(materialUsed[i]) << scene.materials[i].name;
    for (std::size_t i = 0; i < imageUsed.size(); ++i) EXPECT_TRUE(imageUsed[i]) << scene.images[i].name;
}

class BuiltinScenes : public testing::TestWithParam<BuiltinScene> {
protected:
    void expectSound();
    void expectTheSameTwice();
    void expectChargedBefore();
};
/// Of all scenes; the other suite is without those whose pictures take seconds to make.
class BuiltinScenesSlow : public BuiltinScenes {};

void BuiltinScenes::expectSound() {
    const Scene scene = underLedger(GetParam().make, withoutAssets());
    EXPECT_NO_THROW(checkScene(scene));
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_TRUE(scene.warnings.empty());
    expectCamerasWithinReach(scene);
    expectAllUsed(scene);
    for (const Mesh& mesh : scene.meshes) expectMeshRules(mesh);
}
TEST_P(BuiltinScenes, areAlwaysSoundAndFaceTheirNormals) {
    expectSound();
}
TEST_P(BuiltinScenesSlow, areAlwaysSoundAndFaceTheirNormals) {
    expectSound();
}

void BuiltinScenes::expectTheSameTwice() {
    EXPECT_EQ(digest(underLedger(GetParam().make, withoutAssets())),
              digest(underLedger(GetParam().make, withoutAssets())));
}
TEST_P(BuiltinScenes, areAlwaysTheSameTwice) {
    expectTheSameTwice();
}
TEST_P(BuiltinScenesSlow, areAlwaysTheSameTwice) {
    expectTheSameTwice();
}

void BuiltinScenes::expectChargedBefore() {
    const BuiltinScene& builtin = GetParam();
    const std::uint64_t held = bytesOf(underLedger(builtin.make, withoutAssets()));
    EXPECT_LE(held, builtin.bytes) << sizeText(held);
    EXPECT_LE(builtin.bytes, std::max(std::uint64_t{1} << 20, 8 * held)) << sizeText(held) << ": refuses for nothing";
    LoadOptions options = withoutAssets();
    options.memoryLimitBytes = builtin.bytes - 1;
    EXPECT_EQ(
        test::inputErrorOf([&] { loadScene(std::string(builtin.name), options); }),
        fmt::format("{}: asks for {} of memory, and 0 B are in use; a load may take {}; use a smaller file, or raise "
                    "the memory limit",
                    builtin.name, sizeText(builtin.bytes), sizeText(builtin.bytes - 1)));
}
TEST_P(BuiltinScenes, areAlwaysChargedBeforeTheyAreMadeAndForNoLessThanTheyTake) {
    expectChargedBefore();
}
TEST_P(BuiltinScenesSlow, areAlwaysChargedBeforeTheyAreMadeAndForNoLessThanTheyTake) {
    expectChargedBefore();
}

TEST(BuiltinMemory, lightsThatABuiltinSceneIsAskedForAreChargedBeforeTheyAreMade) {
    LoadOptions options;
    options.lights = kMostLights;
    options.memoryLimitBytes = builtinScene("lattice")->bytes + 1000;
    EXPECT_THAT(test::inputErrorOf([&] { loadScene("lattice", options); }), testing::StartsWith("lattice: asks for "));
}

std::string nameOf(const testing::TestParamInfo<BuiltinScene>& scene) {
    return std::string(scene.param.name);
}
std::vector<BuiltinScene> madeWithinASecond() {
    std::vector<BuiltinScene> made;
    for (const BuiltinScene& builtin : builtinScenes())
        if (builtin.name != "head_skin" && builtin.name != "head_marble") made.push_back(builtin);
    return made;
}
INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes, testing::ValuesIn(madeWithinASecond()), nameOf);
INSTANTIATE_TEST_SUITE_P(All, BuiltinScenesSlow, testing::ValuesIn(builtinScenes().begin(), builtinScenes().end()),
                         nameOf);

} // namespace
} // namespace tessera::scenes
