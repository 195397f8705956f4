#include "validation/bench/ShadowKey.h"

#include <algorithm>

namespace tessera::validation {

using frame::Feature, frame::PackedLights, frame::ShadowFilter;

namespace {

bool hasShadowsOf(scenes::LightType type, const PackedLights& lights) {
    return std::any_of(
        lights.texels.begin(), lights.texels.begin() + std::ptrdiff_t(lights.shadowed),
        [&](const shared::LightTexels& light) { return (int(light.color.w) & LIGHT_TYPE_MASK) == int(type); });
}

} // namespace

std::span<const ShadowSetting> shadowSettingTable() {
    static constexpr auto hasMaps = [](const PackedLights& lights, ShadowFilter) {
        return lights.features[Feature::ShadowMaps];
    };
    static constexpr std::string_view kNoMaps = "no shadow is looked up in a map";
    static constexpr ShadowSetting table[] = {
        {"shadowSamples", "samples {}", false,
         [](const PackedLights& lights, ShadowFilter) { return lights.features[Feature::SoftShadows]; },
         "no shadow is soft: no light with a size casts one, or the filter heeds no sizes"},
        {"shadowWidth", "{0}x{0}", false,
         [](const PackedLights&, ShadowFilter filter) { return frame::infoOf(filter).heedsWidth; },
         "the filter averages no square"},
        {"shadowResolution", "{} texels", true, hasMaps,
         "no shadow is looked up in a map, or the sides of faces follow from what lights reach in the picture"},
        {"shadowBudget", "{} MiB", true, hasMaps, kNoMaps},
        {"shadowCascades", "cascades {}", true,
         [](const PackedLights& lights, ShadowFilter) {
             return lights.features[Feature::ShadowMaps] && hasShadowsOf(scenes::LightType::Directional, lights);
         },
         "no shadow of a directional light is looked up in a map"},
    };
    return table;
}

bool ShadowKey::usesMaps() const {
    const auto filters = frame::shadowFilterTable();
    const auto row = std::ranges::find(filters, filter, &frame::ShadowFilterInfo::name);
    return row != filters.end() && row->usesMaps;
}

ShadowKey shadowKeyOf(const frame::PackedLights& lights, const frame::FrameSettings& settings) {
    ShadowKey key;
    if (lights.shadowed == 0) return key;
    key.filter = frame::infoOf(settings.shadowFilter).name;
    for (const ShadowSetting& row : shadowSettingTable()) {
        if (!row.matters(lights, settings.shadowFilter)) continue;
        const engine::Setting& setting = engine::settingOf(row.key);
        std::string text = setting.text({.settings = settings});
        if (text != setting.value.open) key.values.push_back({row.key, std::move(text)});
    }
    return key;
}

std::string shadowText(const ShadowKey& key) {
    if (key.filter == kNoShadows) return "no shadows";
    return key.filter + changedTexts(key.values, shadowSettingTable());
}

} // namespace tessera::validation
