#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

constexpr int kMaxSide = 1 << 20;                          ///< libpng stops a little earlier
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 28; ///< 16384 x 16384
constexpr std::string_view kExifBegin("Exif\0\0", 6);      ///< a TIFF without a picture follows

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

int orientationOfJpeg(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kApp1 = 0xe1;
    int orientation = 0; // of no segment yet
    forEachSegment(bytes, [&](std::uint32_t marker, std::size_t at) {
        if (marker != kApp1 || orientation != 0 || at + 2 > bytes.size()) return;
        const std::size_t length = std::min<std::size_t>(bigEndian16(bytes, at), bytes.size() - at);
        const std::span<const std::byte> segment = bytes.subspan(at + 2, length - std::min<std::size_t>(length, 2));
        if (segment.size() > kExifBegin.size() &&
            std::memcmp(segment.data(), kExifBegin.data(), kExifBegin.size()) == 0)
            orientation = orientationOfTiff(segment.subspan(kExifBegin.size()));
    });
    return std::max(orientation, 1);
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
