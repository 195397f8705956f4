#include "validation/PictureFile.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "scenes/Error.h"
#include "validation/AtomicFile.h"
#include "validation/Srgb.h"

namespace tessera::validation {
namespace {

constexpr const char* kSoftware = "tessera";
// 16,384 x 16,384: beyond it a picture takes over 4 GiB, and a header that asks for more is nearly always a broken one.
constexpr std::uint64_t kMaxPixels = 1ull << 28;

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

/// Which channels of a file are red, green and blue.
struct ColourChannels {
    int red = 0, green = 0, blue = 0;
};

ColourChannels findColour(const OIIO::ImageSpec& spec) {
    const auto named = [&](std::string_view name) {
        for (int channel = 0; channel < spec.nchannels; ++channel)
            if (OIIO::Strutil::iequals(spec.channelnames[std::size_t(channel)], std::string(name))) return channel;
        return -1;
    };
    const ColourChannels byName{named("r"), named("g"), named("b")};
    if (byName.red >= 0 && byName.green >= 0 && byName.blue >= 0) return byName;
    const bool isGrey = spec.nchannels < 3;
    return isGrey ? ColourChannels{} : ColourChannels{0, 1, 2};
}

void refuseWhatCannotBeRead(const std::string& path, const OIIO::ImageSpec& spec) {
    const auto refuse = [&](const std::string& why) { throw InputError(fmt::format("{}: {}", path, why)); };
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
        refuse("the picture is empty; give one with pixels");
    if (std::uint64_t(spec.width) * std::uint64_t(spec.height) > kMaxPixels || spec.nchannels > 1024)
        refuse(fmt::format("{}x{} with {} channels is too large or its header is broken; at most {} pixels are read",
                           spec.width, spec.height, spec.nchannels, kMaxPixels));
    if (spec.deep) refuse("deep pictures are not read; flatten it first");
    if (spec.depth > 1) refuse("volumes are not read; give one slice");
    if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
        spec.height != spec.full_height)
        refuse("its data window is not its display window; save it uncropped");
    if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation != 1)
        refuse(fmt::format("its Orientation tag is {}; save it upright, with 1", orientation));
}

/// Reads coverage from alpha as the header of this module promises.
std::vector<std::uint8_t> coverageOf(const OIIO::ImageSpec& spec, const std::vector<float>& values,
                                     std::size_t pixelCount) {
    std::vector<std::uint8_t> covered(pixelCount, 1);
    if (spec.alpha_channel < 0) return covered;
    for (std::size_t i = 0; i < pixelCount; ++i)
        covered[i] = values[i * std::size_t(spec.nchannels) + std::size_t(spec.alpha_channel)] > 0.f;
    const bool isOurs = spec.get_string_attribute("Software") == kSoftware;
    if (!isOurs && std::find(covered.begin(), covered.end(), 1) == covered.end())
        std::fill(covered.begin(), covered.end(), std::uint8_t{1});
    return covered;
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

Picture readPicture(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw InputError(fmt::format("{}: there is no such file; check the name of the picture", path));
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(fmt::format("{}: this is a folder; name a picture in it", path));
    if (std::filesystem::file_size(path, ignored) == 0)
        throw InputError(fmt::format("{}: the file is empty; give a picture", path));

    // Alpha tells coverage here and nothing else, so colours must not be multiplied by it.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
    if (!input)
        throw InputError(fmt::format("{}: not a readable picture ({}); give EXR, HDR, PFM or PNG", path,
                                     firstLine(OIIO::geterror())));
    const OIIO::ImageSpec spec = input->spec();
    refuseWhatCannotBeRead(path, spec);

    Picture picture;
    picture.width = spec.width;
    picture.height = spec.height;
    const std::size_t channels = std::size_t(spec.nchannels);
    std::vector<float> values(picture.pixelCount() * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(fmt::format("{}: the picture is cut short or damaged ({}); write it again", path,
                                     firstLine(input->geterror())));

    const bool isEncoded = !spec.format.is_floating_point() &&
                           !OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "Linear");
    const auto linear = [&](float value) { return isEncoded ? float(linearFromSrgb(double(value))) : value; };
    const ColourChannels colour = findColour(spec);
    picture.covered = coverageOf(spec, values, picture.pixelCount());
    picture.rgba.resize(4 * picture.pixelCount());
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        const float* from = &values[i * channels];
        float* to = &picture.rgba[4 * i];
        to[0] = linear(from[colour.red]);
        to[1] = linear(from[colour.green]);
        to[2] = linear(from[colour.blue]);
        to[3] = picture.covered[i] ? 1.f : 0.f;
    }
    return picture;
}

} // namespace tessera::validation
