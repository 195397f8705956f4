// Resources of the render graph as numbers, colours and words, and their window over the image.
#include "viewer/session/ResourceView.h"

#include <bit>
#include <limits>

#include <gmock/gmock.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/ResourceBox.h"

namespace tessera::viewer {
namespace {

using Channels = ResourceView::Channels;

std::uint32_t bits(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

/// A texture of one row.
ResourceContents rowOf(graph::Format format, std::vector<glm::uvec4> texels) {
    ResourceContents contents;
    contents.name = "row";
    contents.desc = graph::TextureDesc{format, int(texels.size()), 1};
    contents.sizeTexels = {int(texels.size()), 1};
    contents.texels = std::move(texels);
    return contents;
}

TEST(ResourceView, numbersAreThoseOfTheFormat) {
    const ResourceContents floats = rowOf(graph::Format::Rg32Float, {{bits(0.25f), bits(-3.0f), 0, bits(1.0f)}});
    EXPECT_EQ(floats.texelText({0, 0}), "(0, 0): 0.25 -3");
    const ResourceContents whole = rowOf(graph::Format::R32Uint, {{7, 0, 0, 1}, {4000000000u, 0, 0, 1}});
    EXPECT_EQ(whole.texelText({1, 0}), "(1, 0): 4000000000");
    EXPECT_EQ(whole.text(), "row: R32UI 2 x 1");
    EXPECT_EQ(ResourceContents::wordText(bits(0.5f), ResourceView::Words::Float), "0.5");
    EXPECT_EQ(ResourceContents::wordText(255, ResourceView::Words::Hexadecimal), "000000ff");
    EXPECT_EQ(ResourceContents::wordText(255, ResourceView::Words::Unsigned), "255");
}

TEST(ResourceView, wordsThatAreFloatsOfUsualMagnitudesAreShownAsSuch) {
    ResourceContents positions, indices;
    for (std::uint32_t i = 0; i < 30; ++i) {
        positions.words.push_back(i % 3 == 0 ? 0u : bits(0.1f * float(i)));
        indices.words.push_back(i);
    }
    EXPECT_EQ(positions.likelyWords(), ResourceView::Words::Float);
    EXPECT_EQ(indices.likelyWords(), ResourceView::Words::Unsigned);
    EXPECT_EQ(ResourceContents().likelyWords(), ResourceView::Words::Unsigned);
}

TEST(ResourceView, colorsSpanTheRangeOfTheShownChannel) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ResourceContents contents =
        rowOf(graph::Format::Rgba32Float, {{bits(-1.0f), bits(10.0f), bits(0.0f), bits(9.0f)},
                                           {bits(1.0f), bits(20.0f), bits(0.0f), bits(9.0f)},
                                           {bits(3.0f), bits(nan), bits(0.0f), bits(9.0f)}});
    const NumberRange red = rangeOf(contents, Channels::Red);
    EXPECT_EQ(red.least, -1.0);
    EXPECT_EQ(red.most, 3.0);
    const auto greys = colorsOf(contents, Channels::Red, red, false);
    EXPECT_EQ(greys[0], glm::u8vec4(0, 0, 0, 255));
    EXPECT_EQ(greys[1], glm::u8vec4(128, 128, 128, 255));
    EXPECT_EQ(greys[2], glm::u8vec4(255, 255, 255, 255));
    EXPECT_EQ(int(colorsOf(contents, Channels::Red, red, true)[1].x), 188) << "half of the light";
    EXPECT_EQ(colorsOf(contents, Channels::Green, rangeOf(contents, Channels::Green), false)[2],
              glm::u8vec4(255, 0, 255, 255))
        << "no number";
    EXPECT_EQ(rangeOf(contents, Channels::All).most, 20.0) << "alpha is no colour";
    EXPECT_EQ(rangeOf(rowOf(graph::Format::R32Float, {{bits(nan), 0, 0, 0}}), Channels::All).most, 1.0);
}

TEST(ResourceView, theRangeOfDepthsIsOfWhatIsDrawn) {
    const ResourceContents depths =
        rowOf(graph::Format::Depth32Float, {{bits(0.0f), 0, 0, 0}, {bits(0.25f), 0, 0, 0}, {bits(0.5f), 0, 0, 0}});
    EXPECT_EQ(rangeOf(depths, Channels::All).least, 0.25);
    EXPECT_EQ(rangeOf(depths, Channels::All).most, 0.5);
}

class ResourceBox : public test::PanelTest {
protected:
    std::string shown(State& state, const ResourceContents& contents) {
        Facts facts;
        facts.resource = Facts::Resource{};
        facts.resource->contents = std::make_shared<ResourceContents>(contents);
        std::string text;
        for (int i = 0; i < 3; ++i) frame([&] { text = logged([&] { drawResource(state, facts, area(state)); }); });
        return text;
    }
};

TEST_F(ResourceBox, showsABuffersWordsAndWhyATextureIsMissing) {
    State state = test::unusualScene();
    state.resource.name = "light list";
    ResourceContents list;
    list.name = "light list";
    list.desc = graph::BufferDesc{24};
    list.bytes = 24;
    list.words = {11, 12, 13, 14, 15, 4000000000u};
    EXPECT_EQ(list.likelyWords(), ResourceView::Words::Unsigned);
    EXPECT_THAT(shown(state, list), testing::HasSubstr("24 B"));
    list.fault = "not used";
    EXPECT_THAT(shown(state, list), testing::HasSubstr("not used"));
    list.name = "another";
    EXPECT_THAT(shown(state, list), testing::HasSubstr("as soon as the image is idle"))
        << "what was read is of another one";
}

TEST_F(ResourceBox, aTextureHasRowsForItsLevelsLayersAndChannels) {
    State state = test::unusualScene();
    state.resource.name = "row";
    ResourceContents cube = rowOf(graph::Format::Rgba16Float, {{bits(1.0f), 0, 0, 0}});
    cube.desc = graph::TextureDesc{graph::Format::Rgba16Float, 1, 1, 1, 4, 6, graph::Shape::Cube};
    const std::string text = shown(state, cube);
    for (const char* label : {"RGBA16F", "Level", "Layer", "Channels", "Range", "Curve"})
        EXPECT_THAT(text, testing::HasSubstr(label));
    const std::string flat = shown(state, rowOf(graph::Format::Depth32Float, {{bits(1.0f), 0, 0, 0}}));
    EXPECT_THAT(flat, testing::Not(testing::HasSubstr("Layer")));
    EXPECT_THAT(flat, testing::Not(testing::HasSubstr("Channels")));
}

} // namespace
} // namespace tessera::viewer
