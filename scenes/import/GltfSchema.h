#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

/// The part of the glTF 2.0 schema that the importer reads, as a table of rules.
namespace tessera::scenes::gltf {

enum class Kind { Object, Array, Integer, Number, Numbers, String, Boolean, Index, Choice, IntegerChoice };

inline constexpr double kAny = std::numeric_limits<double>::max();
inline constexpr double kMaxInteger = 9007199254740992.0; ///< 2^53: JSON numbers are exact to here

/// What must hold at a path. Path segments: a key, "*" (every array element) or "@" (every value of an object). A path
/// that begins with '!' is required wherever its parent is. `choices` names the array that an Index counts in, or the
/// values allowed, separated by '|'.
struct Rule {
    std::string_view path;
    Kind kind;
    double min = -kAny;
    double max = kAny;
    std::string_view choices = {};
    std::size_t length = 0; ///< Numbers: exactly so many
};

/// Rules whose paths start at the document.
std::span<const Rule> documentRules();

/// The places where a material uses a texture, and the rules of each; these rules' paths start there.
std::span<const std::string_view> textureInfoPlaces();
std::span<const Rule> textureInfoRules();

} // namespace tessera::scenes::gltf
