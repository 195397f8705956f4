#include "scenes/Environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Extension.h"
#include "base/Names.h"
#include "scenes/AveragedMap.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "scenes/RadianceMap.h"
#include "scenes/builtin/Environments.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

constexpr std::array kEnvironments = {
    BuiltinEnvironment{"studio", "soft boxes in a grey studio: shows what a model is like", builtin::makeStudio},
    BuiltinEnvironment{"sky", "a clear sky with its sun, over plain ground", builtin::makeSky},
};

/// Memory of a built-in map: its texels and intermediate tables.
constexpr std::uint64_t kBuiltinBytes =
    std::uint64_t(builtin::kMapWidth) * std::uint64_t(builtin::kMapHeight) * sizeof(glm::vec4) + (2u << 20);

/// `map` is Rgba32Float without negative numbers.
bool isBlack(const Image& map) {
    for (std::size_t offset = 0; offset < map.texels.size(); offset += sizeof(glm::vec4)) {
        glm::vec3 texel;
        std::memcpy(&texel, map.texels.data() + offset, sizeof(texel));
        if (texel != glm::vec3(0.0f)) return false;
    }
    return true;
}

void warnOfMap(const RadianceMap& map, std::vector<std::string>& warnings) {
    const std::string who = fmt::format("the environment '{}'", map.image.name);
    if (map.hasFewBits)
        warnings.push_back(who + " holds no light brighter than white: lamps and the sun are lost; give an .hdr or "
                                 ".exr file");
    warnOfReplaced(who, map.replaced, warnings);
    const Image& image = map.image;
    if (isBlack(image)) warnings.push_back(who + " is black everywhere and gives no light");
    // A map of one texel is uniform.
    if (image.width != 2 * image.height && image.width * image.height > 1)
        warnings.push_back(fmt::format("{} is {}x{} texels, not twice as wide as high, and is stretched around the "
                                       "scene",
                                       who, image.width, image.height));
}

std::uint64_t bytesAsFloat(int width, int height) {
    return std::uint64_t(width) * std::uint64_t(height) * texelBytes(TexelFormat::Rgba32Float);
}

/// Called after invalid numbers are replaced, which averaging would spread.
void averageIfLarge(Image& map, LoadLedger& ledger, std::vector<std::string>& warnings) {
    const int width = std::min(map.width, kMostMapWidth), height = std::min(map.height, kMostMapHeight);
    if (width == map.width && height == map.height) return;
    ledger.charge(bytesAsFloat(width, height), [&] { return map.name; });
    warnings.push_back(averagedText(map.name, map.width, map.height, width, height));
    map = averagedMap(map, width, height);
}

Image builtinMap(const std::string& name, LoadLedger& ledger) {
    std::vector<std::string_view> names;
    for (const BuiltinEnvironment& builtin : kEnvironments) {
        names.push_back(builtin.name);
        if (builtin.name != name) continue;
        ledger.charge(kBuiltinBytes, [&] { return name; });
        return builtin.makeMap(ledger.environmentProgress());
    }
    throw InputError(fmt::format("there is no built-in environment '{}'; {}", name, suggestNames(name, names)));
}

} // namespace

std::span<const BuiltinEnvironment> builtinEnvironments() {
    return kEnvironments;
}

EnvironmentView asSeen(const EnvironmentView& own, const EnvironmentView& view) {
    const double intensity = double(own.intensity) * double(view.intensity);
    return {float(double(own.rotationDegrees) + double(view.rotationDegrees)),
            float(std::min(intensity, double(kMostRadiance)))};
}

glm::dvec2 placeInMap(const glm::dvec3& direction) {
    const double longitude = std::atan2(direction.x, -direction.z);
    return {0.5 + longitude / (2.0 * std::numbers::pi),
            std::acos(std::clamp(direction.y, -1.0, 1.0)) / std::numbers::pi};
}

glm::dvec3 directionInMap(const glm::dvec2& place) {
    const double longitude = (place.x - 0.5) * 2.0 * std::numbers::pi, fromTop = place.y * std::numbers::pi;
    const double sine = std::sin(fromTop);
    return {sine * std::sin(longitude), std::cos(fromTop), -sine * std::cos(longitude)};
}

std::string averagedText(const std::string& name, int width, int height, int keptWidth, int keptHeight) {
    return fmt::format("the environment '{}' has {}x{} texels; their averages in {}x{} are shown, {} of the GPU", name,
                       width, height, keptWidth, keptHeight, sizeText(bytesAsFloat(keptWidth, keptHeight)));
}

Environment loadEnvironment(const std::string& source, LoadLedger& ledger, std::vector<std::string>& warnings) {
    Environment environment;
    environment.source = source;
    if (source.starts_with(kBuiltinPrefix)) {
        environment.map = builtinMap(source.substr(kBuiltinPrefix.size()), ledger);
        return environment;
    }
    const std::uint64_t mark = ledger.usedBytes();
    const std::filesystem::path file = std::filesystem::absolute(source).lexically_normal();
    if (const std::string extension = extensionOf(file); extension == ".gltf" || extension == ".glb")
        return importGltfEnvironment(file, ledger, warnings);
    environment.source = file.string();
    RadianceMap map = readRadianceMap(file, ledger);
    warnOfMap(map, warnings);
    environment.map = std::move(map.image);
    averageIfLarge(environment.map, ledger, warnings);
    ledger.settle(mark, environment.map.texels.size());
    return environment;
}

} // namespace tessera::scenes
