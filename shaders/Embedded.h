#pragma once
#include <optional>
#include <string_view>

namespace tessera::shaders {

/// The text of a shader file compiled into the library, by its path below shaders/; none when there is no such file.
std::optional<std::string_view> embeddedShader(std::string_view path);

} // namespace tessera::shaders
