#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/PreparedView.h"
#include "scenes/Scene.h"

/// Methods that a matrix varies, each with its settings: rows of engine::settingTable().
namespace tessera::validation {

enum class MethodKind : std::uint8_t { Shadows, Subsurface, Environment, AreaLights, Count };
inline constexpr std::size_t kMethodKinds = std::size_t(MethodKind::Count);

/// Name of the shadow method without shadows.
inline constexpr std::string_view kNoShadows = "none";

struct SettingValue {
    std::string_view key; ///< of engine::Setting
    std::string text;     ///< as the setting reads it
    bool operator==(const SettingValue&) const = default;
};

/// A point's method of one kind, and those of its settings that may change the frame.
struct MethodKey {
    std::string name;
    std::vector<SettingValue> values{}; ///< in table order; without unset ones

    /// The value of a setting; null if it has none.
    const std::string* text(std::string_view key) const;
    bool operator==(const MethodKey&) const = default;
};

/// One key per kind; unset if no method of the kind would change the frame.
using MethodKeys = std::array<std::optional<MethodKey>, kMethodKinds>;

/// The inputs that determine a frame's methods.
struct MethodFacts {
    const scenes::Scene& scene;
    const frame::FrameSettings& settings;
    const frame::PreparedView& prepared;
};

struct MethodSetting {
    std::string_view key;    ///< of the settings, the matrix and the record
    std::string_view format; ///< of a value in a point's name
    bool (*matters)(const MethodFacts& facts);
    std::string_view absent;      ///< why a point has no value
    bool decidesMapsOnly = false; ///< affects only the faces of shadow maps
};

struct MethodKindInfo {
    MethodKind kind;
    std::string_view key;                 ///< of the matrix and the record
    std::string_view setting;             ///< that a method's name sets
    std::string_view title;               ///< of a column
    std::string_view prefix;              ///< of methodText()
    std::string_view off;                 ///< the method without effect; empty: there is none
    std::string_view offText;             ///< methodText() of it
    std::string_view absent;              ///< why a point has no method
    std::string_view markKind, markWords; ///< of plots with a mark per method: its name, and what shapes mean
    std::vector<std::string_view> (*names)();
    std::span<const MethodSetting> settings;
    bool (*isUsed)(const MethodFacts& facts);
    std::string (*nameOf)(const MethodFacts& facts);
    std::string_view offSetting{}; ///< that `off` sets; empty: `setting`
    std::string_view offAbsent{};  ///< why `off` has no settings; empty: MethodSetting::absent
};
std::span<const MethodKindInfo> methodKindTable();
const MethodKindInfo& infoOf(MethodKind kind);

/// The key of a frame's method, whether or not the frame uses it.
MethodKey methodKeyOf(MethodKind kind, const MethodFacts& facts);

/// "pcf, 5x5, 1024 texels", "environment sampled, samples 16", without values that are the default; "no shadows".
std::string methodText(MethodKind kind, const MethodKey& key);
/// methodText() of all keys that are set.
std::vector<std::string> methodTexts(const MethodKeys& keys);

/// Whether a shadow method uses shadow maps.
bool usesMaps(const MethodKey& shadows);

} // namespace tessera::validation
