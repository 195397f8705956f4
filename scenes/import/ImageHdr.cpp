#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// What precedes the texels.
struct HdrHeader {
    glm::dvec3 exposure{1.0}; ///< what radiance was multiplied by
    bool isXyz = false;
    int length = 0, scanlines = 0; ///< texels of a scanline, scanlines
    int orientation = 1;           ///< Exif's
    std::size_t bytes = 0;
};

/// Up to the next end of line or space, which is taken too; empty at the end of `text`.
std::string_view takenUpTo(std::string_view& text, std::string_view ends) {
    const std::size_t end = text.find_first_of(ends);
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return part;
}

/// A number after spaces. Texts are not terminated, so strtod() is of no use.
bool readHdrNumber(std::string_view& text, double& number) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    return error == std::errc();
}

/// "-Y 8 +X 16": the axis across scanlines, which begin at its least (+) or greatest (-) coordinate, their number, and
/// the same along them. Y points up.
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
    header.scanlines = static_cast<int>(axes[0].size);
    header.length = static_cast<int>(axes[1].size);
    return true;
}

/// Source: Ward, "Radiance File Formats", "Picture Files": lines up to an empty one, then the resolution. Each EXPOSURE
/// and COLORCORR multiplies; indented lines are those of the pictures that this one was made of.
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

/// Linear colours of ITU-R BT.709 and D65. Source: IEC 61966-2-1, section 5.3.
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

} // namespace

/// OpenImageIO reads the texels behind a header of this program's own.
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

} // namespace tessera::scenes
