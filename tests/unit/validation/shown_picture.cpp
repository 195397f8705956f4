// Legends of the views of shadow maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shaders/shared/face_colors.h"
#include "validation/pictures/ShownPicture.h"

namespace tessera::validation {
namespace {

using frame::DebugView;

std::vector<std::string> meanings(DebugView view, const engine::DrawnShadows& shadows) {
    std::vector<std::string> result;
    for (const Swatch& swatch : shadowSwatches(view, shadows)) result.push_back(swatch.meaning);
    return result;
}

/// Shadows of one light.
engine::DrawnShadows shadowsOf(int faces, int sideTexels) {
    engine::DrawnShadows shadows;
    shadows.hasMaps = faces > 0;
    shadows.lights = {{7, faces, 512, sideTexels}};
    shadows.shown = 0;
    return shadows;
}

TEST(ShadowLegend, namesEachMapOfTheLightOrWhyThereIsNone) {
    using testing::ElementsAre;
    EXPECT_THAT(meanings(DebugView::Cascades, shadowsOf(6, 512)),
                ElementsAre("+x", "-x", "+y", "-y", "+z", "-z", "no map"));
    EXPECT_THAT(meanings(DebugView::Cascades, shadowsOf(3, 512)),
                ElementsAre("cascade 1 (nearest)", "cascade 2", "cascade 3", "no map"));
    EXPECT_THAT(meanings(DebugView::Cascades, shadowsOf(1, 512)), ElementsAre("only map", "no map"));
    EXPECT_THAT(meanings(DebugView::Cascades, shadowsOf(6, 0)), ElementsAre("the budget has no room for its maps"));
    EXPECT_THAT(meanings(DebugView::Cascades, shadowsOf(0, 0)), ElementsAre("no maps: shadows are traced"));
    EXPECT_THAT(meanings(DebugView::Cascades, {}), ElementsAre("no light in view casts shadows"));
    engine::DrawnShadows other = shadowsOf(6, 512);
    other.shown.reset();
    EXPECT_THAT(meanings(DebugView::Cascades, other), ElementsAre("the light that is shown casts no shadows"));
    EXPECT_THAT(meanings(DebugView::Shadow, shadowsOf(6, 512)), ElementsAre());
}

TEST(ShadowLegend, ofAnAtlasNamesWhatTheLightsInItHave) {
    using testing::ElementsAre;
    engine::DrawnShadows shadows = shadowsOf(6, 512);
    EXPECT_THAT(meanings(DebugView::ShadowAtlas, shadows), ElementsAre("+x", "-x", "+y", "-y", "+z", "-z"));
    shadows.lights.push_back({8, 2, 512, 512});
    EXPECT_THAT(meanings(DebugView::ShadowAtlas, shadows),
                ElementsAre("+x or cascade 1 (nearest)", "-x or cascade 2", "+y", "-y", "+z", "-z"));
    shadows.lights.front().sideTexels = 0;
    EXPECT_THAT(meanings(DebugView::ShadowAtlas, shadows), ElementsAre("cascade 1 (nearest)", "cascade 2"));
    shadows.lights.back().faces = 1;
    EXPECT_THAT(meanings(DebugView::ShadowAtlas, shadows), ElementsAre("only map"));
    EXPECT_THAT(meanings(DebugView::ShadowAtlas, shadowsOf(0, 0)), ElementsAre());
}

TEST(ShadowLegend, hasTheColoursOfThePictures) {
    const std::vector<Swatch> swatches = shadowSwatches(DebugView::Cascades, shadowsOf(6, 512));
    ASSERT_EQ(swatches.size(), 7u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(swatches[std::size_t(i)].colour, codeColour(shared::faceColor(i)));
    EXPECT_EQ(swatches[6].colour, codeColour(shared::noFaceColor()));
}

} // namespace
} // namespace tessera::validation
