#include "scenes/import/GltfContext.h"

#include <algorithm>

#include <fmt/format.h>

namespace tessera::scenes::gltf {

void Context::warn(const std::string& text) {
    std::string line = fmt::format("{}: {}", document.file, text);
    if (std::ranges::find(scene.warnings, line) == scene.warnings.end()) scene.warnings.push_back(std::move(line));
}

std::string nameOr(const std::string& name, const char* kind, int index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

} // namespace tessera::scenes::gltf
