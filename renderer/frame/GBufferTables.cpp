// The tables of channels, flag bits and layouts of G-buffers.
#include "renderer/frame/GBufferLayout.h"

#include <algorithm>

#include "shaders/shared/facet.h"
#include "shaders/shared/occlusion.h"
#include "shaders/shared/subsurface.h"

namespace tessera::frame {

namespace {

// The first five channels hold every isotropic surface; their widths add up to 128 and 96 bits.
constexpr ChannelInfo kChannels[] = {
    {Channel::Albedo,
     "albedo",
     "ALBEDO",
     "k_d or base colour",
     "square roots of red, green, blue",
     {10, 10, 10},
     {8, 8, 8},
     "scenes with a lit model",
     true,
     false,
     [](const FeatureSet& f, bool) { return f.litModels(); }},
    {Channel::Normal,
     "normal",
     "NORMAL",
     "unit normal, lighting space",
     "octahedral, two coordinates",
     {15, 15},
     {10, 10},
     "scenes with a lit model",
     false,
     true,
     [](const FeatureSet& f, bool) { return f.litModels(); }},
    {Channel::Microsurface,
     "microsurface",
     "MICROSURFACE",
     "alpha, model, ior or F90, metallic; exponent; masking",
     "model and masking, fourth root of alpha, F90, metallic; (ior-1)/(ior+1) in the last two; exponent as a float in "
     "the last three",
     {4, 11, 3, 8},
     {4, 8, 1, 6},
     "scenes with several models, another ior, or no room beside albedo and normal",
     true,
     false,
     [](const FeatureSet& f, bool) { return f.microsurfaces() || !f.soleModel; }},
    {Channel::Specular,
     "specular",
     "SPECULAR",
     "k_s or dielectric F0",
     "square roots of red, green, blue",
     {6, 6, 6},
     {4, 4, 4},
     "scenes that change k_s or the dielectric F0",
     true,
     false,
     [](const FeatureSet& f, bool) { return f.glossyModels() && f[Feature::Specular]; }},
    {Channel::Emission,
     "emission",
     "EMISSION",
     "radiance without lights",
     "shared exponent; red, green, blue",
     {6, 6, 6, 6},
     {6, 5, 5, 5},
     "scenes with emissive or unlit materials",
     true,
     false,
     [](const FeatureSet& f, bool) { return f[Feature::Emission]; }},
    {Channel::Tangent,
     "tangent",
     "TANGENT",
     "unit tangent, lighting space; alpha along the bitangent",
     "axis, point on half a diamond, fourth root of alpha",
     {2, 13, 11},
     {2, 9, 8},
     "scenes with anisotropic materials",
     false,
     true,
     [](const FeatureSet& f, bool normalTexel) { return f.tangentFrame() && !normalTexel; }},
    {Channel::Clearcoat,
     "clearcoat",
     "CLEARCOAT",
     "the coat's normal, octahedral; share; alpha",
     "octahedral, two coordinates; share, fourth root of alpha",
     {12, 12, 8, 11},
     {10, 10, 6, 8},
     "scenes with coated materials",
     false,
     true,
     [](const FeatureSet& f, bool normalTexel) { return f[Feature::Clearcoat] && !normalTexel; }},
    {Channel::Sheen,
     "sheen",
     "SHEEN",
     "the sheen's colour and alpha",
     "square roots of red, green, blue; fourth root of alpha",
     {8, 8, 8, 8},
     {6, 6, 6, 6},
     "scenes with cloth",
     true,
     false,
     [](const FeatureSet& f, bool normalTexel) { return f[Feature::Sheen] && !normalTexel; }},
    {Channel::NormalTexel,
     "normal_texel",
     "NORMAL_TEXEL",
     "normal map as stored",
     "red, green, blue",
     {8, 8, 8},
     {8, 8, 8},
     "the view that shows it",
     false,
     false,
     [](const FeatureSet&, bool normalTexel) { return normalTexel; }},
};
static_assert(std::size(kChannels) == kChannelCount);

constexpr MarkInfo kMarks[] = {
    {Mark::Facets, "facets", "FACETS", "the triangle's own normal, octahedral", 2 * FACET_BITS, Channel::Specular,
     "scenes with shadows in view", false, [](const FeatureSet& f) { return f[Feature::Shadows]; }},
    {Mark::Lift, "lift", "LIFT", "height above the triangle at which shadow rays start", LIFT_BITS, Channel::Normal,
     "scenes with shadows in view whose terminators are softened", false,
     [](const FeatureSet& f) { return f[Feature::ShadowLift]; }},
    {Mark::Subsurface, "subsurface", "SUBSURFACE", "row of the subsurface's constants", SUBSURFACE_BITS,
     Channel::Emission, "scenes whose surfaces wrap light or let it through", true,
     [](const FeatureSet& f) { return f.subsurfaceRows(); }},
    {Mark::Occlusion, "occlusion", "OCCLUSION", "share of the environment's light that arrives", OPEN_BITS,
     Channel::Albedo, "scenes with occlusion textures that an environment lights", true,
     [](const FeatureSet& f) { return f[scenes::TextureSlot::Occlusion] && f[Feature::Environment]; }},
};
static_assert(std::size(kMarks) == kMarkCount);
// fp32 represents integers of up to 24 bits exactly.
static_assert(std::ranges::all_of(kMarks, [](const MarkInfo& row) { return row.bits > 0 && row.bits <= 24; }));

/// Bits of the words up to the end of the normal.
constexpr int bitsUpToNormal(FieldWidths ChannelInfo::*widths) {
    int bits = 0;
    for (const ChannelInfo& row : kChannels) {
        for (const int width : row.*widths) bits += width;
        if (row.channel == Channel::Normal) break;
    }
    return bits;
}
// Light culling reads normals from the first texture of words, which has one, two or four.
static_assert(std::max(bitsUpToNormal(&ChannelInfo::packed), bitsUpToNormal(&ChannelInfo::slim)) <= 64);

// Three colours of equal width share one exponent; with more than 7 bits it would exceed fp32's range.
static_assert(std::ranges::all_of(kChannels, [](const ChannelInfo& row) {
    const auto isGood = [](const FieldWidths& widths) {
        return widths[0] <= 7 && widths[1] == widths[2] && widths[1] == widths[3];
    };
    return row.channel != Channel::Emission || (isGood(row.packed) && isGood(row.slim));
}));

// The field of model and masking enumerates the models, then each microfacet model with every other masking
// (shaders/lib/gbuffer/gbuffer_encodings.glsl).
constexpr std::size_t kKindCodes = [] {
    std::size_t codes = scenes::kMaterialModelCount;
    for (const scenes::MaterialModelInfo& model : scenes::materialModels())
        if (model.isMicrofacet()) codes += std::size_t(scenes::Masking::Count) - 1;
    return codes;
}();
static_assert(std::ranges::all_of(kChannels, [](const ChannelInfo& row) {
    return row.channel != Channel::Microsurface || kKindCodes <= std::size_t(1) << std::min(row.packed[0], row.slim[0]);
}));

constexpr GBufferLayout uniformLayout(Encoding encoding) {
    GBufferLayout layout;
    layout.encoding.fill(encoding);
    return layout;
}

// By Encoding. p999Rel: k_s has the coarsest relative step. At 4 % reflectance (root 0.2), a step of 1/60 or 1/15 in
// the root is 2/(60 x 0.2) or 2/(15 x 0.2) of the value. bias: every field is right in the mean, so the rest is of
// second order in the steps of alpha: a highlight's peak is proportional to 1/alpha^2, half its second derivative is
// 3/alpha^4, and the variance of a dithered value is at most a quarter of the squared step. Values at alpha 0.01.
constexpr LayoutInfo kLayouts[] = {
    {"exact", "what forward lights, to the last bit", uniformLayout(Encoding::Exact), {0.0, 0.0, 0.0}},
    {"packed",
     "8 to 16 bytes a pixel and depth for isotropic scenes; relMse below 1e-4",
     uniformLayout(Encoding::Packed),
     {1e-4, 1.0 / 6.0, 1.9e-5}},
    {"slim",
     "8 to 12 bytes a pixel and depth for isotropic scenes; relMse below 5e-4",
     uniformLayout(Encoding::Slim),
     {5e-4, 2.0 / 3.0, 1.25e-3}},
};

} // namespace

std::span<const ChannelInfo> channelTable() {
    return kChannels;
}
std::span<const MarkInfo> markTable() {
    return kMarks;
}
std::span<const LayoutInfo> layoutTable() {
    return kLayouts;
}

} // namespace tessera::frame
