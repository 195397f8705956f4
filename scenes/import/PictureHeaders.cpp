#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

constexpr int kMaxSide = 32768;                            ///< the largest side of a texture on current hardware
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 28; ///< 16384 x 16384
/// What is needed of Exif, which is a TIFF without a picture: Orientation and Software.
constexpr std::uint16_t kExifTags[] = {274, 305};
constexpr std::string_view kExifBegin("Exif\0\0", 6);

/// 0 beyond the end.
std::uint32_t byteAt(std::span<const std::byte> bytes, std::size_t at) {
    return at < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at]) : 0;
}

std::uint32_t bigEndian16(std::span<const std::byte> bytes, std::size_t at) {
    return byteAt(bytes, at) << 8 | byteAt(bytes, at + 1);
}

std::uint32_t littleEndian16(std::span<const std::byte> bytes, std::size_t at) {
    return byteAt(bytes, at) | byteAt(bytes, at + 1) << 8;
}

constexpr std::uint32_t kFrame = 0xc0, kRestart = 0xd0, kEnd = 0xd9, kScan = 0xda;

/// Calls `visit` with every marker of a JPEG that has a segment, and the place of that: its length stands first.
/// Source: ITU-T T.81, annex B; bytes between markers are skipped, as by libjpeg.
template <typename Visit>
void forEachSegment(std::span<const std::byte> bytes, Visit visit) {
    for (std::size_t at = 2; at + 1 < bytes.size();) {
        const std::uint32_t marker = byteAt(bytes, at + 1);
        if (byteAt(bytes, at) != 0xff || marker == 0xff) {
            ++at;
            continue;
        }
        at += 2;
        if (marker == kEnd) break;
        if (marker < kFrame || (marker >= kRestart && marker < kEnd)) continue;
        visit(marker, at);
        at += bigEndian16(bytes, at);
    }
}

} // namespace

/// Source: GIF89a specification, section 18, "Logical Screen Descriptor".
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes) {
    return {littleEndian16(bytes, 6), littleEndian16(bytes, 8), 4};
}

/// Where texels need more than one scan, libjpeg reads all scans at once and keeps the coefficients, 2 bytes each, of
/// all components.
PictureSize claimedSizeOfJpeg(std::span<const std::byte> bytes) {
    constexpr int kMaxScans = 100; // encoders write about ten
    PictureSize size;
    std::uint32_t components = 0;
    int scans = 0;
    forEachSegment(bytes, [&](std::uint32_t marker, std::size_t at) {
        const bool isFrame = marker == kFrame || (marker < kRestart && marker % 4 != 0); // 0xc4, 0xc8, 0xcc: none
        if (isFrame && components == 0) {
            size.height = bigEndian16(bytes, at + 3);
            size.width = bigEndian16(bytes, at + 5);
            components = byteAt(bytes, at + 7);
            const bool isProgressive = marker % 4 == 2;
            if (isProgressive) size.bytesATexel = 2 * components;
        } else if (marker == kScan) {
            if (byteAt(bytes, at + 2) < components) size.bytesATexel = 2 * components;
            if (++scans > kMaxScans)
                throw std::runtime_error(
                    fmt::format("it has more than {} scans, each of which takes as long as a picture", kMaxScans));
        }
    });
    return size;
}

/// Leaves the first Exif segment, with what is needed of it. OpenImageIO reads descriptions (XMP) by recursion, which
/// tens of thousands of levels end.
void takeOutMetadataOfJpeg(std::span<std::byte> bytes) {
    // APP1: Exif and XMP, APP2: profiles, APP13: Photoshop's, COM: comments. Nothing reads APP15.
    constexpr std::uint32_t kApp1 = 0xe1, kApp2 = 0xe2, kApp13 = 0xed, kComment = 0xfe;
    constexpr std::byte kApp15{0xef};
    bool hasExif = false;
    const auto keepsExif = [&](std::size_t at) {
        constexpr std::size_t kTiff = 2 + kExifBegin.size(); // after the length
        const std::size_t length = std::min<std::size_t>(bigEndian16(bytes, at), bytes.size() - at);
        return length >= kTiff && std::memcmp(bytes.data() + at + 2, kExifBegin.data(), kExifBegin.size()) == 0 &&
               keepTiffTags(bytes.subspan(at + kTiff, length - kTiff), kExifTags);
    };
    forEachSegment(bytes, [&](std::uint32_t marker, std::size_t at) {
        if (marker != kApp1 && marker != kApp2 && marker != kApp13 && marker != kComment) return;
        if (marker == kApp1 && !hasExif && keepsExif(at))
            hasExif = true;
        else
            bytes[at - 1] = kApp15;
    });
}

void requirePictureSize(const PictureSize& size, std::span<const std::byte> file, const std::string& name,
                        const PictureFormat& format, LoadLedger& ledger) {
    if (size.width <= 0 || size.height <= 0)
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels; the file is broken", name, size.width, size.height));
    if (size.width > kMaxSide || size.height > kMaxSide || size.width * size.height > kMaxTexels)
        throw InputError(fmt::format("{}: the picture has {}x{} texels; at most {} a side and {} in all can be used",
                                     name, size.width, size.height, kMaxSide, kMaxTexels));
    const std::int64_t texels = size.width * size.height;
    if (format.maxTexelsAByte != 0 && texels / format.maxTexelsAByte > static_cast<std::int64_t>(file.size()))
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels, more than {} bytes can hold; the file is broken", name,
                        size.width, size.height, file.size()));
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 62; // more than any budget, and no overflow
    ledger.charge(static_cast<std::uint64_t>(texels) * size.bytesATexel + std::min(size.bytes, kMostBytes),
                  [&] { return fmt::format("{}: the picture of {}x{} texels", name, size.width, size.height); });
}

} // namespace tessera::scenes
