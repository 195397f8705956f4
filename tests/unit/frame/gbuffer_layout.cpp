#include "renderer/frame/GBufferLayout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>

#include "renderer/frame/MaterialFeatures.h"
#include "tests/support/GBufferBounds.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::frame {
namespace {

using scenes::MaterialModel;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::StartsWith;

FeatureSet featuresOf(
    MaterialModel model, const std::function<void(scenes::Material&)>& change = [](scenes::Material&) {}) {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials[0].model = model;
    change(scene.materials[0]);
    return materialFeatures(scene);
}

/// Adds material values that vary over surfaces, which pixels must store.
FeatureSet varying(FeatureSet features) {
    features.add(Feature::VaryingMaterials);
    return features;
}

const GBufferLayout& namedLayout(std::string_view name) {
    for (const LayoutInfo& info : layoutTable())
        if (info.name == name) return info.layout;
    throw std::runtime_error("no such layout");
}

TEST(GBufferLayout, theExactLayoutIsTheFirstAndFp32) {
    EXPECT_EQ(layoutTable()[0].name, "exact");
    for (const ChannelInfo& info : channelTable())
        EXPECT_EQ(gbufferTextures(namedLayout("exact"), std::array{Channel::Albedo, info.channel}).back(),
                  (GBufferTexture{std::string(info.name), graph::Format::Rgba32Float}));
}

TEST(GBufferLayout, alphaAndMetallicFillSpareComponentsWhereNothingElseIsStoredOfTheMicrosurface) {
    const GBufferLayout& exact = namedLayout("exact");
    const FeatureSet plain = varying(featuresOf(MaterialModel::MetallicRoughness));
    const std::vector<Channel> channels = neededChannels(plain, exact, false);
    EXPECT_THAT(channels, ElementsAre(Channel::Albedo, Channel::Normal));
    EXPECT_EQ(channelDefines(exact, channels).back(),
              std::make_pair(std::string("GBUFFER_SPARE_COMPONENTS"), std::string("1")));
    const FeatureSet tinted = featuresOf(MaterialModel::MetallicRoughness, [](scenes::Material& m) { m.ior = 1.4f; });
    for (const FeatureSet& features : {varying(tinted), varying(featuresOf(MaterialModel::Microfacet)), allFeatures()})
        EXPECT_THAT(neededChannels(features, exact, false), testing::Contains(Channel::Microsurface));
    GBufferLayout mixed = exact;
    mixed.encoding[std::size_t(Channel::Normal)] = Encoding::Packed;
    EXPECT_THAT(neededChannels(plain, mixed, false), testing::Contains(Channel::Microsurface));
}

TEST(GBufferLayout, pixelsHoldTheNumberOfTheirMaterialWhereNoneVariesAndNothingOfItIsPacked) {
    const GBufferLayout& exact = namedLayout("exact");
    const auto coated = [](scenes::Material& m) {
        m.clearcoat = 0.5f;
        m.sheenColor.g = 0.5f;
        m.emissive.r = 1.0f;
        m.ior = 1.4f;
    };
    const FeatureSet features = featuresOf(MaterialModel::MetallicRoughness, coated);
    const std::vector<Channel> channels = neededChannels(features, exact, false);
    EXPECT_THAT(channels, ElementsAre(Channel::Normal, Channel::Clearcoat));
    EXPECT_TRUE(holdMaterialNumber(exact, channels));
    EXPECT_EQ(channelDefines(exact, channels).back(),
              std::make_pair(std::string("GBUFFER_MATERIAL_NUMBER"), std::string("1")));
    // The normal's code and the number in two words, the coat in fp32.
    EXPECT_EQ(gbufferTextures(exact, channels), (std::vector<GBufferTexture>{{"clearcoat", graph::Format::Rgba32Float},
                                                                             {"words", graph::Format::Rg32Uint}}));
    EXPECT_EQ(bytesPerPixel(exact, channels), 24);
    EXPECT_THAT(channelDefines(exact, channels),
                testing::Contains(std::make_pair(std::string("GBUFFER_NORMAL_WIDTHS"), std::string("25, 25, 3, 11"))));

    EXPECT_FALSE(holdMaterialNumber(exact, neededChannels(varying(features), exact, false)));
    EXPECT_FALSE(holdMaterialNumber(exact, neededChannels(featuresOf(MaterialModel::SingleColor), exact, false)));
    for (const Channel packed : {Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Specular,
                                 Channel::Emission, Channel::Sheen}) {
        // A channel of another encoding must give that encoding's image, whatever the other channels.
        GBufferLayout mixed = exact;
        mixed.encoding[std::size_t(packed)] = Encoding::Packed;
        EXPECT_FALSE(holdMaterialNumber(mixed, neededChannels(features, mixed, false))) << int(packed);
    }
}

void giveIor(scenes::Material& m) {
    m.ior = 1.4f;
}
void giveEmission(scenes::Material& m) {
    m.emissive.r = 1.0f;
}
void giveAnisotropy(scenes::Material& m) {
    m.anisotropyStrength = 0.5f;
}
void giveCoat(scenes::Material& m) {
    m.clearcoat = 0.5f;
}
void giveSheen(scenes::Material& m) {
    m.sheenColor.g = 0.5f;
}

TEST(GBufferLayout, channelsAreAllocatedExactlyWhenASurfaceNeedsThem) {
    using enum MaterialModel;
    const auto channels = [](const FeatureSet& features, bool normalTexel = false) {
        return neededChannels(features, namedLayout("packed"), normalTexel);
    };
    EXPECT_THAT(channels(featuresOf(SingleColor)), ElementsAre(Channel::Emission));
    EXPECT_THAT(channels(featuresOf(Lambert)), ElementsAre(Channel::Albedo, Channel::Normal));
    EXPECT_THAT(channels(featuresOf(Lambert, giveEmission)),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Emission));
    EXPECT_THAT(channels(featuresOf(Lambert), true),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::NormalTexel));
    EXPECT_THAT(channels(featuresOf(BlinnPhong)), ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
    EXPECT_THAT(channels(featuresOf(Microfacet)), ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
    const std::pair<FeatureSet, Channel> kFourth[] = {{featuresOf(MicrofacetAnisotropic), Channel::Tangent},
                                                      {featuresOf(MetallicRoughness, giveIor), Channel::Specular},
                                                      {featuresOf(MetallicRoughness, giveAnisotropy), Channel::Tangent},
                                                      {featuresOf(MetallicRoughness, giveCoat), Channel::Clearcoat},
                                                      {featuresOf(MetallicRoughness, giveSheen), Channel::Sheen}};
    for (const auto& [features, channel] : kFourth)
        EXPECT_THAT(channels(features), ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, channel))
            << int(channel);
    EXPECT_EQ(channels(allFeatures()).size(), kChannelCount - 1);

    FeatureSet mixed = featuresOf(Lambert); // with unlit surfaces: a pixel must store its model
    mixed.add(featureOf(SingleColor));
    mixed.soleModel.reset();
    EXPECT_THAT(channels(mixed), ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
}

TEST(GBufferLayout, aFrameNeverNeedsMoreTexturesThanOpenGlDrawsIntoAtOnce) {
    constexpr std::size_t kDrawBuffers = 8; // the least GL_MAX_DRAW_BUFFERS of OpenGL 4.5
    for (const LayoutInfo& info : layoutTable()) {
        for (const bool normalTexel : {false, true})
            EXPECT_LE(gbufferTextures(info.layout, neededChannels(allFeatures(), info.layout, normalTexel)).size(),
                      kDrawBuffers)
                << info.name;
    }
}

struct Bytes {
    int exact;
    int packed;
    int slim;
    bool operator==(const Bytes&) const = default;
};
Bytes bytesOf(const FeatureSet& features) {
    const auto bytes = [&](const char* name) {
        const GBufferLayout& layout = namedLayout(name);
        return bytesPerPixel(layout, neededChannels(varying(features), layout, false));
    };
    return {bytes("exact"), bytes("packed"), bytes("slim")};
}
FeatureSet allIsotropicFeatures() {
    FeatureSet all = allFeatures();
    for (const Feature layer :
         {featureOf(MaterialModel::MicrofacetAnisotropic), Feature::Anisotropy, Feature::Clearcoat, Feature::Sheen})
        all.has.reset(std::size_t(layer));
    return all;
}

TEST(GBufferLayout, everyFeatureSetTakesExactlyItsBytes) {
    using enum MaterialModel;
    EXPECT_EQ(bytesOf(featuresOf(SingleColor)), (Bytes{16, 4, 4}));
    EXPECT_EQ(bytesOf(featuresOf(Lambert)), (Bytes{32, 8, 8}));
    EXPECT_EQ(bytesOf(featuresOf(BlinnPhong)), (Bytes{48, 12, 8}));
    EXPECT_EQ(bytesOf(featuresOf(Microfacet)), (Bytes{48, 12, 8}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness)), (Bytes{32, 12, 8}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness, giveIor)), (Bytes{64, 16, 12}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness, giveEmission)), (Bytes{48, 16, 12}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness, giveAnisotropy)), (Bytes{48, 16, 12}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness, giveCoat)), (Bytes{48, 20, 16}));
    EXPECT_EQ(bytesOf(featuresOf(MetallicRoughness, giveSheen)), (Bytes{48, 16, 12}));
    EXPECT_EQ(bytesOf(allIsotropicFeatures()), (Bytes{80, 16, 12})) << "a subset of them needs no more channels";
    EXPECT_EQ(bytesOf(allFeatures()), (Bytes{128, 32, 24}));
}

TEST(GBufferLayout, wordsLieFourTwoAndOneInATextureBehindTheExactChannels) {
    GBufferLayout layout = namedLayout("packed");
    layout.encoding[std::size_t(Channel::Normal)] = Encoding::Exact;
    using graph::Format;
    EXPECT_EQ(gbufferTextures(layout, neededChannels(allFeatures(), layout, false)),
              (std::vector<GBufferTexture>{{"normal", Format::Rgba32Float},
                                           {"words", Format::Rgba32Uint},
                                           {"words 4 to 5", Format::Rg32Uint},
                                           {"words 6", Format::R32Uint}}));
}

TEST(GBufferLayout, aMixedLayoutIsHeldToThePromiseOfItsCoarsestChannel) {
    GBufferLayout layout = namedLayout("exact");
    EXPECT_EQ(promiseOf(layout), LayoutPromise());
    layout.encoding[0] = Encoding::Packed;
    EXPECT_EQ(promiseOf(layout), layoutTable()[1].promise);
    layout.encoding[1] = Encoding::Slim;
    EXPECT_EQ(promiseOf(layout), layoutTable()[2].promise);
}

TEST(GBufferLayout, promisesFollowFromTheStepsOfTheirFields) {
    for (const Encoding encoding : {Encoding::Packed, Encoding::Slim}) {
        const std::vector<FieldBound> bounds = fieldBounds(encoding);
        const auto stepOf = [&](Channel channel, std::string_view quantity) {
            const auto found = std::find_if(bounds.begin(), bounds.end(), [&](const FieldBound& bound) {
                return bound.channel == channel && bound.quantity == quantity;
            });
            return found->bound;
        };
        const LayoutPromise& promise = layoutTable()[std::size_t(encoding)].promise;
        EXPECT_DOUBLE_EQ(promise.p999Rel, 2.0 * stepOf(Channel::Specular, "square root of red") / std::sqrt(0.04));
        const double shareOfAlpha = 4.0 * stepOf(Channel::Microsurface, "fourth root of alpha") / std::pow(0.01, 0.25);
        EXPECT_NEAR(promise.bias, 3.0 * shareOfAlpha * shareOfAlpha / 4.0, 0.05 * promise.bias);
    }
}

TEST(GBufferLayout, definesGiveAttachmentsOfExactChannelsAndBitsOfTheOthers) {
    GBufferLayout layout = namedLayout("packed");
    layout.encoding[std::size_t(Channel::Emission)] = Encoding::Exact;
    const std::vector<Channel> channels{Channel::Normal, Channel::Specular, Channel::Emission};
    EXPECT_EQ(channelDefines(layout, channels),
              (Defines{{"GBUFFER_NORMAL", "0"},
                       {"GBUFFER_NORMAL_WIDTHS", "15, 15, 0, 0"},
                       {"GBUFFER_SPECULAR", "30"},
                       {"GBUFFER_SPECULAR_WIDTHS", "6, 6, 6, 0"},
                       {"GBUFFER_EMISSION", "0"},
                       {"GBUFFER_CHANNELS", "PACKED_CHANNEL(putNormal, takeNormal, 0, ivec4(15, 15, 0, 0)) "
                                            "PACKED_CHANNEL(putSpecular, takeSpecular, 30, ivec4(6, 6, 6, 0)) "
                                            "EXACT_CHANNEL(putEmission, takeEmission, 0)"},
                       {"GBUFFER_EXACT_CHANNELS", "1"},
                       {"GBUFFER_WORDS", "2"},
                       {"GBUFFER_WORD_TEXTURE", "1"}}));
    EXPECT_THAT(channelDefines(layout, std::vector{Channel::NormalTexel}),
                Contains(Pair("GBUFFER_CHANNELS", StartsWith("PACKED_CHANNEL(putNormalTexel, takeNormalTexel, "))));
    EXPECT_THAT(channelDefines(layout, {}), IsEmpty());
}

TEST(GBufferLayout, marksFollowTheirEnumerationAndLieBesideChannelsThatTheExactLayoutStores) {
    ASSERT_EQ(markTable().size(), kMarkCount);
    for (std::size_t i = 0; i < kMarkCount; ++i) EXPECT_EQ(std::size_t(markTable()[i].mark), i);
    const GBufferLayout& exact = namedLayout("exact");
    const std::vector<Channel> channels = neededChannels(allFeatures(), exact, false);
    ASSERT_EQ(gbufferTextures(exact, channels).size(), 8u) << "no room for another texture";
    const std::vector<Mark> marks = neededMarks(allFeatures(), exact, channels);
    EXPECT_THAT(marks, ElementsAre(Mark::Facets, Mark::Lift, Mark::Subsurface, Mark::Occlusion));
    EXPECT_FALSE(markTexture(exact, channels, marks));
    for (const MarkInfo& info : markTable()) EXPECT_THAT(channels, Contains(info.beside)) << info.name;
    EXPECT_EQ(markDefines(exact, channels, marks), (Defines{{"GBUFFER_FACETS_IN_SPECULAR", "1"},
                                                            {"GBUFFER_LIFT_IN_NORMAL", "1"},
                                                            {"GBUFFER_SUBSURFACE_IN_EMISSION", "1"},
                                                            {"GBUFFER_OCCLUSION_IN_ALBEDO", "1"}}));
}

TEST(GBufferLayout, aWordHoldsAnyTwoMarksAndASecondOneTheThird) {
    const GBufferLayout& packed = namedLayout("packed");
    const std::vector<Channel> channels{Channel::Albedo, Channel::Normal};
    const auto stored = [&](const std::vector<Mark>& marks) {
        const std::optional<GBufferTexture> texture = markTexture(packed, channels, marks);
        return texture ? *texture : GBufferTexture{};
    };
    using graph::Format;
    EXPECT_FALSE(markTexture(packed, channels, {}));
    EXPECT_THAT(markDefines(packed, channels, {}), IsEmpty());
    EXPECT_EQ(stored({Mark::Facets, Mark::Occlusion}), (GBufferTexture{"facets and occlusion", Format::R32Uint}));
    EXPECT_EQ(stored({Mark::Facets, Mark::Subsurface}), (GBufferTexture{"facets and subsurface", Format::R32Uint}));
    const std::vector<Mark> all{Mark::Facets, Mark::Subsurface, Mark::Occlusion};
    EXPECT_EQ(stored(all), (GBufferTexture{"facets and subsurface and occlusion", Format::Rg32Uint}));
    EXPECT_EQ(markDefines(packed, channels, all),
              (Defines{{"GBUFFER_FACETS", "0"},
                       {"GBUFFER_SUBSURFACE", "24"},
                       {"GBUFFER_OCCLUSION", "32"},
                       {"GBUFFER_MARKS", "1"},
                       {"GBUFFER_MARK_LIST", "MARK(codeOfFacets, takeFacets, 0, 24) "
                                             "MARK(codeOfSubsurface, takeSubsurface, 24, 8) "
                                             "MARK(codeOfOcclusion, takeOcclusion, 32, 8)"}}));
}

TEST(GBufferLayout, theNumberOfAMaterialSaysItsMarks) {
    const GBufferLayout& exact = namedLayout("exact");
    FeatureSet features = featuresOf(MaterialModel::Lambert,
                                     [](scenes::Material& m) { m.subsurface.method = scenes::SubsurfaceMethod::Wrap; });
    features.add(Feature::Shadows);
    const std::vector<Channel> numbers = neededChannels(features, exact, false);
    ASSERT_TRUE(holdMaterialNumber(exact, numbers));
    EXPECT_THAT(neededMarks(features, exact, numbers), ElementsAre(Mark::Facets));
    const std::vector<Channel> values = neededChannels(varying(features), exact, false);
    EXPECT_THAT(neededMarks(features, exact, values), ElementsAre(Mark::Facets, Mark::Subsurface));
}

} // namespace
} // namespace tessera::frame
