#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "scenes/import/PictureCodecs.h"

/// OpenEXR's reader trusts a header: it allocates the size that a value claims, 2 GiB at most, before reading it. The
/// header is therefore read here first, by the same rules, so that no value escapes the check.
namespace tessera::scenes {
namespace {

constexpr int kMaxSide = 1 << 20;                          ///< libpng stops a little earlier
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 28; ///< 16384 x 16384
constexpr std::string_view kExifBegin("Exif\0\0", 6);      ///< a TIFF without an image follows

/// 0 beyond the end.
std::uint32_t byteAt(std::span<const std::byte> bytes, std::size_t at) {
    return at < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at]) : 0;
}

/// A number of `count` bytes.
std::uint64_t numberAt(std::span<const std::byte> bytes, std::size_t at, int count, bool isBigEndian) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i)
        value = value << 8 | byteAt(bytes, at + std::size_t(isBigEndian ? i : count - 1 - i));
    return value;
}

std::uint32_t bigEndian16(std::span<const std::byte> bytes, std::size_t at) {
    return std::uint32_t(numberAt(bytes, at, 2, true));
}

bool beginsWithExif(std::span<const std::byte> bytes) {
    return bytes.size() > kExifBegin.size() && std::memcmp(bytes.data(), kExifBegin.data(), kExifBegin.size()) == 0;
}

constexpr std::uint32_t kFrame = 0xc0, kRestart = 0xd0, kEnd = 0xd9, kScan = 0xda;

/// Calls `visit` with every marker of a JPEG that has a segment, and the segment's offset, where its length is stored.
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

constexpr std::size_t kEntryBytes = 12;

/// Reads numbers of a TIFF file in its byte order; 0 beyond its end. Source: Adobe 1992, TIFF revision 6.0, section 2.
class Tiff {
public:
    explicit Tiff(std::span<const std::byte> bytes)
        : bytes_(bytes), isBigEndian_(!bytes.empty() && bytes[0] == std::byte{'M'}) {}

    bool isBigEndian() const { return isBigEndian_; }

    std::uint64_t number(std::size_t at, int count) const { return numberAt(bytes_, at, count, isBigEndian_); }

    /// Offset of the first directory, which begins with the number of its entries.
    std::size_t directory() const { return number(4, 4); }

    /// Offset of a tag's entry in the first directory, or 0.
    std::size_t entryOf(std::uint64_t tag) const {
        const std::uint64_t entries = number(directory(), 2);
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::size_t entry = directory() + 2 + kEntryBytes * i;
            if (number(entry, 2) == tag) return entry;
        }
        return 0;
    }

    /// The first number of a tag, or `otherwise`. Throws for other types, which libtiff reads by other rules.
    std::uint64_t valueOf(std::uint64_t tag, std::uint64_t otherwise) const {
        constexpr std::uint64_t kByte = 1, kShort = 3, kLong = 4;
        const std::size_t entry = entryOf(tag);
        if (entry == 0) return otherwise;
        const std::uint64_t type = number(entry + 2, 2);
        if (type != kByte && type != kShort && type != kLong)
            throw std::runtime_error(
                fmt::format("its tag {} is of type {}, where 1 (BYTE), 3 (SHORT) or 4 (LONG) is needed", tag, type));
        const int size = type == kByte ? 1 : type == kShort ? 2 : 4;
        const bool isElsewhere = number(entry + 4, 4) * std::uint64_t(size) > 4;
        return number(isElsewhere ? number(entry + 8, 4) : entry + 8, size);
    }

private:
    std::span<const std::byte> bytes_;
    bool isBigEndian_;
};

/// A product that saturates instead of overflowing.
std::uint64_t product(std::initializer_list<std::uint64_t> factors) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t result = 1;
    for (const std::uint64_t factor : factors)
        result = factor != 0 && result > kMost / factor ? kMost : result * factor;
    return result;
}

/// The tags that decoding needs. libtiff would copy each value of the others, even one that thousands of tags share.
/// Source: TIFF revision 6.0; Adobe's supplements (347); Pixar's (33300, 33301), SGI's (32996) and Esri's (50674).
constexpr std::uint16_t kDecodingTags[] = {
    254,   256,   257, 258, 259,   262,   266,      // subfile type, size, bits, compression, photometric, fill order
    273,   274,   277, 278, 279,                    // strips, orientation, samples
    282,   283,   284, 286, 287,   292,   293, 296, // resolution, planes, position, fax
    305,   317,   318, 320, 322,   323,   324, 325, // software, predictor, white point, palette, tiles
    332,   338,   339, 347,                         // ink set, extra samples, sample format, JPEG tables
    529,   530,   531, 532, 33300, 33301,           // YCbCr, size of the full image
    32996, 50674,                                   // SGI's data type, LERC parameters
};

/// Reads consecutive little-endian numbers and texts; beyond the end they are 0 and empty.
class Cursor {
public:
    Cursor(std::span<const std::byte> bytes, std::size_t at) : bytes_(bytes), at_(std::min(at, bytes.size())) {}

    template <typename Number>
    Number number() {
        Number value = 0;
        if (bytes_.size() - at_ >= sizeof(value)) std::memcpy(&value, bytes_.data() + at_, sizeof(value));
        skip(sizeof(value));
        return value;
    }

    /// Reads a null-terminated text. Throws std::runtime_error if it is longer than OpenEXR allows names to be.
    std::string text() {
        constexpr std::size_t kMostBytes = 255;
        const auto* first = reinterpret_cast<const char*>(bytes_.data()) + at_;
        const std::string value(first, std::find(first, first + std::min(left(), kMostBytes + 1), '\0'));
        if (value.size() > kMostBytes)
            throw std::runtime_error(fmt::format("a name in its header is longer than {} bytes", kMostBytes));
        skip(value.size() + 1);
        return value;
    }

    void skip(std::size_t count) { at_ += std::min(count, bytes_.size() - at_); }
    bool isAtEnd() const { return left() == 0; }
    std::size_t left() const { return bytes_.size() - at_; }
    /// A cursor over the next `count` bytes only.
    Cursor part(std::size_t count) const { return Cursor(bytes_.first(std::min(at_ + count, bytes_.size())), at_); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_;
};

/// Types whose values have a fixed size, which OpenEXR's reader assumes whatever they claim.
struct FixedSize {
    std::string_view type;
    std::uint32_t bytes;
};
constexpr FixedSize kFixedSizes[] = {{"box2i", 16},
                                     {"box2f", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33f", 36},
                                     {"m33d", 72},
                                     {"m44f", 64},
                                     {"m44d", 128},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2i", 8},
                                     {"v2f", 8},
                                     {"v2d", 16},
                                     {"v3i", 12},
                                     {"v3f", 12},
                                     {"v3d", 24}};

struct ExrAttribute {
    std::string name, type;
    Cursor value;

    [[noreturn]] void fail(std::string_view flaw) const {
        throw std::runtime_error(fmt::format("its attribute '{}' of type {} {}", name, type, flaw));
    }

    void requireRoom(std::uint32_t claimedBytes, const Cursor& rest) const {
        if (claimedBytes > rest.left())
            fail(fmt::format("claims {} bytes where {} are left", claimedBytes, rest.left()));
    }

    void check() const {
        const auto claimed = std::uint32_t(value.left());
        const auto* fixed = std::ranges::find(kFixedSizes, type, &FixedSize::type);
        if (fixed != std::end(kFixedSizes) && fixed->bytes != claimed)
            fail(fmt::format("claims {} bytes and has {}", claimed, fixed->bytes));
        Cursor rest = value;
        if (type == "stringvector") {
            while (!rest.isAtEnd()) {
                const auto textBytes = rest.number<std::uint32_t>();
                requireRoom(textBytes, rest);
                rest.skip(textBytes);
            }
        } else if (type == "floatvector" && claimed % sizeof(float) != 0) {
            fail(fmt::format("has {} bytes: a number takes 4", claimed));
        } else if (type == "chlist") { // names with 16 bytes each, up to an empty one
            bool hasEnded = false;
            while (!rest.isAtEnd() && !(hasEnded = rest.text().empty())) rest.skip(16);
            if (!hasEnded || !rest.isAtEnd())
                fail(fmt::format("has {} bytes: its list of channels {}", claimed,
                                 hasEnded ? "ends earlier" : "has no end"));
        }
    }
};

} // namespace

/// Source: GIF89a specification, section 18, "Logical Screen Descriptor".
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes) {
    return {std::int64_t(numberAt(bytes, 6, 2, false)), std::int64_t(numberAt(bytes, 8, 2, false)), 4};
}

/// If texels need more than one scan, libjpeg reads all scans at once and keeps the coefficients, 2 bytes each, of all
/// components.
PictureSize claimedSizeOfJpeg(std::span<const std::byte> bytes) {
    constexpr int kMaxScans = 100; // encoders write about ten
    PictureSize size;
    std::uint32_t components = 0;
    int scans = 0;
    forEachSegment(bytes, [&](std::uint32_t marker, std::size_t at) {
        const bool isFrame = marker == kFrame || (marker < kRestart && marker % 4 != 0); // not 0xc4, 0xc8, 0xcc
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
    int orientation = 0; // 0: no segment yet
    forEachSegment(bytes, [&](std::uint32_t marker, std::size_t at) {
        if (marker != kApp1 || orientation != 0 || at + 2 > bytes.size()) return;
        const std::size_t length = std::min<std::size_t>(bigEndian16(bytes, at), bytes.size() - at);
        const std::span<const std::byte> segment = bytes.subspan(at + 2, length - std::min<std::size_t>(length, 2));
        if (beginsWithExif(segment)) orientation = orientationOfTiff(segment);
    });
    return std::max(orientation, 1);
}

void PictureSource::charge(const PictureSize& size) const {
    if (size.width <= 0 || size.height <= 0)
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels; the file is broken", name, size.width, size.height));
    if (size.width > kMaxSide || size.height > kMaxSide || size.width * size.height > kMaxTexels)
        throw InputError(fmt::format("{}: the picture has {}x{} texels; at most {} a side and {} in all can be used",
                                     name, size.width, size.height, kMaxSide, kMaxTexels));
    const std::int64_t texels = size.width * size.height;
    if (format.maxTexelsAByte != 0 && texels / format.maxTexelsAByte > std::int64_t(bytes.size()))
        throw InputError(
            fmt::format("{}: the header claims {}x{} texels, more than {} bytes can hold; the file is broken", name,
                        size.width, size.height, bytes.size()));
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 62; // more than any budget, and no overflow
    ledger.charge(std::uint64_t(texels) * size.bytesATexel + std::min(size.bytes, kMostBytes),
                  [&] { return fmt::format("{}: the picture of {}x{} texels", name, size.width, size.height); });
}

bool keepTiffTags(std::span<std::byte> bytes, std::span<const std::uint16_t> tags) {
    constexpr std::size_t kHeaderBytes = 8;
    const Tiff tiff(bytes);
    const std::size_t directory = tiff.directory(), first = directory + 2;
    const std::size_t end = first + kEntryBytes * tiff.number(directory, 2);
    if (directory < kHeaderBytes || end > bytes.size()) return false;
    std::vector<std::uint64_t> missing(tags.begin(), tags.end());
    std::size_t keptEnd = first;
    for (std::size_t entry = first; entry < end; entry += kEntryBytes) {
        const auto tag = std::ranges::find(missing, tiff.number(entry, 2));
        if (tag == missing.end()) continue;
        missing.erase(tag);
        std::memmove(bytes.data() + keptEnd, bytes.data() + entry, kEntryBytes);
        keptEnd += kEntryBytes;
    }
    const std::size_t count = (keptEnd - first) / kEntryBytes;
    bytes[directory + (tiff.isBigEndian() ? 1 : 0)] = std::byte(count & 0xff);
    bytes[directory + (tiff.isBigEndian() ? 0 : 1)] = std::byte(count >> 8);
    const std::span<std::byte> next = bytes.subspan(keptEnd);
    std::ranges::fill(next.first(std::min<std::size_t>(next.size(), 4)), std::byte{0});
    return true;
}

int orientationOfTiff(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kOrientation = 274, kUpright = 1, kMost = 8;
    try {
        const Tiff tiff(beginsWithExif(bytes) ? bytes.subspan(kExifBegin.size()) : bytes);
        const std::uint64_t value = tiff.valueOf(kOrientation, kUpright);
        return value >= kUpright && value <= kMost ? int(value) : int(kUpright);
    } catch (const std::runtime_error&) {
        return int(kUpright);
    }
}

void takeOutMetadataOfTiff(std::span<std::byte> bytes) {
    if (!keepTiffTags(bytes, kDecodingTags)) throw std::runtime_error("its directory of tags is not in the file");
}

/// libtiff and OpenImageIO each hold a row of tiles, or a strip, as stored and as decoded: whole, however small the
/// image is. Colours that OpenImageIO leaves to libtiff are converted for the whole image at once.
PictureSize claimedSizeOfTiff(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kWidth = 256, kHeight = 257, kBits = 258, kCompression = 259, kColours = 262,
                            kSamples = 277, kRows = 278, kTileWidth = 322, kTileHeight = 323;
    constexpr std::uint64_t kOldJpeg = 6, kJpeg = 7, kSeparated = 5, kCopies = 2, kConvertedBytes = 4;
    const Tiff tiff(bytes);
    const std::uint64_t width = tiff.valueOf(kWidth, 0), height = tiff.valueOf(kHeight, 0);
    const std::uint64_t tileWidth = tiff.valueOf(kTileWidth, 0), tileHeight = tiff.valueOf(kTileHeight, 0);
    const std::uint64_t columns = tileWidth == 0 ? width : (width + tileWidth - 1) / tileWidth * tileWidth;
    const std::uint64_t rows = tileHeight == 0 ? std::min(tiff.valueOf(kRows, height), height) : tileHeight;
    const std::uint64_t bytesASample = std::max<std::uint64_t>((tiff.valueOf(kBits, 1) + 7) / 8, 1);
    const std::uint64_t samples = std::max<std::uint64_t>(tiff.valueOf(kSamples, 1), 1);
    const std::uint64_t compression = tiff.valueOf(kCompression, 1);
    if (compression == kOldJpeg) throw std::runtime_error("it is packed as JPEG in the way of TIFF before 1995");
    const bool isConverted = tiff.valueOf(kColours, 0) > kSeparated || compression == kJpeg;
    return {std::int64_t(width), std::int64_t(height), isConverted ? kConvertedBytes : 0,
            product({kCopies, columns, rows, bytesASample, samples})};
}

/// The largest of the parts and their tiles. Source: "OpenEXR File Layout": a header is a list of attributes (name,
/// type, size, value) up to an empty name; files of several parts have headers up to an empty one.
PictureSize claimedSizeOfExr(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kHasParts = 0x1000;
    Cursor cursor(bytes, 4);
    const bool hasParts = (cursor.number<std::uint32_t>() & kHasParts) != 0;
    PictureSize size{0, 0, 16};
    bool isEmpty = true; // the current header has no attribute yet
    while (!cursor.isAtEnd()) {
        const std::string name = cursor.text();
        if (name.empty()) {
            if (!hasParts || isEmpty) break;
            isEmpty = true;
            continue;
        }
        isEmpty = false;
        const std::string type = cursor.text();
        const auto claimedBytes = cursor.number<std::uint32_t>();
        ExrAttribute attribute{name, type, cursor.part(claimedBytes)};
        attribute.requireRoom(claimedBytes, cursor);
        attribute.check();
        cursor.skip(claimedBytes);
        Cursor& value = attribute.value;
        if (name == "dataWindow") {
            std::array<std::int64_t, 4> box{}; // least x, least y, most x, most y
            for (std::int64_t& side : box) side = value.number<std::int32_t>();
            size.width = std::max(size.width, box[2] - box[0] + 1);
            size.height = std::max(size.height, box[3] - box[1] + 1);
        } else if (name == "tiles") {
            size.width = std::max<std::int64_t>(size.width, value.number<std::uint32_t>());
            size.height = std::max<std::int64_t>(size.height, value.number<std::uint32_t>());
        }
    }
    return size;
}

} // namespace tessera::scenes
