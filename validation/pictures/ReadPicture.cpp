#include "validation/pictures/ReadPicture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/PictureLibrary.h"
#include "base/Srgb.h"
#include "scenes/import/Importers.h"

namespace tessera::validation {
namespace {

/// The RGBA of a texel; integer formats are scaled to 0..1.
glm::vec4 texelAt(const scenes::Image& image, std::size_t index) {
    const auto numbers = [&]<typename T>(T one) {
        T texel[4];
        std::memcpy(texel, image.texels.data() + index * sizeof(texel), sizeof(texel));
        return glm::vec4(float(texel[0]), float(texel[1]), float(texel[2]), float(texel[3])) / float(one);
    };
    switch (image.format) {
    case scenes::TexelFormat::Rgba8Unorm:
        return numbers(std::uint8_t{0xff});
    case scenes::TexelFormat::Rgba16Unorm:
        return numbers(std::uint16_t{0xffff});
    case scenes::TexelFormat::Rgba32Float:
        return numbers(1.f);
    }
    return glm::vec4(0.f);
}

} // namespace

Picture readPicture(const std::string& path, scenes::LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    const scenes::DecodedPicture decoded = scenes::readPicture(path, ledger);
    Picture picture;
    picture.width = decoded.image.width;
    picture.height = decoded.image.height;
    picture.isInteger = decoded.image.format != scenes::TexelFormat::Rgba32Float;
    const std::uint64_t bytes = picture.pixelCount() * (4 * sizeof(float) + 1);
    ledger.charge(bytes, [&] { return path + ": the picture to compare with"; });
    picture.rgba.resize(4 * picture.pixelCount());
    picture.covered.resize(picture.pixelCount());
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        const glm::vec4 texel = texelAt(decoded.image, i);
        picture.covered[i] = texel.a > 0.f;
        for (glm::length_t c = 0; c < 3; ++c)
            picture.rgba[4 * i + std::size_t(c)] =
                decoded.tags.isLinear ? texel[c] : float(linearFromSrgb(double(texel[c])));
    }
    const bool isOurs = decoded.tags.software == kPictureSoftware;
    if (!isOurs && std::ranges::find(picture.covered, 1) == picture.covered.end())
        std::ranges::fill(picture.covered, std::uint8_t{1});
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) picture.rgba[4 * i + 3] = picture.covered[i] ? 1.f : 0.f;
    ledger.settle(mark, bytes);
    return picture;
}

} // namespace tessera::validation
