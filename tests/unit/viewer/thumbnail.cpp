// Small copies of images, and their rows in the panel of materials.
#include "viewer/edit/Thumbnail.h"

#include <cstring>

#include <gmock/gmock.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"

namespace tessera::viewer {
namespace {

/// An image of 8 x 4 texels, black at the left and white at the right, in a format of any number type.
template <typename Component>
scenes::Image halves(scenes::TexelFormat format, Component white) {
    scenes::Image image{"pictures/halves.png", format, 8, 4, {}};
    std::vector<Component> texels;
    for (int texel = 0; texel < 8 * 4; ++texel)
        for (int channel = 0; channel < 4; ++channel) texels.push_back(texel % 8 < 4 ? Component(0) : white);
    image.texels.resize(texels.size() * sizeof(Component));
    std::memcpy(image.texels.data(), texels.data(), image.texels.size());
    return image;
}

TEST(Thumbnail, isASmallCopyOfTheSameShapeInEveryFormat) {
    for (const scenes::Image& image : {halves<std::uint8_t>(scenes::TexelFormat::Rgba8Unorm, 255),
                                       halves<std::uint16_t>(scenes::TexelFormat::Rgba16Unorm, 65535),
                                       halves<float>(scenes::TexelFormat::Rgba32Float, 7.0f)}) {
        const Thumbnail small = thumbnailOf(image, 4);
        ASSERT_EQ(small.sizePixels, glm::ivec2(4, 2));
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x) EXPECT_EQ(int(small.pixels.at(std::size_t(4 * y + x)).x), x < 2 ? 0 : 255);
        EXPECT_EQ(int(thumbnailOf(image, 1).pixels.at(0).x), 128) << "the mean of both halves";
        EXPECT_EQ(thumbnailOf(image, 100).sizePixels, glm::ivec2(8, 4)) << "it is not enlarged";
    }
    EXPECT_TRUE(thumbnailOf({}, 4).pixels.empty());
}

constexpr float kThumbnailX = 190.0f; ///< in a panel of PanelTest

class TextureRows : public test::PanelTest {};

TEST_F(TextureRows, nameEveryTextureOfTheMaterialAndItsSize) {
    scenes::Scene scene = scenes::loadScene("room", {});
    scene.images.push_back(halves<std::uint8_t>(scenes::TexelFormat::Rgba8Unorm, 255));
    scene.materials.at(0).texture(scenes::TextureSlot::BaseColor).image = int(scene.images.size()) - 1;
    State state = test::stateOf(std::move(scene));
    state.selectedMaterial = 0;
    const auto text = [&] { return textOf([&] { materialsPanel(state); }); };
    for (const char* word : {"base color", "halves.png", "8 x 4"}) EXPECT_THAT(text(), testing::HasSubstr(word));
    // The thumbnail is the lowest item that a click changes.
    for (float y = 2000.0f; state.resource.name.empty() && y > 0.0f; y -= 10.0f)
        clickPanel({kThumbnailX, y}, [&] { materialsPanel(state); });
    EXPECT_EQ(state.resource.name, "pictures/halves.png");
    ASSERT_TRUE(state.resource.image);
    EXPECT_EQ(state.resource.image->text(), "pictures/halves.png: RGBA8 8 x 4");
    EXPECT_EQ(state.resource.image->texelText({7, 3}), "(7, 3): 1 1 1 1");
    state.selectedMaterial = 1;
    EXPECT_THAT(text(), testing::Not(testing::HasSubstr("halves.png")));
}

} // namespace
} // namespace tessera::viewer
