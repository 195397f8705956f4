#include "scenes/import/GltfContext.h"

#include <fmt/format.h>

namespace tessera::scenes::gltf {

void Context::warn(const std::string& text) {
    std::string line = fmt::format("{}: {}", document.file, text);
    if (warned.insert(line).second) scene.warnings.push_back(std::move(line));
}

std::string nameOr(const std::string& name, const char* kind, int index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

} // namespace tessera::scenes::gltf
