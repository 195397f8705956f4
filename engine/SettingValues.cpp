#include "engine/SettingValues.h"

namespace tessera::engine {

using frame::FrameSettings;

std::string numberText(double value) {
    return fmt::format("{}", value);
}
std::string numberText(int value) {
    return fmt::format("{}", value);
}
std::string numberText(float value) {
    const std::string text = fmt::format("{}", value);
    // Read as a double and rounded to single, text beside the middle of two floats may end up at the other one.
    return static_cast<float>(parsed<double>(text).value_or(0.0)) == value ? text
                                                                           : numberText(static_cast<double>(value));
}

int wholeNumber(const std::string& text, const TextSource& source) {
    if (const std::optional<int> value = parsed<int>(text)) return *value;
    throw InputError(fmt::format("{} '{}' is not a whole number, such as 8", source.called, text));
}

void requireBounds(const NumberKind& kind, double value, const TextSource& source) {
    if (value >= kind.least && value <= kind.most) return;
    const std::string bounds = std::isinf(kind.most)    ? fmt::format("{} or more", kind.least)
                               : std::isinf(kind.least) ? fmt::format("{} or less", kind.most)
                                                        : fmt::format("{} to {}", kind.least, kind.most);
    throw InputError(fmt::format("{} {} is {} {}; give {}", source.called, value,
                                 value < kind.least ? "below" : "above", value < kind.least ? kind.least : kind.most,
                                 bounds));
}

SettingValue onOff(bool FrameSettings::*member) {
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        if (text == "on" || text == "off") return text == "on";
        constexpr std::string_view kNames[] = {"on", "off"};
        throw InputError(fmt::format("unknown {} '{}': {}", source.called, text, suggestNames(text, kNames)));
    };
    return valueIn(
        in(member), SwitchKind{}, [](bool isOn) { return std::string(isOn ? "on" : "off"); }, valueOf);
}

SettingValue pictureSize() {
    const auto textOf = [](const glm::ivec2& size) { return fmt::format("{}x{}", size.x, size.y); };
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        if (const std::optional<glm::ivec2> size = frame::sizeIn(text)) return *size;
        throw InputError(fmt::format("{} '{}' is not WIDTHxHEIGHT in pixels, each 1 to {}, as in 1280x720",
                                     source.called, text, frame::kLargestSidePixels));
    };
    return valueIn(in(&FrameSettings::sizePixels), SizeKind{}, textOf, valueOf);
}

} // namespace tessera::engine
