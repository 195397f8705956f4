#include <algorithm>
#include <array>
#include <cstring>

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

/// Little-endian numbers and texts one after another; what lies beyond the end is 0 and empty.
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

    /// Up to a zero byte, which is taken too.
    std::string text() {
        const auto* first = reinterpret_cast<const char*>(bytes_.data()) + at_;
        const std::string value(first, std::find(first, first + (bytes_.size() - at_), '\0'));
        skip(value.size() + 1);
        return value;
    }

    void skip(std::size_t count) { at_ += std::min(count, bytes_.size() - at_); }
    bool isAtEnd() const { return at_ == bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_;
};

/// Source: GIF89a specification, section 18, "Logical Screen Descriptor".
PictureSize gifSize(std::span<const std::byte> bytes) {
    Cursor cursor(bytes, 6);
    const auto width = cursor.number<std::uint16_t>();
    return {width, cursor.number<std::uint16_t>(), 4};
}

/// The largest of the parts and their tiles. Source: "OpenEXR File Layout": attributes of name, type, size and value up
/// to an empty name; of several parts up to an empty header.
PictureSize exrSize(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kHasParts = 0x1000;
    Cursor cursor(bytes, 4);
    const bool hasParts = (cursor.number<std::uint32_t>() & kHasParts) != 0;
    PictureSize size{0, 0, 16};
    bool isEmpty = true; // no attribute yet of the present header
    while (!cursor.isAtEnd()) {
        const std::string name = cursor.text();
        if (name.empty()) {
            if (!hasParts || isEmpty) break;
            isEmpty = true;
            continue;
        }
        isEmpty = false;
        cursor.text();
        const auto valueBytes = cursor.number<std::uint32_t>();
        Cursor value = cursor;
        cursor.skip(valueBytes);
        if (name == "dataWindow" || name == "displayWindow") {
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

} // namespace

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

PictureSize claimedSize(std::span<const std::byte> bytes, const std::string& format) {
    if (format == "gif") return gifSize(bytes);
    if (format == "openexr") return exrSize(bytes);
    return {};
}

} // namespace tessera::scenes
