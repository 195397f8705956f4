#include "validation/bench/ShadowKey.h"

#include <algorithm>

#include <fmt/format.h>

namespace tessera::validation {

using frame::Feature, frame::FeatureSet, frame::ShadowFilter;

std::span<const ShadowSetting> shadowSettingTable() {
    static constexpr auto hasMaps = [](const FeatureSet& features, ShadowFilter) {
        return features[Feature::ShadowMaps];
    };
    static constexpr std::string_view kNoMaps = "no shadow is looked up in a map";
    static constexpr ShadowSetting table[] = {
        {"shadowSamples", "samples {}", false,
         [](const FeatureSet& features, ShadowFilter) { return features[Feature::SoftShadows]; },
         "no shadow is soft: no light with a size casts one, or the filter heeds no sizes"},
        {"shadowWidth", "{0}x{0}", false,
         [](const FeatureSet&, ShadowFilter filter) { return frame::infoOf(filter).heedsWidth; },
         "the filter averages no square"},
        {"shadowResolution", "{} texels", true, hasMaps,
         "no shadow is looked up in a map, or the sides of faces follow from what lights reach in the picture"},
        {"shadowBudget", "{} MiB", true, hasMaps, kNoMaps},
        {"shadowCascades", "cascades {}", true,
         [](const FeatureSet& features, ShadowFilter) {
             return features[Feature::ShadowMaps] && features[scenes::LightType::Directional];
         },
         "no shadow of a directional light is looked up in a map"},
    };
    return table;
}

const std::string* ShadowKey::text(std::string_view key) const {
    const auto value = std::ranges::find(values, key, &Value::key);
    return value == values.end() ? nullptr : &value->text;
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
        if (!row.matters(lights.features, settings.shadowFilter)) continue;
        const engine::Setting& setting = engine::settingOf(row.key);
        std::string text = setting.text({.settings = settings});
        if (text != setting.value.open) key.values.push_back({row.key, std::move(text)});
    }
    return key;
}

std::string whyUnheeded(std::string_view key, const frame::PackedLights& lights, const frame::FrameSettings& settings) {
    const auto table = shadowSettingTable();
    const auto row = std::ranges::find(table, key, &ShadowSetting::key);
    if (key != "shadowFilter" && row == table.end()) return "";
    if (lights.shadowed == 0) return "no light in view casts shadows";
    if (row == table.end() || row->matters(lights.features, settings.shadowFilter)) return "";
    return std::string(row->absent);
}

std::string shadowText(const ShadowKey& key) {
    if (key.filter == kNoShadows) return "no shadows";
    std::string text = key.filter;
    for (const ShadowSetting& row : shadowSettingTable()) {
        const std::string* const value = key.text(row.key);
        if (value && *value != engine::settingOf(row.key).text({}))
            text += ", " + fmt::format(fmt::runtime(row.format), *value);
    }
    return text;
}

void readShadowSetting(engine::ViewRequest& request, std::string_view key, const std::string& text) {
    if (key == kShadowFilterKey) key = text == kNoShadows ? "shadows" : "shadowFilter";
    engine::settingOf(key).read(request, text);
}

} // namespace tessera::validation
