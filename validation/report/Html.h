#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tessera::validation {

/// Escapes text for HTML between tags and in quoted attributes. Bytes that are not UTF-8, and control characters that
/// HTML does not allow, become U+FFFD.
std::string escapedHtml(std::string_view text);

/// The same, but short words with a hyphen, such as options and 3.1e-11, never break there.
std::string escapedWhole(std::string_view text);

/// Base64 with padding (RFC 4648 section 4), on one line.
std::string base64(std::span<const std::uint8_t> bytes);

/// The bytes of a PNG file as a data URI.
std::string pngDataUri(std::span<const std::uint8_t> bytes);

} // namespace tessera::validation
