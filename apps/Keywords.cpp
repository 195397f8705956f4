#include "apps/Keywords.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Names.h"

namespace tessera::app {

namespace {

using Take = void (*)(const KeywordValue& value, FrameOptions& options);
struct LoadKeywordRow : LoadKeyword {
    Take take;
};

constexpr std::array kLoadKeywords{
    LoadKeywordRow{
        {"lights", KeywordKind::WholeNumber, "Built-in scenes make this many lights, files keep their first so many"},
        [](const KeywordValue& value, FrameOptions& options) { options.lights = int(value.number); }},
    LoadKeywordRow{{"default_light", KeywordKind::Switch, "False leaves a scene without lights dark"},
                   [](const KeywordValue& value, FrameOptions& options) { options.noDefaultLight = !value.isOn; }},
    LoadKeywordRow{{"environment", KeywordKind::Text,
                    "Lights the scene from all directions: none, a built-in one's name, a picture in latitude and "
                    "longitude, or a glTF model with an image-based light"},
                   [](const KeywordValue& value, FrameOptions& options) { options.environment = value.text; }},
    LoadKeywordRow{{"background", KeywordKind::Point,
                    "Linear radiance behind the scene where no environment is seen: red, green, blue"},
                   [](const KeywordValue& value, FrameOptions& options) { options.background = value.point; }},
    LoadKeywordRow{
        {"clip", KeywordKind::TextOrNumber, "The clip of the scene that plays, by name or counted from 0, or none"},
        [](const KeywordValue& value, FrameOptions& options) { options.clip = value.text; }},
    LoadKeywordRow{{"hook", KeywordKind::Hooks, "Parameters of the scene's hook, by name, within their bounds"},
                   [](const KeywordValue& value, FrameOptions& options) { options.hookValues = value.hooks; }},
    LoadKeywordRow{{"memory_limit", KeywordKind::TextOrNumber,
                    "The most memory that reading a scene may take: bytes, or a text such as 4G"},
                   [](const KeywordValue& value, FrameOptions& options) { options.memoryLimit = value.text; }},
    LoadKeywordRow{{"variant", KeywordKind::Text, "Shows the models in this variant of their materials"},
                   [](const KeywordValue& value, FrameOptions& options) { options.import.variant = value.text; }},
    LoadKeywordRow{{"light_units", KeywordKind::Text, "What the numbers of a glTF model's lights count: lumen or watt"},
                   [](const KeywordValue& value, FrameOptions& options) {
                       options.import.lightUnits = lightUnitsNamed(value.text);
                   }},
    LoadKeywordRow{{"obj_colours", KeywordKind::Text, "The encoding of vertex colours of OBJ models: srgb or linear"},
                   [](const KeywordValue& value, FrameOptions& options) {
                       options.import.objColours = objColoursNamed(value.text);
                   }},
    LoadKeywordRow{{"strict", KeywordKind::Switch,
                    "True refuses a model with a flaw that can be repaired, such as a picture that cannot be read"},
                   [](const KeywordValue& value, FrameOptions& options) { options.import.isStrict = value.isOn; }},
    LoadKeywordRow{{"default_camera", KeywordKind::Switch,
                    "True shows all of the scene by the camera that one without cameras gets, in the place of its own"},
                   [](const KeywordValue& value, FrameOptions& options) { options.defaultCamera = value.isOn; }},
    LoadKeywordRow{{"eye", KeywordKind::Point, "Moves the camera there, metres in world space"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.eyeWS = value.point; }},
    LoadKeywordRow{{"target", KeywordKind::Point, "Turns the camera to look there, metres in world space"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.targetWS = value.point; }},
    LoadKeywordRow{{"up", KeywordKind::Point, "What is up in the picture, a direction in world space"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.upWS = value.point; }},
    LoadKeywordRow{{"fov", KeywordKind::Number, "Vertical field of view of a perspective camera, degrees"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.fovYDegrees = value.number; }},
    LoadKeywordRow{
        {"half_height", KeywordKind::Number, "Half the height of an orthographic camera's view, metres"},
        [](const KeywordValue& value, FrameOptions& options) { options.pose.halfHeightMetres = value.number; }},
    LoadKeywordRow{{"near", KeywordKind::Number, "Nothing nearer is drawn, metres"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.nearMetres = value.number; }},
    LoadKeywordRow{{"far", KeywordKind::Number, "Nothing farther is drawn, metres"},
                   [](const KeywordValue& value, FrameOptions& options) { options.pose.farMetres = value.number; }},
};

/// Whether a flag begins at `at`: at the start of the message, or after a space or an opening bracket.
bool beginsFlag(std::string_view message, std::size_t at) {
    const bool isBehind = at == 0 || message[at - 1] == ' ' || message[at - 1] == '(';
    return isBehind && message.substr(at).starts_with("--") && at + 2 < message.size() &&
           std::islower(static_cast<unsigned char>(message[at + 2]));
}

void requireOne(std::string_view keyword, KeywordKind kind, const KeywordValue& value) {
    using Whole = std::numeric_limits<int>;
    const auto isFinite = [](double number) { return std::isfinite(number); };
    if (kind == KeywordKind::WholeNumber &&
        !(std::trunc(value.number) == value.number && value.number >= Whole::min() && value.number <= Whole::max()))
        throw InputError(
            fmt::format("{} {} is not a whole number of at most 2147483647, such as 8", keyword, value.number));
    if (kind == KeywordKind::Number && !isFinite(value.number))
        throw InputError(fmt::format("{} {} is not a finite number, such as 1.5", keyword, value.number));
    if (kind == KeywordKind::Point && !(isFinite(value.point.x) && isFinite(value.point.y) && isFinite(value.point.z)))
        throw InputError(fmt::format("{} is not three finite numbers, such as (0, 1.5, -2)", keyword));
    if ((kind == KeywordKind::Text || kind == KeywordKind::TextOrNumber) && value.text.empty())
        throw InputError(fmt::format("{} is empty; give a value", keyword));
    for (const scenes::HookValue& hook : value.hooks)
        if (hook.name.empty() || !isFinite(hook.value))
            throw InputError(
                fmt::format("{} '{}' is not a name and a finite number, such as {{'wind': 1.5}}", keyword, hook.name));
}

} // namespace

std::string keywordOf(std::string_view flag) {
    assert(flag.starts_with("--"));
    std::string keyword(flag.substr(2));
    std::ranges::replace(keyword, '-', '_');
    return keyword;
}

std::string withKeywords(std::string_view message) {
    std::string text;
    for (std::size_t at = 0; at < message.size();) {
        if (!beginsFlag(message, at)) {
            text += message[at++];
            continue;
        }
        std::size_t end = at + 2;
        while (end < message.size() && (std::isalnum(static_cast<unsigned char>(message[end])) ||
                                        (message[end] == '-' && end + 1 < message.size() &&
                                         std::isalnum(static_cast<unsigned char>(message[end + 1])))))
            ++end;
        text += keywordOf(message.substr(at, end - at));
        at = end;
    }
    return text;
}

std::span<const LoadKeyword> loadKeywords() {
    static const std::vector<LoadKeyword> rows(kLoadKeywords.begin(), kLoadKeywords.end());
    return rows;
}

void takeKeyword(std::string_view keyword, const KeywordValue& value, FrameOptions& options) {
    const auto row = std::ranges::find(kLoadKeywords, keyword, &LoadKeywordRow::keyword);
    assert(row != kLoadKeywords.end());
    requireOne(keyword, row->kind, value);
    row->take(value, options);
}

std::string suggestKeywords(std::string_view word, std::span<const std::string_view> further) {
    std::vector<std::string> words(further.begin(), further.end());
    for (const engine::Setting& setting : engine::settingTable()) words.push_back(keywordOf(setting.flag));
    for (const LoadKeyword& row : loadKeywords()) words.emplace_back(row.keyword);
    return suggestNames(word, std::vector<std::string_view>(words.begin(), words.end()));
}

} // namespace tessera::app
