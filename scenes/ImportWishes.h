#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/EnumTable.h"

namespace tessera::scenes {

/// What the numbers of a model's lights count: candela and lux, of which 683 make a watt, or watts themselves.
enum class LightUnits : std::uint8_t { Lumen, Watt, Count };
struct LightUnitsInfo {
    LightUnits units;
    std::string_view name;
};
inline constexpr std::array kLightUnits{LightUnitsInfo{LightUnits::Lumen, "lumen"},
                                        LightUnitsInfo{LightUnits::Watt, "watt"}};
static_assert(isInOrder(kLightUnits, &LightUnitsInfo::units, std::size_t(LightUnits::Count)));
/// Of monochromatic light at 540 THz, by the definition of the candela.
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

/// How models are to be read, where a command says it. It holds for every model of a load, also for those that a scene
/// file names.
struct ImportWishes {
    bool isStrict = false;                ///< a flaw that can be repaired refuses its model; else a warning names it
    std::optional<std::string> variant;   ///< shown of the models that have one of this name (KHR_materials_variants)
    std::optional<LightUnits> lightUnits; ///< of glTF models; none: as their exporter is known to write them
    ObjColours objColours = ObjColours::Srgb;
    bool operator==(const ImportWishes&) const = default;
};

} // namespace tessera::scenes
