#include "renderer/frame/TextureRoom.h"

#include <gmock/gmock.h>

namespace tessera::frame {
namespace {

using scenes::TextureSlot;

/// A frame with all features, and this number of textures per shader stage.
FrameSpec specOn(int texturesAStage) {
    FrameSpec spec;
    spec.features = allFeatures();
    spec.settings.texturesAStage = texturesAStage;
    return spec;
}

TEST(TextureRoom, nothingIsLeftOutWhereAStageSamplesAsManyAsDriversLetIt) {
    FrameSpec spec = specOn(TEXTURE_UNITS_A_STAGE);
    EXPECT_EQ(sampledTextures(spec), std::size_t(TEXTURE_SLOT_COUNT + 3 + 2 + 2 + 1))
        << "lights, the environment, lobes and the pictures of lights";
    leaveOutTextures(spec, allFeatures());
    EXPECT_EQ(spec.features, allFeatures());
    EXPECT_EQ(missingTextures(spec), "");
}

TEST(TextureRoom, texturesThatNoMaterialReadsAreLeftOutFirstAndNotMissed) {
    FeatureSet used;
    for (const Feature feature : {featureOf(TextureSlot::Iridescence), featureOf(TextureSlot::IridescenceThickness),
                                  featureOf(TextureSlot::SheenColor), Feature::Iridescence})
        used.add(feature);
    FrameSpec spec = specOn(TEXTURE_UNITS_GUARANTEED);
    leaveOutTextures(spec, used);
    EXPECT_EQ(sampledTextures(spec), std::size_t(TEXTURE_UNITS_GUARANTEED));
    EXPECT_TRUE(spec.features[TextureSlot::Iridescence]);
    EXPECT_TRUE(spec.features[TextureSlot::IridescenceThickness]);
    EXPECT_FALSE(spec.features[TextureSlot::SheenColor]) << "no material has a sheen";
    EXPECT_EQ(missingTextures(spec), "");
}

TEST(TextureRoom, thenTheLeastImportantOnesAreLeftOutAndNamed) {
    FrameSpec spec = specOn(TEXTURE_UNITS_A_STAGE - 8); // two fewer than it needs
    leaveOutTextures(spec, allFeatures());
    EXPECT_EQ(sampledTextures(spec), std::size_t(TEXTURE_UNITS_A_STAGE - 8));
    EXPECT_THAT(spec.withoutTextures,
                testing::ElementsAre(TextureSlot::IridescenceThickness, TextureSlot::Iridescence));
    EXPECT_EQ(missingTextures(spec),
              "a shader of this driver samples at most 24 textures, and the scene's materials and lights need more; "
              "left out, so that factors hold everywhere: iridescence texture, film-thickness texture");
    FrameSpec least = specOn(TEXTURE_UNITS_GUARANTEED);
    leaveOutTextures(least, allFeatures());
    EXPECT_EQ(sampledTextures(least), std::size_t(TEXTURE_UNITS_GUARANTEED));
    EXPECT_TRUE(least.features[TextureSlot::Anisotropy]);
    EXPECT_FALSE(least.features[TextureSlot::Clearcoat]);
}

TEST(TextureRoom, whatBodiesOfGlassShowIsLeftOutBeforeATextureThatAMaterialReads) {
    for (const int room : {TEXTURE_UNITS_A_STAGE, TEXTURE_UNITS_A_STAGE - 4}) {
        FrameSpec spec = specOn(room);
        spec.showsBehindGlass = spec.blursBehindGlass = spec.drawsFarSides = true;
        EXPECT_EQ(sampledTextures(spec), std::size_t(TEXTURE_SLOT_COUNT + 3 + 2 + 2 + 1 + 4));
        if (sampledTextures(spec) > std::size_t(room)) leaveOutTextures(spec, allFeatures());
        EXPECT_EQ(spec.showsBehindGlass, room == TEXTURE_UNITS_A_STAGE);
        EXPECT_EQ(spec.blursBehindGlass, room == TEXTURE_UNITS_A_STAGE);
        EXPECT_EQ(spec.drawsFarSides, room == TEXTURE_UNITS_A_STAGE);
        EXPECT_EQ(spec.features, allFeatures());
        EXPECT_EQ(missingTextures(spec),
                  room == TEXTURE_UNITS_A_STAGE
                      ? ""
                      : "a shader of this driver samples at most 28 textures, and the scene's materials and lights "
                        "need more; left out: the surfaces behind bodies of glass and rough sheets");
    }
}

TEST(TextureRoom, onlyTexturesOfLayersThatAMaterialHasTakeRoom) {
    FrameSpec spec;
    const std::size_t before = sampledTextures(spec);
    spec.features.add(featureOf(TextureSlot::Transmission));
    EXPECT_EQ(sampledTextures(spec), before);
    spec.features.add(Feature::Transmission);
    EXPECT_EQ(sampledTextures(spec), before + 1);
}

} // namespace
} // namespace tessera::frame
