#include "validation/bench/MethodKey.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "engine/Settings.h"
#include "renderer/frame/EnvironmentMap.h"
#include "scenes/InUse.h"

namespace tessera::validation {

using frame::Feature;

namespace {

using Facts = MethodFacts;

template <typename Table>
std::vector<std::string_view> namesOf(const Table& table, std::vector<std::string_view> before = {}) {
    for (const auto& row : table) before.push_back(row.name);
    return before;
}

// ---- Shadows -------------------------------------------------------------------------------------------------------

bool hasMaps(const Facts& facts) {
    return facts.prepared.lights.features[Feature::ShadowMaps];
}

bool hasShadowedSun(const Facts& facts) {
    const frame::PackedLights& lights = facts.prepared.lights;
    return std::any_of(lights.texels.begin(), lights.texels.begin() + std::ptrdiff_t(lights.shadowed),
                       [](const shared::LightTexels& light) {
                           return (int(light.color.w) & LIGHT_TYPE_MASK) == int(scenes::LightType::Directional);
                       });
}

constexpr std::string_view kNoMaps = "no shadow is looked up in a map";
constexpr MethodSetting kShadowSettings[] = {
    {"shadowSamples", "samples {}",
     [](const Facts& facts) { return bool(facts.prepared.lights.features[Feature::SoftShadows]); },
     "no shadow is soft: no light with a size casts one, or the filter ignores the sizes"},
    {"shadowWidth", "{0}x{0}", [](const Facts& facts) { return infoOf(facts.settings.shadowFilter).usesWidth; },
     "the filter averages no square"},
    {"shadowResolution", "{} texels", hasMaps,
     "no shadow is looked up in a map, or the sides of faces follow from what lights reach in the picture", true},
    {"shadowBudget", "{} MiB", hasMaps, kNoMaps, true},
    {"shadowCascades", "cascades {}", [](const Facts& facts) { return hasMaps(facts) && hasShadowedSun(facts); },
     "no shadow of a directional light is looked up in a map", true},
};

// ---- Subsurface scattering -----------------------------------------------------------------------------------------

std::set<scenes::SubsurfaceMethod> subsurfaceMethodsOf(const Facts& facts) {
    std::set<scenes::SubsurfaceMethod> methods;
    for (const scenes::Node& node : facts.scene.nodes)
        for (const scenes::MeshInstance& instance : node.instances) {
            const scenes::Material& material = facts.scene.materials[std::size_t(instance.material)];
            const bool scatters = material.subsurface.method != scenes::SubsurfaceMethod::None;
            if (scatters && scenes::isDrawn(facts.scene, instance))
                methods.insert(scenes::subsurfaceOf(material, facts.settings.subsurface));
        }
    return methods;
}

bool diffuses(const Facts& facts) {
    return scenes::anyDiffuses(facts.scene, facts.settings.subsurface);
}

constexpr std::string_view kNothingDiffuses = "no surface diffuses light";
constexpr MethodSetting kSubsurfaceSettings[] = {
    {std::get<0>(frame::kDiffusionFields).name, "{} texels", diffuses, kNothingDiffuses},
    {std::get<1>(frame::kDiffusionFields).name, "Gaussians {}", diffuses, kNothingDiffuses},
    {std::get<2>(frame::kDiffusionFields).name, "half resolution {}", diffuses, kNothingDiffuses},
};
static_assert(std::size(kSubsurfaceSettings) == std::tuple_size_v<decltype(frame::kDiffusionFields)>);

// ---- The environment and area lights -------------------------------------------------------------------------------

constexpr MethodSetting kEnvironmentSettings[] = {
    {"environmentSamples", "samples {}",
     [](const Facts& facts) { return infoOf(facts.settings.environment.light).usesSamples; },
     "the environment's light is not sampled"},
    {"environmentCompensation", "compensation {}",
     [](const Facts& facts) { return infoOf(facts.settings.environment.light).lights; },
     "there is no light of the environment"},
};
constexpr MethodSetting kAreaSettings[] = {
    {"areaSamples", "samples {}", [](const Facts& facts) { return infoOf(facts.settings.area.lights).usesSamples; },
     "the light of area lights is not sampled"}};

} // namespace

std::span<const MethodKindInfo> methodKindTable() {
    static const MethodKindInfo table[] = {
        {MethodKind::Shadows, "shadow", "shadowFilter", "shadows", "", kNoShadows, "no shadows", "there are no shadows",
         "shadow filter", "Shapes show how shadows are found.",
         [] { return namesOf(frame::shadowFilterTable(), {kNoShadows}); }, kShadowSettings,
         [](const Facts& facts) { return facts.prepared.lights.shadowed > 0; },
         [](const Facts& facts) {
             return std::string(facts.prepared.lights.shadowed > 0 ? infoOf(facts.settings.shadowFilter).name
                                                                   : kNoShadows);
         },
         "shadows", "there are no shadows"},
        {MethodKind::Subsurface, "subsurface", "subsurface", "subsurface", "",
         infoOf(scenes::SubsurfaceMethod::None).name, "no subsurface", "no material has a subsurface", "subsurface",
         "Shapes show what happens below surfaces.", [] { return namesOf(scenes::subsurfaceMethods()); },
         kSubsurfaceSettings, [](const Facts& facts) { return !subsurfaceMethodsOf(facts).empty(); },
         [](const Facts& facts) {
             const std::set<scenes::SubsurfaceMethod> methods = subsurfaceMethodsOf(facts);
             return methods.size() == 1 ? std::string(infoOf(*methods.begin()).name) : "material";
         }},
        {MethodKind::Environment, "environmentLight", "environmentLight", "environment", "environment ",
         infoOf(frame::EnvironmentLight::Off).name, "no environment light", "no environment shines",
         "environment light", "Shapes show how the environment's light is found.",
         [] { return namesOf(frame::environmentLightTable()); }, kEnvironmentSettings,
         [](const Facts& facts) { return frame::isLitByEnvironment(facts.scene, facts.settings); },
         [](const Facts& facts) { return std::string(infoOf(facts.settings.environment.light).name); }},
        {MethodKind::AreaLights, "areaLights", "areaLights", "area lights", "area lights ", "", "",
         "no area light shines", "area lights", "Shapes show how the light of area lights is found.",
         [] { return namesOf(frame::areaLightsTable()); }, kAreaSettings,
         [](const Facts& facts) { return facts.prepared.spec.areaLights > 0; },
         [](const Facts& facts) { return std::string(infoOf(facts.settings.area.lights).name); }},
    };
    return table;
}

const MethodKindInfo& infoOf(MethodKind kind) {
    return methodKindTable()[std::size_t(kind)];
}

const std::string* MethodKey::text(std::string_view key) const {
    const auto value = std::ranges::find(values, key, &SettingValue::key);
    return value == values.end() ? nullptr : &value->text;
}

MethodKey methodKeyOf(MethodKind kind, const MethodFacts& facts) {
    const MethodKindInfo& info = infoOf(kind);
    MethodKey key{info.nameOf(facts)};
    if (!info.off.empty() && key.name == info.off) return key;
    for (const MethodSetting& row : info.settings) {
        if (!row.matters(facts)) continue;
        const engine::Setting& setting = engine::settingOf(row.key);
        std::string text = setting.text({.settings = facts.settings});
        if (text != setting.value.open) key.values.push_back({row.key, std::move(text)});
    }
    return key;
}

std::string methodText(MethodKind kind, const MethodKey& key) {
    const MethodKindInfo& info = infoOf(kind);
    if (!info.off.empty() && key.name == info.off) return std::string(info.offText);
    std::string text = std::string(info.prefix) + key.name;
    for (const MethodSetting& row : info.settings)
        if (const std::string* const value = key.text(row.key); value && *value != engine::settingOf(row.key).text({}))
            text += ", " + fmt::format(fmt::runtime(row.format), *value);
    return text;
}

std::vector<std::string> methodTexts(const MethodKeys& keys) {
    std::vector<std::string> texts;
    for (const MethodKindInfo& info : methodKindTable())
        if (const auto& key = keys[std::size_t(info.kind)]) texts.push_back(methodText(info.kind, *key));
    return texts;
}

bool usesMaps(const MethodKey& shadows) {
    const auto filters = frame::shadowFilterTable();
    const auto row = std::ranges::find(filters, shadows.name, &frame::ShadowFilterInfo::name);
    return row != filters.end() && row->usesMaps;
}

} // namespace tessera::validation
