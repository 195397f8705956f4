#pragma once
#include <optional>
#include <string_view>

namespace tessera::shaders {

/// Returns the source of an embedded shader file by its path below shaders/; std::nullopt if there is none.
std::optional<std::string_view> embeddedShader(std::string_view path);

} // namespace tessera::shaders
