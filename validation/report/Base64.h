#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace tessera::validation {

/// Base64 with padding (RFC 4648 section 4), on one line.
std::string base64(std::span<const std::uint8_t> bytes);

} // namespace tessera::validation
