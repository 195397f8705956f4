#include "shaders/Embedded.h"

#include "embeddedShaders.gen.h"

namespace tessera::shaders {

std::optional<std::string_view> embeddedShader(std::string_view path) {
    for (const EmbeddedFile& file : embeddedShaders())
        if (file.path == path) return file.text;
    return std::nullopt;
}

} // namespace tessera::shaders
