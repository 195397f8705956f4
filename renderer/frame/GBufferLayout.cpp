#include "renderer/frame/GBufferLayout.h"

#include <algorithm>

namespace tessera::frame {

namespace {

using graph::Format;

constexpr ChannelInfo kChannels[] = {
    {Channel::Albedo, "albedo", "ALBEDO", "k_d or base colour", Format::Rgba32Float, Format::R32Uint,
     "square root, 11 11 10 bit, 0..1", "scenes with a lit model"},
    {Channel::Normal, "normal", "NORMAL", "unit normal, lighting space", Format::Rgba32Float, Format::Rg16Snorm,
     "octahedral 2 x 16 bit", "scenes with a lit model"},
    {Channel::Microsurface, "microsurface", "MICROSURFACE", "alpha, model, ior or F90, metallic; exponent; masking",
     Format::Rgba32Float, Format::R32Uint,
     "perceptual roughness 11 bit, (ior-1)/(ior+1) or F90 11 bit, metallic or masking 7 bit, model 3 bit; exponent as "
     "a float of 22 bit",
     "scenes with several models, another ior, or no room beside albedo and normal"},
    {Channel::Specular, "specular", "SPECULAR", "k_s or dielectric F0", Format::Rgba32Float, Format::R32Uint,
     "square root, 11 11 10 bit, 0..1", "scenes that change k_s or the dielectric F0"},
    {Channel::Emission, "emission", "EMISSION", "radiance without lights", Format::Rgba32Float, Format::R32Uint,
     "shared exponent 9 9 9 5", "scenes with emissive or unlit materials"},
    {Channel::Tangent, "tangent", "TANGENT", "unit tangent, lighting space; alpha along the bitangent",
     Format::Rgba32Float, Format::R32Uint, "angle 16 bit and its axis 2 bit, perceptual roughness 11 bit",
     "scenes with anisotropic materials"},
    {Channel::Clearcoat, "clearcoat", "CLEARCOAT", "the coat's normal, octahedral; share; alpha", Format::Rgba32Float,
     Format::Rg32Uint, "octahedral 2 x 16 bit, share 16 bit, perceptual roughness 16 bit",
     "scenes with coated materials"},
    {Channel::Sheen, "sheen", "SHEEN", "the sheen's colour and alpha", Format::Rgba32Float, Format::R32Uint,
     "square root, 8 8 8 bit, 0..1; perceptual roughness 8 bit", "scenes with cloth"},
    {Channel::NormalTexel, "normal_texel", "NORMAL_TEXEL", "normal map as stored", Format::Rgba32Float,
     Format::Rgba8Unorm, "8 bit a component", "the view that shows it"},
};
static_assert(std::size(kChannels) == kChannelCount);

bool haveSpareComponents(const GBufferLayout& layout) {
    return layout[Channel::Albedo] == Encoding::Exact && layout[Channel::Normal] == Encoding::Exact;
}

constexpr GBufferLayout uniformLayout(Encoding encoding) {
    GBufferLayout layout;
    layout.encoding.fill(encoding);
    return layout;
}

constexpr LayoutInfo kLayouts[] = {
    {"exact", "fp32 everywhere; deferred equals forward to the last bit", uniformLayout(Encoding::Exact)},
    {"packed", "12 to 16 bytes a pixel and depth; relMse below 1e-4", uniformLayout(Encoding::Packed)},
};

} // namespace

std::span<const ChannelInfo> channelTable() {
    return kChannels;
}
std::span<const LayoutInfo> layoutTable() {
    return kLayouts;
}

graph::Format GBufferLayout::format(Channel channel) const {
    const ChannelInfo& info = kChannels[static_cast<std::size_t>(channel)];
    return (*this)[channel] == Encoding::Exact ? info.exact : info.packed;
}

std::vector<Channel> neededChannels(const FeatureSet& features, const GBufferLayout& layout, bool normalTexel) {
    const bool glossy = features.glossyModels();
    std::vector<Channel> channels;
    if (features.litModels()) {
        channels.push_back(Channel::Albedo);
        channels.push_back(Channel::Normal);
    }
    const bool alphaAndMetallicOnly =
        features.soleModel == scenes::MaterialModel::MetallicRoughness && !features[Feature::Specular];
    const bool spare =
        alphaAndMetallicOnly && haveSpareComponents(layout) && layout[Channel::Microsurface] == Encoding::Exact;
    if ((glossy || !features.soleModel) && !spare) channels.push_back(Channel::Microsurface);
    if (glossy && features[Feature::Specular]) channels.push_back(Channel::Specular);
    if (features[Feature::Emission]) channels.push_back(Channel::Emission);
    if (normalTexel) {
        channels.push_back(Channel::NormalTexel);
        return channels;
    }
    if (features.tangentFrame()) channels.push_back(Channel::Tangent);
    if (features[Feature::Clearcoat]) channels.push_back(Channel::Clearcoat);
    if (features[Feature::Sheen]) channels.push_back(Channel::Sheen);
    return channels;
}

Defines channelDefines(const GBufferLayout& layout, std::span<const Channel> channels) {
    Defines defines;
    for (std::size_t attachment = 0; attachment < channels.size(); ++attachment) {
        const std::string name =
            "GBUFFER_" + std::string(kChannels[static_cast<std::size_t>(channels[attachment])].define);
        defines.emplace_back(name, std::to_string(attachment));
        defines.emplace_back(name + "_PACKED", layout[channels[attachment]] == Encoding::Packed ? "1" : "0");
    }
    const auto has = [&](Channel channel) {
        return std::find(channels.begin(), channels.end(), channel) != channels.end();
    };
    if (has(Channel::Albedo) && has(Channel::Normal) && !has(Channel::Microsurface) && haveSpareComponents(layout))
        defines.emplace_back("GBUFFER_SPARE_COMPONENTS", "1");
    return defines;
}

} // namespace tessera::frame
