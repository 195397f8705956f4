#include "renderer/frame/GBufferLayout.h"

#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/unit/scenes/TinyScene.h"

namespace tessera::frame {
namespace {

using scenes::MaterialModel;
using testing::ElementsAre;
using testing::IsEmpty;

FeatureSet featuresOf(
    MaterialModel model, const std::function<void(scenes::Material&)>& change = [](scenes::Material&) {}) {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials[0].model = model;
    change(scene.materials[0]);
    return materialFeatures(scene);
}

int bytesPerPixel(const GBufferLayout& layout, const std::vector<Channel>& channels) {
    int bytes = 0;
    for (const Channel channel : channels) bytes += graph::formatInfo(layout.format(channel)).bytes;
    return bytes;
}

const GBufferLayout& namedLayout(std::string_view name) {
    for (const LayoutInfo& info : layoutTable())
        if (info.name == name) return info.layout;
    throw std::runtime_error("no such layout");
}

TEST(GBufferLayout, theTableAlwaysFollowsTheEnumeration) {
    ASSERT_EQ(channelTable().size(), kChannelCount);
    for (std::size_t i = 0; i < kChannelCount; ++i) EXPECT_EQ(std::size_t(channelTable()[i].channel), i);
    EXPECT_EQ(layoutTable()[0].name, "exact");
}

TEST(GBufferLayout, theExactLayoutIsAlwaysFp32) {
    for (const ChannelInfo& info : channelTable())
        EXPECT_EQ(namedLayout("exact").format(info.channel), graph::Format::Rgba32Float) << info.name;
}

TEST(GBufferLayout, alphaAndMetallicAlwaysFillSpareComponentsWhereNothingElseIsStoredOfTheMicrosurface) {
    const GBufferLayout& exact = namedLayout("exact");
    const FeatureSet plain = featuresOf(MaterialModel::MetallicRoughness);
    const std::vector<Channel> channels = neededChannels(plain, exact, false);
    EXPECT_THAT(channels, ElementsAre(Channel::Albedo, Channel::Normal));
    EXPECT_EQ(channelDefines(exact, channels).back(),
              std::make_pair(std::string("GBUFFER_SPARE_COMPONENTS"), std::string("1")));
    const FeatureSet tinted = featuresOf(MaterialModel::MetallicRoughness, [](scenes::Material& m) { m.ior = 1.4f; });
    for (const FeatureSet& features : {tinted, featuresOf(MaterialModel::Microfacet), allFeatures()})
        EXPECT_THAT(neededChannels(features, exact, false), testing::Contains(Channel::Microsurface));
    GBufferLayout mixed = exact;
    mixed.encoding[std::size_t(Channel::Normal)] = Encoding::Packed;
    EXPECT_THAT(neededChannels(plain, mixed, false), testing::Contains(Channel::Microsurface));
}

TEST(GBufferLayout, channelsAreAllocatedExactlyWhenASurfaceNeedsThem) {
    const auto channels = [](const FeatureSet& features) {
        return neededChannels(features, namedLayout("packed"), false);
    };
    EXPECT_THAT(channels(featuresOf(MaterialModel::SingleColor)), ElementsAre(Channel::Emission));
    EXPECT_THAT(channels(featuresOf(MaterialModel::Lambert)), ElementsAre(Channel::Albedo, Channel::Normal));
    EXPECT_THAT(channels(featuresOf(MaterialModel::Microfacet)),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
    EXPECT_THAT(channels(featuresOf(MaterialModel::MetallicRoughness, [](scenes::Material& m) { m.ior = 1.4f; })),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Specular));
    EXPECT_THAT(channels(featuresOf(MaterialModel::Lambert, [](scenes::Material& m) { m.emissive.r = 1.0f; })),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Emission));
    EXPECT_THAT(neededChannels(featuresOf(MaterialModel::Lambert), namedLayout("packed"), true),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::NormalTexel));
    EXPECT_THAT(channels(featuresOf(MaterialModel::BlinnPhong)),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
    EXPECT_THAT(channels(featuresOf(MaterialModel::MicrofacetAnisotropic)),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Tangent));
    EXPECT_THAT(channels(featuresOf(MaterialModel::MetallicRoughness,
                                    [](scenes::Material& m) { m.anisotropyStrength = 0.5f; })),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Tangent));
    EXPECT_THAT(channels(featuresOf(MaterialModel::MetallicRoughness, [](scenes::Material& m) { m.clearcoat = 0.5f; })),
                ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Clearcoat));
    EXPECT_THAT(
        channels(featuresOf(MaterialModel::MetallicRoughness, [](scenes::Material& m) { m.sheenColor.g = 0.5f; })),
        ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface, Channel::Sheen));
    EXPECT_EQ(channels(allFeatures()).size(), kChannelCount - 1);

    FeatureSet mixed = featuresOf(MaterialModel::Lambert); // with unlit surfaces, so that a pixel must say which it is
    mixed.add(Feature::SingleColor);
    mixed.soleModel.reset();
    EXPECT_THAT(channels(mixed), ElementsAre(Channel::Albedo, Channel::Normal, Channel::Microsurface));
}

TEST(GBufferLayout, aFrameNeverNeedsMoreChannelsThanOpenGlDrawsIntoAtOnce) {
    constexpr std::size_t kDrawBuffers = 8; // the least GL_MAX_DRAW_BUFFERS of OpenGL 4.5
    for (const LayoutInfo& info : layoutTable()) {
        for (const bool normalTexel : {false, true})
            EXPECT_LE(neededChannels(allFeatures(), info.layout, normalTexel).size(), kDrawBuffers) << info.name;
    }
}

TEST(GBufferLayout, packedIsNeverMoreThanSixteenBytesForIsotropicSurfacesOfOneLayerThatDoNotEmit) {
    const GBufferLayout& packed = namedLayout("packed");
    EXPECT_EQ(bytesPerPixel(packed, neededChannels(featuresOf(MaterialModel::Lambert), packed, false)), 8);
    EXPECT_EQ(bytesPerPixel(packed, neededChannels(featuresOf(MaterialModel::MetallicRoughness), packed, false)), 12);
    FeatureSet all = allFeatures();
    EXPECT_EQ(bytesPerPixel(packed, neededChannels(all, packed, false)), 36);
    for (const Feature layer :
         {Feature::MicrofacetAnisotropic, Feature::Anisotropy, Feature::Clearcoat, Feature::Sheen})
        all.has.reset(std::size_t(layer));
    EXPECT_EQ(bytesPerPixel(packed, neededChannels(all, packed, false)), 20);
    all.has.reset(std::size_t(Feature::Emission));
    EXPECT_EQ(bytesPerPixel(packed, neededChannels(all, packed, false)), 16);
    EXPECT_EQ(bytesPerPixel(namedLayout("exact"), neededChannels(all, packed, false)), 64);
}

TEST(GBufferLayout, definesAlwaysNumberTheChannelsInOrder) {
    GBufferLayout layout;
    layout.encoding[std::size_t(Channel::Normal)] = Encoding::Packed;
    const std::vector<Channel> channels{Channel::Normal, Channel::Emission};
    EXPECT_EQ(channelDefines(layout, channels), (Defines{{"GBUFFER_NORMAL", "0"},
                                                         {"GBUFFER_NORMAL_PACKED", "1"},
                                                         {"GBUFFER_EMISSION", "1"},
                                                         {"GBUFFER_EMISSION_PACKED", "0"}}));
    EXPECT_THAT(channelDefines(layout, {}), IsEmpty());
}

} // namespace
} // namespace tessera::frame
