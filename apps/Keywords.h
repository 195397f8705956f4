#pragma once
#include <span>
#include <string>
#include <string_view>

#include "apps/Request.h"

/// The options of a frame as keywords of a script. A keyword is a flag of the command line in words: "--cull-on" is
/// cull_on.
namespace tessera::app {

/// The keyword of a flag: "--range-tolerance" is "range_tolerance".
std::string keywordOf(std::string_view flag);

/// A message in which every flag is the keyword: "check --eye" is "check eye". Names of files and quoted words stay,
/// and so does "--" within a word.
std::string withKeywords(std::string_view message);

/// What an option that is no setting takes.
enum class KeywordKind : std::uint8_t { WholeNumber, Number, Switch, Text, TextOrNumber, Point, Hooks };

/// An option that says how a scene is loaded, or moves its camera: a row a keyword. Settings are keywords too.
struct LoadKeyword {
    std::string_view keyword;
    KeywordKind kind;
    std::string_view help;
};
std::span<const LoadKeyword> loadKeywords();

/// The most that a script may say of one such option; what its kind takes alone is looked at.
struct KeywordValue {
    double number = 0.0; ///< WholeNumber, Number
    bool isOn = false;   ///< Switch
    std::string text{};  ///< Text, TextOrNumber
    glm::dvec3 point{0.0};
    std::vector<scenes::HookValue> hooks{};
};
/// Takes a value over into the options. Throws InputError where it is none that the command line would take.
void takeKeyword(std::string_view keyword, const KeywordValue& value, FrameOptions& options);

/// "did you mean 'exposure'?": the end of a message on a word that is no keyword. `further` are those of one function.
std::string suggestKeywords(std::string_view word, std::span<const std::string_view> further = {});

} // namespace tessera::app
