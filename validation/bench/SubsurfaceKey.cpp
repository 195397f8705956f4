#include "validation/bench/SubsurfaceKey.h"

#include <array>
#include <set>

#include "engine/Settings.h"
#include "scenes/InUse.h"

namespace tessera::validation {

using scenes::SubsurfaceMethod;

namespace {

/// By frame::kDiffusionFields.
constexpr std::array<std::string_view, std::tuple_size_v<decltype(frame::kDiffusionFields)>> kSubsurfaceFormats{
    "{} texels", "Gaussians {}", "half resolution {}"};

} // namespace

std::span<const SubsurfaceSetting> subsurfaceSettingTable() {
    static constexpr std::array<SubsurfaceSetting, kSubsurfaceFormats.size()> table = [] {
        std::array<SubsurfaceSetting, kSubsurfaceFormats.size()> rows{};
        std::size_t row = 0;
        scenes::visitFields(frame::kDiffusionFields, [&](const auto& field) {
            rows[row] = {field.name, kSubsurfaceFormats[row]};
            ++row;
        });
        return rows;
    }();
    return table;
}

std::optional<SubsurfaceKey> subsurfaceKeyOf(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    std::set<SubsurfaceMethod> methods;
    for (const scenes::Node& node : scene.nodes) {
        for (const scenes::MeshInstance& instance : node.instances) {
            const scenes::Material& material = scene.materials[std::size_t(instance.material)];
            if (!scenes::isDrawn(scene, instance) || material.subsurface.method == SubsurfaceMethod::None) continue;
            methods.insert(scenes::subsurfaceOf(material, settings.subsurface));
        }
    }
    if (methods.empty()) return {};
    SubsurfaceKey key;
    key.method = methods.size() > 1 ? "material" : std::string(infoOf(*methods.begin()).name);
    if (!scenes::anySpreads(scene, settings.subsurface)) return key;
    for (const SubsurfaceSetting& row : subsurfaceSettingTable())
        key.values.push_back({row.key, engine::settingOf(row.key).text({.settings = settings})});
    return key;
}

std::string subsurfaceText(const SubsurfaceKey& key) {
    if (key.method == infoOf(SubsurfaceMethod::None).name) return "no subsurface";
    return key.method + changedTexts(key.values, subsurfaceSettingTable());
}

} // namespace tessera::validation
