#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// Parses a JSON document; the ledger is charged for it. Throws InputError: "file:line:column: what" for broken syntax,
/// NaN and comments among it, and for numbers too large for a double; "file:/json/pointer: what" for a key that an
/// object has twice; "file: what" for a document that nests too deep.
nlohmann::json parseJson(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger);

/// Far deeper than any document here nests; printing and converting JSON recurse, so depth must not be the file's to
/// choose.
inline constexpr int kMaxJsonDepth = 64;

/// Throws InputError where brackets of a text nest deeper than kMaxJsonDepth. The library's own way to ask, a callback
/// for each value, looks through all of an array for every element.
void requireJsonDepth(std::string_view text, const std::filesystem::path& file);

struct MendedJson {
    std::string text;
    int line = 0; ///< of the first flaw; 0: none was found
    std::string flaw;
};
/// Replaces what programs write although JSON does not have it: words and numbers that are none of its values, such as
/// NaN, -inf and 1.#IND, by null; comments, and commas before a closing bracket, by blanks.
MendedJson mendedJson(std::string_view text);

/// Upper bound of the memory of a parsed document of this text.
std::uint64_t parsedJsonBytes(std::string_view text);

/// `pointer` with one more step. Source: RFC 6901, "JSON Pointer".
std::string jsonPointerTo(const std::string& pointer, std::string_view key);

} // namespace tessera::scenes
