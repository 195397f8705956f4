#include "viewer/save/OptionText.h"

#include <fmt/format.h>

namespace tessera::viewer {
namespace {

/// An option of three numbers, bit-exact; empty if they are not given.
std::string pointText(const char* flag, const std::optional<glm::dvec3>& point) {
    return point ? fmt::format(" {} {},{},{}", flag, point->x, point->y, point->z) : std::string();
}

} // namespace

std::string shellWord(const std::string& word) {
    constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-+/=,:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'') quoted += "'\\'"; // closes the quotes, escapes this one, and reopens them
        quoted += c;
    }
    quoted += '\'';
    return quoted;
}

std::string poseText(const scenes::CameraChange& change) {
    std::string text =
        pointText("--eye", change.eyeWS) + pointText("--target", change.targetWS) + pointText("--up", change.upWS);
    const auto addNumber = [&text](const char* flag, const std::optional<double>& number) {
        if (number) text += fmt::format(" {} {}", flag, *number);
    };
    addNumber("--fov", change.fovYDegrees);
    addNumber("--half-height", change.halfHeightMetres);
    addNumber("--near", change.nearMetres);
    addNumber("--far", change.farMetres);
    return text;
}

std::string backgroundText(const std::optional<glm::dvec3>& radiance) {
    return pointText("--background", radiance);
}

std::string hookText(std::span<const scenes::HookValue> values) {
    std::string text;
    for (const scenes::HookValue& value : values)
        text += " --hook " + shellWord(fmt::format("{}={}", value.name, value.value));
    return text;
}

std::string importText(const scenes::ImportOptions& importOptions) {
    std::string text;
    if (importOptions.variant) text += " --variant " + shellWord(*importOptions.variant);
    if (importOptions.lightUnits)
        text += fmt::format(" --light-units {}", scenes::kLightUnits[std::size_t(*importOptions.lightUnits)].name);
    if (importOptions.objColours != scenes::ObjColours::Srgb)
        text += fmt::format(" --obj-colours {}", scenes::kObjColours[std::size_t(importOptions.objColours)].name);
    if (importOptions.isStrict) text += " --strict";
    return text;
}

} // namespace tessera::viewer
