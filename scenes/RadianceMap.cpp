#include "scenes/RadianceMap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "base/Srgb.h"
#include "scenes/Environment.h"
#include "scenes/LoadLedger.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

/// Converts sRGB texels to linear RGBA in fp32.
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

/// Converts an image to linear fp32. Integer formats are assumed to be sRGB.
Image asFloat(Image image, LoadLedger& ledger) {
    if (image.format == TexelFormat::Rgba32Float) return image;
    ledger.charge(std::uint64_t(image.width) * std::uint64_t(image.height) * texelBytes(TexelFormat::Rgba32Float),
                  [&] { return image.name; });
    image.texels = image.format == TexelFormat::Rgba8Unorm ? linearTexels<std::uint8_t>(image)
                                                           : linearTexels<std::uint16_t>(image);
    image.format = TexelFormat::Rgba32Float;
    return image;
}

std::string numbersText(std::size_t count) {
    return count == 1 ? "1 number" : fmt::format("{} numbers", count);
}

} // namespace

Replaced replaceNoLight(Image& map) {
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

RadianceMap readRadianceMap(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    RadianceMap map;
    Image image = readPicture(file, ledger).image; // its RGB is radiance, whatever its alpha
    image.name = file.filename().string();
    map.hasFewBits = image.format != TexelFormat::Rgba32Float;
    map.image = asFloat(std::move(image), ledger);
    ledger.settle(mark, map.image.texels.size());
    map.replaced = replaceNoLight(map.image);
    return map;
}

void warnOfReplaced(const std::string& who, const Replaced& replaced, std::vector<std::string>& warnings) {
    const auto warn = [&](const std::string& what) { warnings.push_back(who + ' ' + what); };
    if (replaced.nans > 0) warn(fmt::format("holds NaN in {}, taken as 0", numbersText(replaced.nans)));
    if (replaced.negative > 0) warn(fmt::format("is below 0 in {}, taken as 0", numbersText(replaced.negative)));
    if (replaced.infinite > 0)
        warn(fmt::format("holds infinity in {}, taken as its brightest", numbersText(replaced.infinite)));
    if (replaced.tooBright > 0)
        warn(fmt::format("is above {:g} in {}, taken as that", kMostRadiance, numbersText(replaced.tooBright)));
}

} // namespace tessera::scenes
