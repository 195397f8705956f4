#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/Settings.h"
#include "renderer/frame/PackedLights.h"
#include "validation/bench/KeyValues.h"

namespace tessera::validation {

/// The key of a matrix and the field of a record that name the filter.
inline constexpr std::string_view kShadowFilterKey = "shadow";
/// Of no filter: no light casts shadows.
inline constexpr std::string_view kNoShadows = "none";

/// A setting of shadows that a matrix varies beside the filter: a row of engine::settingTable().
struct ShadowSetting {
    std::string_view key;    ///< of the settings, the matrix and the record
    std::string_view format; ///< of a value in a point's name
    bool isOfMaps;           ///< it decides faces of shadow maps, and nothing else
    bool (*matters)(const frame::PackedLights& lights, frame::ShadowFilter filter);
    std::string_view absent; ///< why a point has no value
};
std::span<const ShadowSetting> shadowSettingTable();

/// How a point finds shadows: the filter, and what may change its frame among the settings of shadows.
struct ShadowKey {
    std::string filter{kNoShadows}; ///< a name of frame::shadowFilterTable(), or kNoShadows
    std::vector<KeyValue> values;   ///< in the order of the table; none that is open

    /// Null: no value.
    const std::string* text(std::string_view key) const { return valueText(values, key); }
    bool usesMaps() const;
    bool operator==(const ShadowKey&) const = default;
};

/// Of a frame with these lights.
ShadowKey shadowKeyOf(const frame::PackedLights& lights, const frame::FrameSettings& settings);

/// "pcf, 5x5, 1024 texels", without values that are the default; "no shadows".
std::string shadowText(const ShadowKey& key);

} // namespace tessera::validation
