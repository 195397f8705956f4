// Rules of every built-in scene.
#include <algorithm>
#include <ostream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scenes/Fingerprint.h"
#include "scenes/Limits.h"
#include "scenes/builtin/Builtin.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/MeshRules.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {

/// Prints a scene in the names of tests (GoogleTest).
void PrintTo(const BuiltinScene& scene, std::ostream* out) {
    *out << scene.name;
}

namespace {

using test::withoutAssets;

void expectCamerasWithinReach(const Scene& scene) {
    const Box3 boundsWS = worldBounds(scene);
    const double radiusMetres = 0.5 * glm::length(boundsWS.max - boundsWS.min);
    for (const Camera& camera : scene.cameras) {
        const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
        EXPECT_LT(glm::distance(eyeWS, 0.5 * (boundsWS.min + boundsWS.max)), 1.5 * radiusMetres) << camera.name;
        EXPECT_GT(eyeWS.y, boundsWS.min.y) << camera.name;
    }
}

/// Expects an instance to use each mesh, material and image, and textured meshes to have texture coordinates.
void expectAllUsed(const Scene& scene) {
    std::vector<bool> meshUsed(scene.meshes.size());
    std::vector<bool> materialUsed(scene.materials.size());
    std::vector<bool> imageUsed(scene.images.size());
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            meshUsed[std::size_t(instance.mesh)] = true;
            materialUsed[std::size_t(instance.material)] = true;
            for (const TextureUse& use : scene.materials[std::size_t(instance.material)].textures) {
                if (use.image == kNone) continue;
                imageUsed[std::size_t(use.image)] = true;
                EXPECT_EQ(mesh.texCoords[std::size_t(use.texCoordSet)].size(), mesh.positionsOS.size()) << mesh.name;
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
/// Tests all scenes; the other suite omits scenes whose images take seconds to make.
class BuiltinScenesSlow : public BuiltinScenes {};

void BuiltinScenes::expectSound() {
    const Scene scene = underLedger(GetParam().make, withoutAssets());
    EXPECT_NO_THROW(checkScene(scene));
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_EQ(triangleCount(scene), GetParam().triangles);
    EXPECT_EQ(scene.lights.size(), GetParam().lights);
    EXPECT_EQ(scene.materials.size(), GetParam().materials);
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
    EXPECT_EQ(fingerprint(underLedger(GetParam().make, withoutAssets())),
              fingerprint(underLedger(GetParam().make, withoutAssets())));
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
        fmt::format("{}: needs {} of memory, and 0 B are in use; a load may take {}; use a smaller file, or raise "
                    "the memory limit",
                    builtin.name, sizeText(builtin.bytes), sizeText(builtin.bytes - 1)));
}
TEST_P(BuiltinScenes, areAlwaysChargedBeforeTheyAreMadeAndForNoLessThanTheyTake) {
    expectChargedBefore();
}
TEST_P(BuiltinScenesSlow, areAlwaysChargedBeforeTheyAreMadeAndForNoLessThanTheyTake) {
    expectChargedBefore();
}

TEST(BuiltinMemory, lightsThatABuiltinSceneIsRequestedAreChargedBeforeTheyAreMade) {
    LoadOptions options = loading(&LoadOptions::lights, kMostLights);
    options.memoryLimitBytes = builtinScene("lattice")->bytes + 1000;
    EXPECT_THAT(test::inputErrorOf([&] { loadScene("lattice", options); }), testing::StartsWith("lattice: needs "));
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
