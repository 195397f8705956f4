#include "base/PictureFile.h"

#include <cassert>
#include <future>
#include <memory>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/AtomicFile.h"

namespace tessera {
namespace {

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
    spec.attribute("Software", kPictureSoftware);
    spec.attribute("DateTime", ""); // left unset, the time of writing is added, and equal pictures give unequal files
    writeFileAtomically(path, encode("exr", spec, values.data()));
}

Png encodePng(const DisplayImage& image) {
    assert(image.isConsistent());
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", kPictureSoftware);
    return {image.width, image.height, encode("png", spec, image.rgb.data())};
}

std::vector<Png> encodePngs(std::span<const DisplayImage> images) {
    std::vector<std::future<Png>> encoding;
    for (const DisplayImage& image : images)
        encoding.push_back(std::async(std::launch::async, [&image] { return encodePng(image); }));
    std::vector<Png> pngs;
    for (std::future<Png>& png : encoding) pngs.push_back(png.get());
    return pngs;
}

void writePng(const std::string& path, const DisplayImage& image) {
    writeFileAtomically(path, encodePng(image).bytes);
}

} // namespace tessera
