#pragma once
#include <span>
#include <string>
#include <string_view>

#include "apps/Request.h"

/// Frame options as keywords of scripts. A keyword is a command-line flag written as an identifier: "--cull-on" is
/// cull_on.
namespace tessera::app {

/// The keyword of a flag: "--range-tolerance" is "range_tolerance".
std::string keywordOf(std::string_view flag);

/// Replaces the flags in a message by keywords: "check --eye" becomes "check eye". File names, quoted words and "--"
/// within a word are kept.
std::string withKeywords(std::string_view message);

/// Value type of an option that is not a setting.
enum class KeywordKind : std::uint8_t { WholeNumber, Number, Switch, Text, TextOrNumber, Point, Hooks };

/// A keyword that controls scene loading or moves the camera. Settings are keywords too.
struct LoadKeyword {
    std::string_view keyword;
    KeywordKind kind;
    std::string_view help;
};
std::span<const LoadKeyword> loadKeywords();

/// Value of a load keyword; only the fields of its kind are read.
struct KeywordValue {
    double number = 0.0; ///< WholeNumber, Number
    bool isOn = false;   ///< Switch
    std::string text{};  ///< Text, TextOrNumber
    glm::dvec3 point{0.0};
    std::vector<scenes::HookValue> hooks{};
};
/// Stores a value in the options. Throws InputError for values that the command line would refuse.
void takeKeyword(std::string_view keyword, const KeywordValue& value, FrameOptions& options);

/// End of a message on an unknown keyword: "did you mean 'exposure'?". `further`: additional keywords of one function.
std::string suggestKeywords(std::string_view word, std::span<const std::string_view> further = {});

} // namespace tessera::app
