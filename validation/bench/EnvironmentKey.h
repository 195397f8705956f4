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

/// The key of a matrix and the field of a record that name how the environment's light is found: a setting's own.
inline constexpr std::string_view kEnvironmentKey = "environmentLight";

/// A setting of that light that a matrix varies beside: a row of engine::settingTable().
struct EnvironmentSetting {
    std::string_view key;    ///< of the settings, the matrix and the record
    std::string_view format; ///< of a value in a point's name
    bool (*matters)(frame::EnvironmentLight light);
    std::string_view absent; ///< why a point has no value
};
std::span<const EnvironmentSetting> environmentSettingTable();

/// How a point finds the light of the environment, and what may change its frame among the settings of that.
struct EnvironmentKey {
    std::string light;            ///< a name of frame::environmentLightTable()
    std::vector<KeyValue> values; ///< in the order of the table

    /// Null: no value.
    const std::string* text(std::string_view key) const { return valueText(values, key); }
    bool operator==(const EnvironmentKey&) const = default;
};

/// Of a frame with these settings, in a group whose scene has light of an environment.
EnvironmentKey environmentKeyOf(const frame::FrameSettings& settings);

/// "environment sampled, 16 samples", without values that are the default; "no environment light".
std::string environmentText(const EnvironmentKey& key);

} // namespace tessera::validation
