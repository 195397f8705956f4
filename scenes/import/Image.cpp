#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "scenes/Error.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

constexpr int kMaxSide = 32768;                            ///< the largest side of a texture on current hardware
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 28; ///< 16384 x 16384
/// No picture codec packs texels tighter than this (deflate reaches 1032 bytes a byte, a 1-bit grey texel becomes 4
/// bytes): a header that claims more texels than its file can hold is refused before memory is reserved for them.
constexpr std::int64_t kMaxTexelsPerByte = 16384;

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
    {"8BPS"sv, 0, "psd"},
    {"DDS "sv, 0, "dds"},
    {"WEBP"sv, 8, "webp"},
    {"\xabKTX 11"sv, 0, "ktx"},
    {"\xabKTX 20"sv, 0, "ktx2"},
    {"BM"sv, 0, "bmp"},
    {"\0\0\0\x0cjP  "sv, 0, "jpeg2000"},
};

/// The format by its first bytes, else by the extension of `name` (TGA has no signature).
std::string formatOf(std::span<const std::byte> bytes, const std::string& name) {
    for (const Signature& signature : kSignatures)
        if (bytes.size() >= signature.offset + signature.bytes.size() &&
            std::memcmp(bytes.data() + signature.offset, signature.bytes.data(), signature.bytes.size()) == 0)
            return signature.format;
    std::string extension = std::filesystem::path(name).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

/// libpng prints a line of its own to stderr when a file ends early, so that is found out before it is asked.
/// Source: PNG specification, section 5.3: a chunk is length, type, data, CRC, with the length big-endian.
bool isCompletePng(std::span<const std::byte> bytes) {
    constexpr std::size_t kSignatureBytes = 8;
    constexpr std::size_t kFrameBytes = 12;
    std::size_t at = kSignatureBytes;
    while (bytes.size() - at >= kFrameBytes) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(bytes[at + i]);
        if (length > bytes.size() - at - kFrameBytes) return false;
        if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
        at += length + kFrameBytes;
    }
    return false;
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

/// `file` names the bytes' file for formats that OpenImageIO cannot read from memory.
Image decode(std::span<const std::byte> bytes, const std::string& name,
             const std::optional<std::filesystem::path>& file) {
    if (bytes.empty()) throw InputError(fmt::format("{}: the picture is empty (0 bytes)", name));
    const std::string format = formatOf(bytes, name);
    if (format.empty() || format == "ktx" || format == "ktx2")
        throw InputError(fmt::format("{}: {}; convert the picture to PNG, JPEG, HDR or EXR", name,
                                     format.empty() ? "is in no known picture format"
                                                    : fmt::format("the picture format {} is not supported", format)));
    if (format == "png" && (bytes.size() < 8 || !isCompletePng(bytes)))
        throw InputError(fmt::format("{}: the png picture is broken or cut short", name));
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) {
        OIIO::geterror(); // clears the text, which lists plugins instead of saying what to do
        throw InputError(fmt::format("{}: the picture format '{}' is not supported; convert the picture to PNG, JPEG, "
                                     "HDR or EXR",
                                     name, format));
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    OIIO::ImageSpec spec;
    const bool fromMemory = input->supports("ioproxy") && input->set_ioproxy(&reader);
    if (!fromMemory && !file)
        throw InputError(
            fmt::format("{}: an embedded {} picture is not supported; store it as PNG or JPEG", name, format));
    if (!input->open(fromMemory ? "picture." + format : file->string(), spec, config))
        throw InputError(
            fmt::format("{}: the {} picture cannot be decoded ({})", name, format, oneLine(input->geterror())));

    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0)
        throw InputError(fmt::format("{}: the picture has {}x{}x{} texels of {} channels; a flat picture with at least "
                                     "one of each is needed",
                                     name, spec.width, spec.height, spec.depth, spec.nchannels));
    const std::int64_t texelCount = std::int64_t{spec.width} * spec.height;
    if (spec.width > kMaxSide || spec.height > kMaxSide || texelCount > kMaxTexels)
        throw InputError(fmt::format("{}: the picture has {}x{} texels; at most {} a side and {} in all can be used",
                                     name, spec.width, spec.height, kMaxSide, kMaxTexels));
    if (texelCount / kMaxTexelsPerByte > static_cast<std::int64_t>(bytes.size()))
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels, more than {} bytes can hold; the file is broken", name,
                        spec.width, spec.height, bytes.size()));

    Image image;
    image.name = name;
    image.width = spec.width;
    image.height = spec.height;
    image.format = texelFormatOf(spec.format);
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

Image readImage(const std::filesystem::path& file) {
    return decode(readFileBytes(file), file.string(), file);
}

Image decodeImage(std::span<const std::byte> bytes, const std::string& name) {
    return decode(bytes, name, std::nullopt);
}

} // namespace tessera::scenes
