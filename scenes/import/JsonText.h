#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace tessera::scenes {

/// Parses a JSON document. Throws InputError "file:line:column: what" for broken syntax (NaN and comments are none of
/// JSON's) and numbers too large for a double, "file:/json/pointer: what" for a key that an object has twice.
nlohmann::json parseJson(std::string_view text, const std::filesystem::path& file);

/// `pointer` with one more step. Source: RFC 6901, "JSON Pointer".
std::string jsonPointerTo(const std::string& pointer, std::string_view key);

} // namespace tessera::scenes
