#include "validation/PictureFile.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "scenes/Error.h"
#include "scenes/import/Importers.h"
#include "validation/AtomicFile.h"
#include "validation/Srgb.h"

namespace tessera::validation {
namespace {

constexpr const char* kSoftware = "tessera";

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find_first_of("\r\n"));
}

std::vector<std::uint8_t> encode(const char* format, const OIIO::ImageSpec& spec, const void* pixels) {
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &proxy);
    if (!output)
        throw std::runtime_error(
            fmt::format("this OpenImageIO cannot write {}: {}", format, firstLine(OIIO::geterror())));
    if (!output->open(format, spec) || !output->write_image(spec.format, pixels) || !output->close())
        throw std::runtime_error(fmt::format("cannot encode {}: {}", format, firstLine(output->geterror())));
    return bytes;
}

void refuseWhatCannotBeCompared(const std::string& path, const scenes::PictureTags& tags) {
    if (tags.isCropped)
        throw InputError(fmt::format("{}: its data window is not its display window; save it uncropped", path));
    if (tags.orientation != 1)
        throw InputError(fmt::format("{}: its Orientation tag is {}; save it upright, with 1", path, tags.orientation));
}

/// A texel's four numbers: 0..1 where they are integers.
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

void writeExr(const std::string& path, const Picture& picture) {
    assert(picture.isConsistent());
    std::vector<float> values = picture.rgba;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) values[4 * i + 3] = picture.covered[i] ? 1.f : 0.f;

    OIIO::ImageSpec spec(picture.width, picture.height, 4, OIIO::TypeDesc::FLOAT);
    // ITU-R BT.709 red, green, blue and the D65 white, as x y pairs.
    const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
    spec.attribute("Software", kSoftware);
    spec.attribute("DateTime", ""); // left unset, the time of writing is added, and equal pictures give unequal files
    writeFileAtomically(path, encode("exr", spec, values.data()));
}

std::vector<std::uint8_t> encodePng(const DisplayImage& image) {
    assert(image.isConsistent());
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", kSoftware);
    return encode("png", spec, image.rgb.data());
}

void writePng(const std::string& path, const DisplayImage& image) {
    writeFileAtomically(path, encodePng(image));
}

Picture readPicture(const std::string& path, scenes::LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    const scenes::DecodedPicture decoded = scenes::readPicture(path, ledger);
    refuseWhatCannotBeCompared(path, decoded.tags);

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
    const bool isOurs = decoded.tags.software == kSoftware;
    if (!isOurs && std::ranges::find(picture.covered, 1) == picture.covered.end())
        std::ranges::fill(picture.covered, std::uint8_t{1});
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) picture.rgba[4 * i + 3] = picture.covered[i] ? 1.f : 0.f;
    ledger.settle(mark, bytes);
    return picture;
}

} // namespace tessera::validation
