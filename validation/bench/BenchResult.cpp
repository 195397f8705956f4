#include "validation/bench/BenchResult.h"

#include <filesystem>

#include <fmt/format.h>

#include "renderer/frame/LightBuffer.h"

namespace tessera::validation {

std::string pointName(const PointKey& key) {
    std::string name = key.technique;
    if (key.tilePixels) name += fmt::format(", {} {}", key.culling, *key.tilePixels);
    name += ", " + key.layout;
    if (key.isLitByCompute()) name += ", compute";
    if (key.rangeTolerance > 0.0) name += fmt::format(", range {:g}", key.rangeTolerance);
    for (const std::string& text : methodTexts(key.methods)) name += ", " + text;
    return name;
}

std::string groupName(const BenchGroup& group) {
    return fmt::format("{} with {} at {}x{}", std::filesystem::path(group.scene).filename().string(),
                       frame::lightsText(std::size_t(group.lights)), group.sizePixels.x, group.sizePixels.y);
}

} // namespace tessera::validation
