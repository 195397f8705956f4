#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "scenes/Error.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/Importers.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

struct Signature {
    std::string_view bytes;
    std::size_t offset;
    const char* format; ///< OpenImageIO's name of the format
};

using namespace std::string_view_literals;
constexpr Signature kSignatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, 0, "png"},
    {"\xff\xd8\xff"sv, 0, "jpeg"},
    {"\x76\x2f\x31\x01"sv, 0, "openexr"},
    {"#?"sv, 0, "hdr"},
    {"II*\0"sv, 0, "tiff"},
    {"MM\0*"sv, 0, "tiff"},
    {"GIF8"sv, 0, "gif"},
    {"WEBP"sv, 8, "webp"},
    {"BM"sv, 0, "bmp"},
    {"8BPS"sv, 0, "psd"},
    {"DDS "sv, 0, "dds"},
    {"\xabKTX 11"sv, 0, "ktx"},
    {"\xabKTX 20"sv, 0, "ktx2"},
    {"\0\0\0\x0cjP  "sv, 0, "jpeg2000"},
};

/// The formats that are decoded. OpenImageIO has many more readers, some of which crash on broken files, and some open
/// what is no picture at all; none of them is ever asked.
constexpr std::string_view kDecoded[] = {"png", "jpeg", "openexr", "hdr", "tiff", "gif", "webp", "bmp", "tga"};

/// The format by its first bytes, whatever the name says; TGA, which has no signature, by the extension of `name`.
/// Else that extension, or nothing.
std::string formatOf(std::span<const std::byte> bytes, const std::string& name) {
    for (const Signature& signature : kSignatures)
        if (bytes.size() >= signature.offset + signature.bytes.size() &&
            std::memcmp(bytes.data() + signature.offset, signature.bytes.data(), signature.bytes.size()) == 0)
            return signature.format;
    std::string extension = std::filesystem::path(name).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == "tga") return extension;
    const bool isMisnamed = std::ranges::find(kDecoded, extension) != std::end(kDecoded) || extension == "jpg" ||
                            extension == "exr" || extension == "tif";
    return isMisnamed ? std::string() : extension;
}

std::string oneLine(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

TexelFormat texelFormatOf(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
        return TexelFormat::Rgba8Unorm;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
        return TexelFormat::Rgba16Unorm;
    default:
        return TexelFormat::Rgba32Float;
    }
}

/// Spreads `channels` (1..4) stored values a texel to four: grey is replicated, a missing alpha is 1.
template <typename T>
void expandTo4(std::span<const T> stored, int channels, bool alphaIsLast, T one, T* texels) {
    const std::size_t stride = static_cast<std::size_t>(channels);
    const bool grey = channels <= 2;
    for (std::size_t at = 0; at + stride <= stored.size(); at += stride, texels += 4) {
        const T* in = &stored[at];
        texels[0] = in[0];
        texels[1] = grey ? in[0] : in[1];
        texels[2] = grey ? in[0] : in[2];
        texels[3] = alphaIsLast ? in[stride - 1] : one;
    }
}

template <typename T>
bool readTexels(OIIO::ImageInput& input, int channels, bool alphaIsLast, OIIO::TypeDesc type, T one, Image& image) {
    std::vector<T> stored(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                          static_cast<std::size_t>(channels));
    if (!input.read_image(0, 0, 0, channels, type, stored.data())) return false;
    image.texels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4 * sizeof(T));
    expandTo4<T>(stored, channels, alphaIsLast, one, reinterpret_cast<T*>(image.texels.data()));
    return true;
}

Image decodeByOiio(std::span<const std::byte> bytes, const std::string& name, const std::string& format,
                   LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    requirePictureSize(claimedSize(bytes, format), bytes, name, ledger);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input)
        throw std::runtime_error(fmt::format("OpenImageIO cannot read {}: {}; install it with that format", format,
                                             oneLine(OIIO::geterror())));
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    OIIO::ImageSpec spec;
    if (!input->supports("ioproxy") || !input->set_ioproxy(&reader))
        throw std::runtime_error("this OpenImageIO cannot read the format from memory; install 2.4 or newer");
    if (!input->open("picture." + format, spec, config))
        throw InputError(
            fmt::format("{}: the {} picture cannot be decoded ({})", name, format, oneLine(input->geterror())));

    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 || spec.deep)
        throw InputError(fmt::format("{}: the picture has {}x{}x{} texels of {} channels; a flat picture with at least "
                                     "one of each is needed",
                                     name, spec.width, spec.height, spec.depth, spec.nchannels));
    Image image;
    image.name = name;
    image.width = spec.width;
    image.height = spec.height;
    image.format = texelFormatOf(spec.format);
    // The reader's own copy, what it hands over, and the texels made of that.
    const std::uint64_t bytesATexel =
        2 * static_cast<std::uint64_t>(spec.nchannels) * texelBytes(image.format) / 4 + texelBytes(image.format);
    ledger.settle(mark, 0);
    requirePictureSize({spec.width, spec.height, bytesATexel}, bytes, name, ledger);
    // Beyond RGBA stand depth and the like, which no texture slot uses.
    const int channels = spec.nchannels <= 4 ? spec.nchannels : (spec.alpha_channel == 3 ? 4 : 3);
    const bool alphaIsLast = channels == 2 || channels == 4;
    bool good = false;
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        good = readTexels<std::uint8_t>(*input, channels, alphaIsLast, OIIO::TypeDesc::UINT8, 0xff, image);
        break;
    case TexelFormat::Rgba16Unorm:
        good = readTexels<std::uint16_t>(*input, channels, alphaIsLast, OIIO::TypeDesc::UINT16, 0xffff, image);
        break;
    case TexelFormat::Rgba32Float:
        good = readTexels<float>(*input, channels, alphaIsLast, OIIO::TypeDesc::FLOAT, 1.0f, image);
        break;
    }
    if (!good)
        throw InputError(
            fmt::format("{}: the {} picture is broken or cut short ({})", name, format, oneLine(input->geterror())));
    return image;
}

} // namespace

Image readImage(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    Image image = decodeImage(readFileBytes(file, ledger), file.string(), ledger);
    ledger.settle(mark, image.texels.size());
    return image;
}

Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger) {
    if (bytes.empty()) throw InputError(fmt::format("{}: the picture is empty (0 bytes)", name));
    const std::string format = formatOf(bytes, name);
    if (std::ranges::find(kDecoded, format) == std::end(kDecoded))
        throw InputError(fmt::format("{}: {}; convert the picture to PNG, JPEG, HDR or EXR", name,
                                     format.empty() ? "is in no known picture format"
                                                    : fmt::format("the picture format {} is not supported", format)));
    const std::uint64_t mark = ledger.usedBytes();
    Image image;
    try {
        if (format == "png")
            image = decodePng(bytes, name, ledger);
        else if (format == "bmp" || format == "tga")
            image = decodeBmpOrTga(bytes, name, ledger);
        else
            image = decodeByOiio(bytes, name, format, ledger);
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // some readers throw their own
        throw InputError(fmt::format("{}: the {} picture cannot be decoded ({})", name, format, oneLine(error.what())));
    }
    ledger.settle(mark, image.texels.size());
    return image;
}

} // namespace tessera::scenes
