#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameSettings.h"
#include "validation/bench/KeyValues.h"

namespace tessera::validation {

/// The key of a matrix and the field of a record that name how the light of area lights is found: a setting's own.
inline constexpr std::string_view kAreaKey = "areaLights";

/// A setting of that light that a matrix varies beside: a row of engine::settingTable().
struct AreaSetting {
    std::string_view key;    ///< of the settings, the matrix and the record
    std::string_view format; ///< of a value in a point's name
};
std::span<const AreaSetting> areaSettingTable();

/// How a point finds the light of area lights, and what may change its frame among the settings of that.
struct AreaKey {
    std::string method;           ///< a name of frame::areaLightsTable()
    std::vector<KeyValue> values; ///< in the order of the table

    /// Null: no value.
    const std::string* text(std::string_view key) const { return valueText(values, key); }
    bool operator==(const AreaKey&) const = default;
};

/// Of a frame with these settings, in a group whose scene has area lights.
AreaKey areaKeyOf(const frame::FrameSettings& settings);

/// "area lights sampled, samples 64", without values that are the default.
std::string areaText(const AreaKey& key);

} // namespace tessera::validation
