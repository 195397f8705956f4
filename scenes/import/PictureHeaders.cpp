#include <stdexcept>

#include <fmt/format.h>

#include "scenes/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

constexpr int kMaxSide = 32768;                            ///< the largest side of a texture on current hardware
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 28; ///< 16384 x 16384
/// No picture codec packs texels tighter than this (deflate reaches 1032 bytes a byte, a 1-bit grey texel becomes 4
/// bytes): a header that claims more texels than its file can hold is refused before memory is reserved for them.
constexpr std::int64_t kMaxTexelsPerByte = 16384;

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

std::uint32_t littleEndian24(std::span<const std::byte> bytes, std::size_t at) {
    return littleEndian16(bytes, at) | byteAt(bytes, at + 2) << 16;
}

} // namespace

/// Source: GIF89a specification, section 18, "Logical Screen Descriptor".
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes) {
    return {littleEndian16(bytes, 6), littleEndian16(bytes, 8), 4};
}

/// Where texels need more than one scan, libjpeg reads all scans at once and keeps the coefficients, 2 bytes each, of
/// all components. Source: ITU-T T.81, annex B; bytes between markers are skipped, as by libjpeg.
PictureSize claimedSizeOfJpeg(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kFrame = 0xc0, kRestart = 0xd0, kEnd = 0xd9, kScan = 0xda;
    constexpr int kMaxScans = 100; // encoders write about ten
    PictureSize size;
    std::uint32_t components = 0;
    int scans = 0;
    for (std::size_t at = 2; at + 1 < bytes.size();) {
        const std::uint32_t marker = byteAt(bytes, at + 1);
        if (byteAt(bytes, at) != 0xff || marker == 0xff) {
            ++at;
            continue;
        }
        at += 2;
        if (marker == kEnd) break;
        if (marker < kFrame || (marker >= kRestart && marker < kEnd)) continue;
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
        at += bigEndian16(bytes, at);
    }
    return size;
}

/// OpenImageIO reserves all texels, and libwebp as many again. Source: RFC 9649, sections 2.5 to 2.7 and 3.4, and RFC
/// 6386, section 9.1.
PictureSize claimedSizeOfWebp(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kBytesATexel = 8;
    constexpr std::uint32_t kSide = 0x3fff;
    switch (byteAt(bytes, 15)) { // "VP8X", "VP8L" or "VP8 "
    case 'X':
        return {littleEndian24(bytes, 24) + 1, littleEndian24(bytes, 27) + 1, kBytesATexel};
    case 'L': {
        const std::uint32_t height = littleEndian24(bytes, 22) >> 6;
        return {(littleEndian16(bytes, 21) & kSide) + 1, (height & kSide) + 1, kBytesATexel};
    }
    default:
        return {littleEndian16(bytes, 26) & kSide, littleEndian16(bytes, 28) & kSide, kBytesATexel};
    }
}

void requirePictureSize(const PictureSize& size, std::span<const std::byte> file, const std::string& name,
                        LoadLedger& ledger) {
    if (size.width > kMaxSide || size.height > kMaxSide || size.width * size.height > kMaxTexels)
        throw InputError(fmt::format("{}: the picture has {}x{} texels; at most {} a side and {} in all can be used",
                                     name, size.width, size.height, kMaxSide, kMaxTexels));
    const std::int64_t texels = size.width * size.height;
    if (texels / kMaxTexelsPerByte > static_cast<std::int64_t>(file.size()))
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels, more than {} bytes can hold; the file is broken", name,
                        size.width, size.height, file.size()));
    ledger.charge(static_cast<std::uint64_t>(texels) * size.bytesATexel,
                  [&] { return fmt::format("{}: the picture of {}x{} texels", name, size.width, size.height); });
}

} // namespace tessera::scenes
