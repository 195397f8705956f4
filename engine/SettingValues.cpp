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
    // Text is read as double, then rounded to float. Near the middle of two floats that may give the other one.
    return static_cast<float>(parsed<double>(text).value_or(0.0)) == value ? text
                                                                           : numberText(static_cast<double>(value));
}

std::optional<double> wholeNumberIn(const std::string& text) {
    const bool isNegative = text.starts_with('-');
    const std::string_view digits = std::string_view(text).substr(isNegative ? 1 : 0);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    constexpr double kMost = std::numeric_limits<double>::max();
    return parsed<double>(text).value_or(isNegative ? -kMost : kMost);
}

double wholeNumber(const std::string& text, const TextSource& source) {
    if (const std::optional<double> value = wholeNumberIn(text)) return *value;
    throw InputError(fmt::format("{} '{}' is not a whole number, such as 8", source.called, text));
}

std::string boundsText(const NumberKind& kind) {
    return std::isinf(kind.most)    ? fmt::format("{} or more", kind.least)
           : std::isinf(kind.least) ? fmt::format("{} or less", kind.most)
                                    : fmt::format("{} to {}", kind.least, kind.most);
}

void requireBounds(const NumberKind& kind, double value, const TextSource& source) {
    NumberKind held = kind;
    using Whole = std::numeric_limits<int>;
    if (kind.isWhole && value < double(Whole::min())) held.least = std::max(kind.least, double(Whole::min()));
    if (kind.isWhole && value > double(Whole::max())) held.most = std::min(kind.most, double(Whole::max()));
    if (value >= held.least && value <= held.most) return;
    throw InputError(fmt::format("{} {} is {} {}; give {}", source.called, value,
                                 value < held.least ? "below" : "above", value < held.least ? held.least : held.most,
                                 boundsText(held)));
}

namespace {

SettingValue onOffIn(auto place) {
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        if (text == "on" || text == "off") return text == "on";
        constexpr std::string_view kNames[] = {"on", "off"};
        throw InputError(fmt::format("unknown {} '{}': {}", source.called, text, suggestNames(text, kNames)));
    };
    return valueIn(
        place, SwitchKind{}, [](bool isOn) { return std::string(isOn ? "on" : "off"); }, valueOf);
}

} // namespace

SettingValue onOff(bool FrameSettings::*member) {
    return onOffIn(in(member));
}
SettingValue onOff(bool frame::DiffusionSettings::*member) {
    return onOffIn(in(member));
}
SettingValue onOff(bool frame::EnvironmentSettings::*member) {
    return onOffIn(in(member));
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
