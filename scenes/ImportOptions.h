#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/EnumTable.h"

namespace tessera::scenes {

/// Unit of the light intensities of a model: photometric (candela and lux, 683 lm per watt), or radiometric (watts).
enum class LightUnits : std::uint8_t { Lumen, Watt, Count };
struct LightUnitsInfo {
    LightUnits units;
    std::string_view name;
};
inline constexpr std::array kLightUnits{LightUnitsInfo{LightUnits::Lumen, "lumen"},
                                        LightUnitsInfo{LightUnits::Watt, "watt"}};
static_assert(isInOrder(kLightUnits, &LightUnitsInfo::units, std::size_t(LightUnits::Count)));
/// Luminous efficacy of monochromatic light of 540 THz, by the definition of the candela.
inline constexpr double kLumensPerWatt = 683.0;

/// The encoding of vertex colours in OBJ files.
enum class ObjColours : std::uint8_t { Srgb, Linear, Count };
struct ObjColoursInfo {
    ObjColours encoding;
    std::string_view name;
};
inline constexpr std::array kObjColours{ObjColoursInfo{ObjColours::Srgb, "srgb"},
                                        ObjColoursInfo{ObjColours::Linear, "linear"}};
static_assert(isInOrder(kObjColours, &ObjColoursInfo::encoding, std::size_t(ObjColours::Count)));

/// Requested import options. They apply to every model of a load, including those named by scene files.
struct ImportOptions {
    bool isStrict = false;                ///< reject models with repairable flaws instead of warning
    std::optional<std::string> variant;   ///< material variant to use in models that have it (KHR_materials_variants)
    std::optional<LightUnits> lightUnits; ///< of glTF models; none: deduced from the exporter
    ObjColours objColours = ObjColours::Srgb;
    bool operator==(const ImportOptions&) const = default;
};

} // namespace tessera::scenes
