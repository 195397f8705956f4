#include <algorithm>
#include <cstdio>

#include "GltfBuilder.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/UnderLedger.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Expects the invariants of a scene's meshes.
void expectSound(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t count = mesh.positionsOS.size();
        EXPECT_EQ(mesh.normalsOS.size(), count);
        EXPECT_TRUE(mesh.tangentsOS.empty() || mesh.tangentsOS.size() == count);
        EXPECT_TRUE(mesh.colors.empty() || mesh.colors.size() == count);
        EXPECT_EQ(mesh.indices.size() % 3, 0u);
        for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, count);
    }
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances)
            EXPECT_LT(std::size_t(instance.material), scene.materials.size());
    const int imageCount = int(scene.images.size());
    for (const Material& material : scene.materials)
        for (const TextureUse& use : material.textures) EXPECT_LT(use.image, imageCount);
}

/// Expects each model to import or to be refused with a reason. Prints refusals and empty models for review.
void sweep(const std::filesystem::path& folder) {
    std::size_t importedCount = 0;
    const std::vector<std::filesystem::path> models = tessera::test::modelsBelow(folder);
    for (const std::filesystem::path& model : models) {
        SCOPED_TRACE(model.string());
        const std::string name = std::filesystem::relative(model, folder).string();
        try {
            const Scene scene = underLedger(importGltf, model);
            expectSound(scene);
            ++importedCount;
            if (triangleCount(scene) == 0) {
                std::printf("%-60s draws nothing\n", name.c_str());
                for (const std::string& warning : scene.warnings) std::printf("%60s %s\n", "", warning.c_str());
            }
        } catch (const InputError& error) {
            EXPECT_STRNE(error.what(), "");
            std::printf("%-60s refused: %s\n", name.c_str(), error.what());
        } catch (const std::exception& error) {
            ADD_FAILURE() << "neither imported nor refused as input: " << error.what();
        }
    }
    std::printf("%zu of %zu models imported\n", importedCount, models.size());
    EXPECT_GT(importedCount, 0u);
}

TEST(GltfSweep, everyPackagedModelIsImportedOrRefused) {
    const std::filesystem::path folder = "/usr/share/assimp/models"; // Debian's assimp-testmodels
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    sweep(folder);
}

TEST(GltfSweep, everyModelOfTheAssetsFolderOrTheRepositoryIsImportedOrRefused) {
    sweep(tessera::test::sweptFolder());
}

} // namespace
} // namespace tessera::scenes::gltf::test
