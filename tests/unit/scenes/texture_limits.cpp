#include "scenes/TextureLimits.h"

#include <cmath>
#include <cstring>

#include "scenes/LoadLedger.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/TempFolder.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Grey columns of 16-bit code values, opaque.
Image wideImageOf(const std::vector<std::uint16_t>& codes) {
    Image image;
    image.name = "wide.png";
    image.format = TexelFormat::Rgba16Unorm;
    image.width = int(codes.size());
    image.height = 1;
    for (const std::uint16_t code : codes) {
        const std::uint16_t texel[4] = {code, code, code, 0xffff};
        const auto bytes = std::as_bytes(std::span(texel));
        image.texels.insert(image.texels.end(), bytes.begin(), bytes.end());
    }
    return image;
}

std::uint16_t wideCodeAt(const Image& image, int column) {
    std::uint16_t code = 0;
    std::memcpy(&code, image.texels.data() + std::size_t(column) * texelBytes(image.format), sizeof code);
    return code;
}

Scene sceneWith(TextureSlot slot) {
    Scene scene = tinyScene();
    std::vector<std::uint16_t> codes(2 * kMostTextureSide);
    for (std::size_t i = 0; i < codes.size(); i += 2) codes[i] = 0xffff;
    scene.images.push_back(wideImageOf(codes));
    scene.materials[0].texture(slot).image = 0;
    return scene;
}

TEST(TextureLimits, imagesWithMoreTexelsASideAreAveragedAndNamed) {
    LoadLedger ledger;
    Scene scene = sceneWith(TextureSlot::BaseColor);
    keepTextureLimits(scene, "a.gltf", ledger);
    const Image& image = scene.images[0];
    EXPECT_EQ(image.width, kMostTextureSide);
    EXPECT_EQ(image.height, 1);
    for (const int column : {0, 5000, kMostTextureSide - 1})
        EXPECT_NEAR(wideCodeAt(image, column), 0.735357 * 0xffff, 1) << "half of the light, as sRGB";
    EXPECT_THAT(
        scene.warnings,
        ElementsAre("a.gltf: the picture 'wide.png' has 32768x1 texels, and textures have at most 16384 a side; "
                    "its averages in 16384x1 texels are drawn"));
    LoadLedger strict({}, strictly());
    Scene refused = sceneWith(TextureSlot::BaseColor);
    EXPECT_THAT(inputErrorOf([&] { keepTextureLimits(refused, "a.gltf", strict); }), HasSubstr("at most 16384 a side"));
}

TEST(TextureLimits, numbersAreAveragedAsTheyAre) {
    LoadLedger ledger;
    Scene scene = sceneWith(TextureSlot::MetallicRoughness);
    keepTextureLimits(scene, "a.gltf", ledger);
    EXPECT_EQ(wideCodeAt(scene.images[0], 0), 0x8000);
}

TEST(TextureLimits, whatFitsOrIsNotDrawnStaysAsItIs) {
    LoadLedger ledger(1024);
    Scene scene = sceneWith(TextureSlot::BaseColor);
    scene.materials[0].texture(TextureSlot::BaseColor).image = kNone;
    scene.images.push_back(wideImageOf(std::vector<std::uint16_t>(kMostTextureSide, 7)));
    scene.materials[0].texture(TextureSlot::Normal).image = 1;
    keepTextureLimits(scene, "a.gltf", ledger);
    EXPECT_EQ(scene.images[0].width, 2 * kMostTextureSide);
    EXPECT_EQ(scene.images[1].texels, wideImageOf(std::vector<std::uint16_t>(kMostTextureSide, 7)).texels);
    EXPECT_THAT(scene.warnings, IsEmpty());
    Scene large = sceneWith(TextureSlot::BaseColor);
    EXPECT_THROW(keepTextureLimits(large, "a.gltf", ledger), MemoryRefused);
}

TEST(TextureLimits, placesInTexturesAreCountedByWholeNumbers) {
    LoadLedger ledger;
    Scene scene = sceneWith(TextureSlot::Normal);
    scene.images[0] = wideImageOf({1, 2, 3, 4});
    TextureUse& use = scene.materials[0].texture(TextureSlot::Normal);
    const TextureTransform huge{{0.5f, -2.6e38f}, {3e38f, -2.0f}, 0.0f};
    use.transform = huge;
    scene.meshes[0].texCoords[0] = {{0.0f, 3e38f}, {1e6f, 1.0f}, {1.0f, -3e38f}};
    keepTextureLimits(scene, "a.gltf", ledger);
    const auto most = float(kMostTextureNumber);
    EXPECT_THAT(scene.meshes[0].texCoords[0],
                ElementsAre(glm::vec2(0.0f, most), glm::vec2(1e6f, 1.0f), glm::vec2(1.0f, -most)));
    const double repeats =
        std::abs(double(use.transform.scale.x)) * 1e6 + std::abs(double(use.transform.scale.y)) * most;
    EXPECT_NEAR(repeats, double(1 << 8), 0.01);
    EXPECT_EQ(use.transform.offset, glm::vec2(0.5f, 0.0f)) << "an even number of repeats moves nothing";
    EXPECT_THAT(scene.warnings, ElementsAre("a.gltf: mesh 'triangle' has texture coordinates beyond 3.6e+16; drawn "
                                            "with fewer repeats (and 1 more)"));
    use.transform.offset.y = -2.6e38f;
    use.sampler.wrapV = Wrap::ClampToEdge;
    keepTextureLimits(scene, "a.gltf", ledger);
    EXPECT_EQ(use.transform.offset.y, -float(1 << 27));
    LoadLedger strict({}, strictly());
    use.transform = huge;
    EXPECT_THAT(inputErrorOf([&] { keepTextureLimits(scene, "a.gltf", strict); }), HasSubstr("past 2^30 texels"));
}

TEST(TextureLimits, placesThatCanBeCountedOrAreNotVisibleAreNotNamed) {
    LoadLedger strict({}, strictly());
    Scene scene = sceneWith(TextureSlot::Normal);
    scene.images[0] = wideImageOf({1, 2, 3, 4});
    TextureUse& use = scene.materials[0].texture(TextureSlot::Normal);
    const TextureTransform tiles{{1e9f, 0.0f}, {100.0f, 1e30f}, 1.0f};
    use.transform = tiles;
    scene.meshes[0].texCoords[0] = {{1e6f, 0.0f}, {0.0f, 0.0f}, {0.0f, 1e-30f}};
    keepTextureLimits(scene, "a.gltf", strict);
    EXPECT_EQ(use.transform, (TextureTransform{{0.0f, 0.0f}, tiles.scale, 1.0f}));
    scene.meshes[0].texCoords[0][0].x = 3e38f;
    scene.nodes[0].instances.clear();
    keepTextureLimits(scene, "a.gltf", strict);
    EXPECT_THAT(scene.warnings, IsEmpty());
}

} // namespace
} // namespace tessera::scenes
