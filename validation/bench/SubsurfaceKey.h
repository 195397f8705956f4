#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"
#include "validation/bench/KeyValues.h"

namespace tessera::validation {

/// The key of a matrix and the field of a record that name the method of subsurface scattering.
inline constexpr std::string_view kSubsurfaceKey = "subsurface";

/// A setting of spread light that a matrix varies beside the method: one of frame::kDiffusionFields, and so a row of
/// engine::settingTable().
struct SubsurfaceSetting {
    std::string_view key;    ///< of the settings, the matrix and the record
    std::string_view format; ///< of a value in a point's name
};
std::span<const SubsurfaceSetting> subsurfaceSettingTable();

/// What a point's surfaces do with light that enters them: the method, and how light is spread where some spreads.
struct SubsurfaceKey {
    std::string method;           ///< a name of scenes::subsurfaceMethods(), or "material" where materials differ
    std::vector<KeyValue> values; ///< in the order of the table; empty where no light spreads

    /// Null: no value.
    const std::string* text(std::string_view key) const { return valueText(values, key); }
    bool operator==(const SubsurfaceKey&) const = default;
};

/// Of a frame with these settings; none where no material has a subsurface.
std::optional<SubsurfaceKey> subsurfaceKeyOf(const scenes::Scene& scene, const frame::FrameSettings& settings);

/// "texture_space_diffusion, 256 texels", without values that are the default; "no subsurface".
std::string subsurfaceText(const SubsurfaceKey& key);

} // namespace tessera::validation
