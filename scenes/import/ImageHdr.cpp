#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// The header of a Radiance image.
struct HdrHeader {
    glm::dvec3 exposure{1.0}; ///< factor contained in the stored radiance
    bool isXyz = false;
    int length = 0, scanlines = 0; ///< texels per scanline, number of scanlines
    int orientation = 1;           ///< Exif's
    std::size_t bytes = 0;
};

/// Removes and returns the text up to the next character of `ends`, which is removed too; empty at the end of `text`.
std::string_view takenUpTo(std::string_view& text, std::string_view ends) {
    const std::size_t end = text.find_first_of(ends);
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return part;
}

/// Reads a number after spaces. Texts are not null-terminated, as strtod() requires.
bool readHdrNumber(std::string_view& text, double& number) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(std::size_t(rest - text.data()));
    return error == std::errc();
}

/// Parses "-Y 8 +X 16": the axis across scanlines, starting at its least (+) or greatest (-) coordinate, and their
/// number; then the same along scanlines. Y points up.
bool readResolution(std::string_view line, HdrHeader& header) {
    struct Axis {
        char sign, name;
        double size;
    };
    std::array<Axis, 2> axes{};
    for (Axis& axis : axes) {
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        if (line.size() < 2) return false;
        axis.sign = line[0];
        axis.name = line[1];
        line.remove_prefix(2);
        constexpr double kMost = 1 << 30;
        if ((axis.sign != '+' && axis.sign != '-') || !readHdrNumber(line, axis.size)) return false;
        if (!(axis.size >= 1.0 && axis.size <= kMost && axis.size == std::floor(axis.size))) return false;
    }
    const bool hasColumns = axes[0].name == 'X';
    const Axis &x = axes[hasColumns ? 0 : 1], &y = axes[hasColumns ? 1 : 0];
    if (x.name != 'X' || y.name != 'Y') return false;
    const bool fromRight = x.sign == '-', fromBottom = y.sign == '+';
    header.orientation = 1 + (fromBottom ? (fromRight ? 2 : 3) : (fromRight ? 1 : 0)) + (hasColumns ? 4 : 0);
    header.scanlines = int(axes[0].size);
    header.length = int(axes[1].size);
    return true;
}

/// Source: Ward, "Radiance File Formats", "Picture Files": lines up to an empty one, then the resolution. Each EXPOSURE
/// and COLORCORR multiplies; indented lines belong to source images and are ignored.
HdrHeader readHdrHeader(const PictureSource& source) {
    constexpr std::string_view kExposure = "EXPOSURE=", kCorrection = "COLORCORR=", kFormat = "FORMAT=";
    const auto withoutReturn = [](std::string_view line) {
        return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
    };
    HdrHeader header;
    std::string_view text(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
    while (!text.empty()) {
        std::string_view line = withoutReturn(takenUpTo(text, "\n"));
        if (line.empty()) break;
        const bool isCorrection = line.starts_with(kCorrection);
        if (line.starts_with(kFormat)) {
            header.isXyz = line.find("xyze") != std::string_view::npos;
        } else if (isCorrection || line.starts_with(kExposure)) {
            std::string_view numbers = line.substr(isCorrection ? kCorrection.size() : kExposure.size());
            glm::dvec3 factor(0.0);
            bool isGood = readHdrNumber(numbers, factor.x);
            factor = glm::dvec3(factor.x);
            if (isCorrection) isGood = isGood && readHdrNumber(numbers, factor.y) && readHdrNumber(numbers, factor.z);
            const glm::dvec3 product = header.exposure * factor;
            for (int c = 0; c < 3; ++c) isGood = isGood && std::isfinite(product[c]) && product[c] > 0.0;
            if (isGood)
                header.exposure = product;
            else
                source.noteRepair(fmt::format("'{}' of its header is no factor above 0", line.substr(0, 40)),
                                  "taken as 1");
        }
    }
    source.require(readResolution(withoutReturn(takenUpTo(text, "\n")), header),
                   "its header ends without a resolution such as -Y 8 +X 16");
    header.bytes = source.bytes.size() - text.size();
    return header;
}

/// Converts XYZ to linear ITU-R BT.709 with D65. Source: IEC 61966-2-1, section 5.3.
glm::dvec3 colourOfXyz(const glm::dvec3& xyz) {
    return {glm::dot(glm::dvec3(3.2406, -1.5372, -0.4986), xyz), glm::dot(glm::dvec3(-0.9689, 1.8758, 0.0415), xyz),
            glm::dot(glm::dvec3(0.0557, -0.2040, 1.0570), xyz)};
}

void undoHeader(const HdrHeader& header, Image& image) {
    if (header.exposure == glm::dvec3(1.0) && !header.isXyz) return;
    for (glm::vec4& texel : texelsOf<glm::vec4>(image)) {
        const glm::dvec3 value = glm::dvec3(texel) / header.exposure;
        texel = glm::vec4(glm::vec3(header.isXyz ? colourOfXyz(value) : value), texel.w);
    }
}

/// Removes and returns the next word of a PFM header, and removes the one space after it; empty if the text ends.
std::string_view takenWord(std::string_view& text) {
    constexpr std::string_view kSpaces = " \t\n\r";
    text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
    const std::size_t end = text.find_first_of(kSpaces);
    const std::string_view word = end == text.npos ? std::string_view() : text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    return word;
}

template <typename Number>
bool readWord(std::string_view word, Number& number) {
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && rest == word.data() + word.size();
}

} // namespace

/// Replaces the header by a plain one, then decodes the texels with OpenImageIO.
DecodedPicture decodeHdr(const PictureSource& source) {
    const HdrHeader header = readHdrHeader(source);
    const std::string plain =
        fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", header.scanlines, header.length);
    const std::span<const std::byte> first = std::as_bytes(std::span(plain)), rest = source.bytes.subspan(header.bytes);
    source.ledger.charge(first.size() + source.bytes.size(),
                         [&] { return source.name + ": a copy of the picture's file"; });
    std::vector<std::byte> file(first.begin(), first.end());
    file.insert(file.end(), rest.begin(), rest.end());
    DecodedPicture decoded = decodeByOiio({file, source.name, source.format, source.ledger});
    undoHeader(header, decoded.image);
    turnUpright(decoded.image, header.orientation, source.ledger);
    return decoded;
}

/// Source: Debevec, "Portable FloatMap Image Format": PF or Pf (grey), width, height and scale; rows from the bottom.
/// Texels are multiplied by the magnitude of the scale; its sign is the byte order: negative is little-endian.
DecodedPicture decodePfm(const PictureSource& source) {
    std::string_view text(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
    const std::size_t channels = takenWord(text) == "PF" ? 3 : 1;
    std::int32_t width = 0, height = 0;
    float scale = 0.0f;
    source.require(readWord(takenWord(text), width) && readWord(takenWord(text), height) && width > 0 && height > 0,
                   "it has no size");
    source.require(readWord(takenWord(text), scale) && std::isfinite(scale) && scale != 0.0f, "it has no scale");
    const std::size_t columns = std::size_t(width), rows = std::size_t(height);
    const std::span<const std::byte> stored = std::as_bytes(std::span(text));
    source.require(stored.size() / (channels * sizeof(float)) / columns >= rows, "it ends early");
    DecodedPicture decoded = source.blank(width, height, TexelFormat::Rgba32Float, sizeof(glm::vec4));
    decoded.tags.isLinear = true;
    const bool isSwapped = (scale < 0.0f) != (std::endian::native == std::endian::little);
    const auto valueAt = [&](std::size_t index) {
        std::array<std::byte, sizeof(float)> value;
        std::memcpy(value.data(), stored.data() + index * sizeof(float), sizeof(float));
        if (isSwapped) std::ranges::reverse(value);
        return std::bit_cast<float>(value) * std::abs(scale);
    };
    const std::span<glm::vec4> texels = texelsOf<glm::vec4>(decoded.image);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t first = ((rows - 1 - row) * columns + column) * channels;
            texels[row * columns + column] = {valueAt(first), valueAt(first + channels / 2),
                                              valueAt(first + channels - 1), 1.0f};
        }
    return decoded;
}

} // namespace tessera::scenes
