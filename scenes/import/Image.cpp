#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "base/Extension.h"
#include "base/OneLine.h"
#include "scenes/import/Files.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// Limit of texels per byte of a file. Deflate reaches 1032 bytes per byte, and a grey texel may have one bit; Huffman
/// codes of JPEG blocks and runs of the other formats stay below.
constexpr std::int64_t kMaxTexelsAByte = 16384;

bool begins(std::span<const std::byte> bytes, const PictureSignature& signature) {
    return !signature.bytes.empty() && bytes.size() >= signature.offset + signature.bytes.size() &&
           std::memcmp(bytes.data() + signature.offset, signature.bytes.data(), signature.bytes.size()) == 0;
}

bool hasSignature(const PictureFormat& format) {
    return !format.signatures[0].bytes.empty();
}

/// `extension` has no dot.
bool hasExtension(const PictureFormat& format, std::string_view extension) {
    return !extension.empty() && std::ranges::find(format.extensions, extension) != std::end(format.extensions);
}

/// The decoded formats as "a, b or c".
std::string decodedNames() {
    std::string names;
    std::string_view last;
    for (const PictureFormat& format : pictureFormats()) {
        if (format.decode == nullptr) continue;
        if (!last.empty()) names += (names.empty() ? "" : ", ") + std::string(last);
        last = format.name;
    }
    return names + " or " + std::string(last);
}

/// Detects the format by the first bytes, regardless of the name; by the extension if no signature matches. Throws
/// InputError for other formats.
const PictureFormat& formatOf(std::span<const std::byte> bytes, const std::string& name) {
    const auto refusal = [&](const std::string& what) {
        return InputError(fmt::format("{}: {}; convert the picture to {}", name, what, decodedNames()));
    };
    const auto unsupported = [](std::string_view format) {
        return fmt::format("the picture format {} is not supported", format);
    };
    for (const PictureFormat& format : pictureFormats()) {
        if (std::ranges::none_of(format.signatures, [&](const auto& one) { return begins(bytes, one); })) continue;
        if (format.decode == nullptr) throw refusal(unsupported(format.name));
        return format;
    }
    const std::string dotted = extensionOf(name), extension = dotted.substr(dotted.empty() ? 0 : 1);
    bool hasKnownExtension = extension.empty();
    for (const PictureFormat& format : pictureFormats()) {
        if (!hasExtension(format, extension)) continue;
        if (!hasSignature(format)) return format;
        hasKnownExtension = true;
    }
    throw refusal(hasKnownExtension ? "is in no known picture format" : unsupported(extension));
}

DecodedPicture decodePicture(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger) {
    if (bytes.empty()) throw InputError(fmt::format("{}: the picture is empty (0 bytes); save it again", name));
    const PictureFormat& format = formatOf(bytes, name);
    const std::uint64_t mark = ledger.usedBytes();
    const PictureSource source{bytes, name, format, ledger};
    try {
        const PictureSize claimed = format.claimedSize == nullptr ? PictureSize() : format.claimedSize(bytes);
        if (claimed.width != 0 || claimed.height != 0) source.charge(claimed);
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& error) {
        source.fail(error.what(), "cannot be decoded");
    }
    DecodedPicture decoded = format.decode(source);
    ledger.settle(mark, decoded.image.texels.size());
    return decoded;
}

DecodedPicture readStored(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    DecodedPicture decoded = decodePicture(readFileBytes(file, ledger), file.string(), ledger);
    ledger.settle(mark, decoded.image.texels.size());
    return decoded;
}

template <typename Channel>
void divideByAlpha(std::span<Channel> texels) {
    constexpr double kOne = kOneOf<Channel>;
    for (std::size_t i = 0; i < texels.size(); i += 4) {
        const double alpha = double(texels[i + 3]);
        if (!(alpha > 0.0)) continue;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double value = double(texels[c]) * kOne / alpha;
            texels[c] = Channel(std::is_integral_v<Channel> ? std::min(std::round(value), kOne) : value);
        }
    }
}

Image textureOf(DecodedPicture picture) {
    Image& image = picture.image;
    if (picture.tags.isAssociated)
        withChannel(image.format, [&]<typename Channel>(Channel) { divideByAlpha(texelsOf<Channel>(image)); });
    return std::move(image);
}

} // namespace

std::span<const PictureFormat> pictureFormats() {
    using namespace std::string_view_literals;
    static constexpr std::array kFormats = {
        PictureFormat{"png", {{"\x89PNG\r\n\x1a\n"sv}}, {"png"}, decodePng, kMaxTexelsAByte},
        PictureFormat{"jpeg", {{"\xff\xd8\xff"sv}}, {"jpg", "jpeg"}, decodeJpeg, kMaxTexelsAByte, claimedSizeOfJpeg},
        PictureFormat{"openexr", {{"\x76\x2f\x31\x01"sv}}, {"exr"}, decodeByOiio, kMaxTexelsAByte, claimedSizeOfExr},
        PictureFormat{"hdr", {{"#?"sv}}, {"hdr"}, decodeHdr, kMaxTexelsAByte},
        PictureFormat{"pfm", {{"PF\n"sv}, {"Pf\n"sv}}, {"pfm"}, decodePfm, kMaxTexelsAByte},
        PictureFormat{"tiff",
                      {{"II*\0"sv}, {"MM\0*"sv}},
                      {"tif", "tiff"},
                      decodeByOiio,
                      0,
                      claimedSizeOfTiff,
                      takeOutMetadataOfTiff},
        PictureFormat{"webp", {{"WEBP"sv, 8}}, {"webp"}, decodeWebp},
        PictureFormat{"bmp", {{"BM"sv}}, {"bmp"}, decodeByStb, kMaxTexelsAByte},
        PictureFormat{"gif", {{"GIF8"sv}}, {"gif"}, decodeByOiio, kMaxTexelsAByte, claimedSizeOfGif},
        PictureFormat{"tga", {}, {"tga"}, decodeByStb, kMaxTexelsAByte},
        PictureFormat{"psd", {{"8BPS"sv}}, {}, nullptr},
        PictureFormat{"dds", {{"DDS "sv}}, {}, nullptr},
        PictureFormat{"ktx", {{"\xabKTX 11"sv}}, {}, nullptr},
        PictureFormat{"ktx2", {{"\xabKTX 20"sv}}, {}, nullptr},
        PictureFormat{"jpeg2000", {{"\0\0\0\x0cjP  "sv}}, {}, nullptr},
    };
    return kFormats;
}

DecodedPicture readPicture(const std::filesystem::path& file, LoadLedger& ledger) {
    DecodedPicture decoded = readStored(file, ledger);
    const std::uint64_t mark = ledger.usedBytes();
    turnUpright(decoded.image, decoded.tags.orientation, ledger);
    ledger.settle(mark, 0);
    decoded.tags.orientation = 1;
    return decoded;
}

Image readImage(const std::filesystem::path& file, LoadLedger& ledger) {
    return textureOf(readStored(file, ledger));
}

Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger) {
    return textureOf(decodePicture(bytes, name, ledger));
}

/// Source: TIFF revision 6.0, "Orientation". Rows of 5 to 8 are columns; the first row is the last of 3, 4, 6 and 7.
void turnUpright(Image& image, int orientation, LoadLedger& ledger) {
    if (orientation <= 1 || orientation > 8) return;
    const bool hasColumns = orientation >= 5;
    const bool fromRight = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool fromBottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    ledger.charge(image.texels.size(), [&] { return image.name + ": the picture turned upright"; });
    const auto columns = std::size_t(image.width), rows = std::size_t(image.height);
    const std::size_t width = hasColumns ? rows : columns, height = hasColumns ? columns : rows;
    const std::size_t bytes = texelBytes(image.format);
    std::vector<std::byte> turned(image.texels.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t right = hasColumns ? row : column, down = hasColumns ? column : row;
            const std::size_t x = fromRight ? width - 1 - right : right, y = fromBottom ? height - 1 - down : down;
            std::memcpy(turned.data() + (y * width + x) * bytes, image.texels.data() + (row * columns + column) * bytes,
                        bytes);
        }
    image.texels = std::move(turned);
    image.width = int(width);
    image.height = int(height);
}

void placeInWindow(const Image& image, const DisplayWindow& window, bool hasAlpha, Image& placed) {
    if (!hasAlpha)
        withChannel(placed.format, [&]<typename Channel>(Channel) {
            const std::span<Channel> texels = texelsOf<Channel>(placed);
            for (std::size_t alpha = 3; alpha < texels.size(); alpha += 4) texels[alpha] = kOneOf<Channel>;
        });
    // The overlap of both windows, in texels of the displayed image.
    const std::int64_t left = std::max<std::int64_t>(window.left, 0), top = std::max<std::int64_t>(window.top, 0);
    const std::int64_t right = std::min<std::int64_t>(window.left + image.width, window.width);
    const std::int64_t bottom = std::min<std::int64_t>(window.top + image.height, window.height);
    if (left >= right) return;
    const std::size_t bytes = texelBytes(image.format);
    for (std::int64_t row = top; row < bottom; ++row)
        std::memcpy(placed.texels.data() + std::size_t(row * window.width + left) * bytes,
                    image.texels.data() + std::size_t((row - window.top) * image.width + left - window.left) * bytes,
                    std::size_t(right - left) * bytes);
}

void PictureSource::fail(std::string_view why, std::string_view what) const {
    throw InputError(fmt::format("{}: the {} picture {} ({}); save it again", name, format.name, what, oneLine(why)));
}

DecodedPicture PictureSource::blank(int width, int height, TexelFormat texels, std::uint64_t bytesATexel) const {
    charge({width, height, bytesATexel});
    const std::size_t count = std::size_t(width) * std::size_t(height);
    return {{name, texels, width, height, std::vector<std::byte>(count * texelBytes(texels))}, {}};
}

void PictureSource::noteRepair(const std::string& flaw, const std::string& repair) const {
    if (ledger.importOptions().isStrict) throw InputError(fmt::format("{}: {}; save it again", name, flaw));
    ledger.warn(fmt::format("{}: {}; {}", name, flaw, repair));
}

} // namespace tessera::scenes
