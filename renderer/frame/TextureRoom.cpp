#include "renderer/frame/TextureRoom.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shaders/shared/slots.h"

namespace tessera::frame {

using scenes::TextureSlot;

namespace {

/// Whether programs with the features sample the slot; some slots also require the feature that they modulate.
bool isSampled(const FeatureSet& features, TextureSlot slot) {
    if (!features[slot]) return false;
    switch (slot) {
    case TextureSlot::Emissive:
        return features[Feature::Emission];
    case TextureSlot::Anisotropy:
        return features.tangentFrame();
    case TextureSlot::Clearcoat:
    case TextureSlot::ClearcoatRoughness:
    case TextureSlot::ClearcoatNormal:
        return features[Feature::Clearcoat];
    case TextureSlot::SheenColor:
    case TextureSlot::SheenRoughness:
        return features[Feature::Sheen];
    case TextureSlot::Transmission:
    case TextureSlot::Thickness:
        return features[Feature::Transmission];
    case TextureSlot::Iridescence:
    case TextureSlot::IridescenceThickness:
        return features[Feature::Iridescence];
    default:
        return true;
    }
}

/// Number of sampled textures other than those of materials.
std::size_t sampledBeside(const FrameSpec& spec) {
    const FeatureSet& features = spec.features;
    std::size_t sampled = 2; // TEXTURE_UNIT_LIGHTS and _LIGHT_ENTRIES
    const auto add = [&](bool isOne) { sampled += isOne ? 1 : 0; };
    add(features[Feature::Shadows]);       // TEXTURE_UNIT_SHADOWS
    add(features[Feature::Environment]);   // TEXTURE_UNIT_ENVIRONMENT_SAMPLES or _FILTERED
    add(spec.lightsByEnvironmentMap());    // TEXTURE_UNIT_ENVIRONMENT
    add(spec.usesLobeTable());             // TEXTURE_UNIT_LOBES
    add(spec.usesLobeShapes());            // TEXTURE_UNIT_LOBE_SHAPES
    add(features[Feature::LightPictures]); // TEXTURE_UNIT_LIGHT_PICTURES
    add(spec.showsBehindGlass);            // TEXTURE_UNIT_BEHIND
    add(spec.showsBehindGlass);            // TEXTURE_UNIT_BEHIND_DEPTH
    add(spec.blursBehindGlass);            // TEXTURE_UNIT_BEHIND_LEVELS
    add(spec.drawsFarSides);               // TEXTURE_UNIT_FAR_SIDES
    return sampled;
}

// Slots up to this one are never dropped: shaders rely on them if a flag of the material is set. They always fit.
constexpr std::size_t kMostBeside = 8;
constexpr TextureSlot kLastKept = TextureSlot::Anisotropy;
static_assert(std::size_t(kLastKept) + 1 + kMostBeside <= TEXTURE_UNITS_GUARANTEED);

} // namespace

std::size_t sampledTextures(const FrameSpec& spec) {
    return sampledBeside(spec) +
           std::size_t(std::ranges::count_if(scenes::kTextureSlots, [&](const scenes::TextureSlotInfo& info) {
               return isSampled(spec.features, info.slot);
           }));
}

void leaveOutTextures(FrameSpec& spec, const FeatureSet& used) {
    for (const bool read : {false, true}) {
        if (read && sampledTextures(spec) > std::size_t(spec.settings.texturesAStage)) {
            spec.hasNoRoomBehindGlass = spec.showsBehindGlass || spec.drawsFarSides;
            spec.showsBehindGlass = spec.blursBehindGlass = spec.scattersBySheets = spec.drawsFarSides = false;
        }
        for (auto at = scenes::kTextureSlots.rbegin(); at != scenes::kTextureSlots.rend(); ++at) {
            const scenes::TextureSlotInfo& info = *at;
            // Without normal maps other features would have to be dropped too.
            const TextureSlot lastKept = read ? kLastKept : TextureSlot::Normal;
            if (info.slot <= lastKept || sampledTextures(spec) <= std::size_t(spec.settings.texturesAStage)) break;
            if (!isSampled(spec.features, info.slot) || isSampled(used, info.slot) != read) continue;
            spec.features.has.reset(std::size_t(featureOf(info.slot)));
            if (read) spec.withoutTextures.push_back(info.slot);
        }
    }
}

std::string missingTextures(const FrameSpec& spec) {
    std::vector<std::string> parts;
    if (spec.hasNoRoomBehindGlass) parts.emplace_back("left out: the surfaces behind bodies of glass and rough sheets");
    if (!spec.withoutTextures.empty()) {
        std::vector<std::string_view> names;
        for (const TextureSlot slot : spec.withoutTextures) names.push_back(infoOf(slot).what);
        std::ranges::reverse(names);
        parts.push_back(fmt::format("left out, so that factors hold everywhere: {}", fmt::join(names, ", ")));
    }
    if (parts.empty()) return "";
    return fmt::format("a shader of this driver samples at most {} textures, and the scene's materials and lights need "
                       "more; {}",
                       spec.settings.texturesAStage, fmt::join(parts, "; "));
}

} // namespace tessera::frame
