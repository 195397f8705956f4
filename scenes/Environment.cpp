#include "scenes/Environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Extension.h"
#include "base/Names.h"
#include "base/Srgb.h"
#include "scenes/AveragedMap.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "scenes/builtin/Environments.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

constexpr std::array kEnvironments = {
    BuiltinEnvironment{"studio", "soft boxes in a grey studio: shows what a model is like", builtin::makeStudio},
    BuiltinEnvironment{"sky", "a clear sky with its sun, over plain ground", builtin::makeSky},
};

/// What a built-in map takes: its texels, and what it is computed from.
constexpr std::uint64_t kBuiltinBytes =
    std::uint64_t(builtin::kMapWidth) * std::uint64_t(builtin::kMapHeight) * sizeof(glm::vec4) + (2u << 20);

/// RGBA of fp32.
template <typename Code>
std::vector<std::byte> linearTexels(const Image& image) {
    std::array<float, std::size_t{std::numeric_limits<Code>::max()} + 1> linear{};
    constexpr double kWhite = std::numeric_limits<Code>::max();
    for (std::size_t code = 0; code < linear.size(); ++code)
        linear[code] = float(linearFromSrgb(double(code) / kWhite));
    std::vector<std::byte> texels(image.texels.size() / sizeof(Code) * sizeof(float));
    for (std::size_t i = 0; i < image.texels.size() / sizeof(Code); ++i) {
        Code code;
        std::memcpy(&code, image.texels.data() + i * sizeof(Code), sizeof(Code));
        std::memcpy(texels.data() + i * sizeof(float), &linear[code], sizeof(float));
    }
    return texels;
}

std::uint64_t bytesAsFloat(int width, int height) {
    return std::uint64_t(width) * std::uint64_t(height) * texelBytes(TexelFormat::Rgba32Float);
}

/// The same picture in linear fp32. Pictures of whole numbers are taken as sRGB, which they are meant for.
Image asFloat(Image image, LoadLedger& ledger) {
    if (image.format == TexelFormat::Rgba32Float) return image;
    ledger.charge(bytesAsFloat(image.width, image.height), [&] { return image.name; });
    image.texels = image.format == TexelFormat::Rgba8Unorm ? linearTexels<std::uint8_t>(image)
                                                           : linearTexels<std::uint16_t>(image);
    image.format = TexelFormat::Rgba32Float;
    return image;
}

struct Replaced {
    std::size_t nans = 0, negative = 0, infinite = 0, tooBright = 0;
};

/// In place, since a map may take gigabytes.
Replaced replacedIn(Image& map) {
    const std::size_t numbers = map.texels.size() / sizeof(float);
    const auto numberAt = [&](std::size_t i) {
        float number;
        std::memcpy(&number, map.texels.data() + i * sizeof(float), sizeof(float));
        return number;
    };
    float brightest = 0.0f;
    for (std::size_t i = 0; i < numbers; ++i)
        if (const float number = numberAt(i); i % 4 != 3 && std::isfinite(number))
            brightest = std::max(brightest, number);
    brightest = std::min(brightest, kMostRadiance);
    Replaced replaced;
    for (std::size_t i = 0; i < numbers; ++i) {
        float value = numberAt(i);
        if (i % 4 == 3) {
            value = 1.0f;
        } else if (std::isnan(value)) {
            value = 0.0f;
            ++replaced.nans;
        } else if (value < 0.0f) {
            value = 0.0f;
            ++replaced.negative;
        } else if (std::isinf(value)) {
            value = brightest > 0.0f ? brightest : 1.0f;
            ++replaced.infinite;
        } else if (value > kMostRadiance) {
            value = kMostRadiance;
            ++replaced.tooBright;
        }
        std::memcpy(map.texels.data() + i * sizeof(float), &value, sizeof(float));
    }
    return replaced;
}

std::string numbersText(std::size_t count) {
    return count == 1 ? "1 number" : fmt::format("{} numbers", count);
}

void warn(const Image& map, const std::string& what, std::vector<std::string>& warnings) {
    warnings.push_back(fmt::format("the environment '{}' {}", map.name, what));
}

void warnOfShape(const Image& map, std::vector<std::string>& warnings) {
    // A map of one texel is the same everywhere.
    if (map.width != 2 * map.height && map.width * map.height > 1)
        warn(map,
             fmt::format("is {}x{} texels, not twice as wide as high, and is stretched around the scene", map.width,
                         map.height),
             warnings);
}

/// Called when no number is left that would spread.
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
        return builtin.makeMap();
    }
    throw InputError(fmt::format("there is no built-in environment '{}'; {}", name, suggestNames(name, names)));
}

} // namespace

std::span<const BuiltinEnvironment> builtinEnvironments() {
    return kEnvironments;
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

void replaceNoLight(Image& picture, std::vector<std::string>& warnings) {
    const Replaced replaced = replacedIn(picture);
    const auto tell = [&](std::size_t count, std::string_view found, std::string_view taken) {
        if (count > 0) warn(picture, fmt::format("{} in {}, taken as {}", found, numbersText(count), taken), warnings);
    };
    tell(replaced.nans, "holds NaN", "0");
    tell(replaced.negative, "is below 0", "0");
    tell(replaced.infinite, "holds infinity", "its brightest");
    tell(replaced.tooBright, fmt::format("is above {:g}", kMostRadiance), "that");
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
    Image image = readImage(file, ledger);
    image.name = file.filename().string();
    const bool hasFewBits = image.format != TexelFormat::Rgba32Float;
    environment.map = asFloat(std::move(image), ledger);
    if (hasFewBits)
        warn(environment.map,
             "holds no light brighter than white: lamps and the sun are lost; give an .hdr or .exr file", warnings);
    replaceNoLight(environment.map, warnings);
    warnOfShape(environment.map, warnings);
    averageIfLarge(environment.map, ledger, warnings);
    ledger.settle(mark, environment.map.texels.size());
    return environment;
}

} // namespace tessera::scenes
