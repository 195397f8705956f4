#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "scenes/import/PictureCodecs.h"

/// OpenEXR's reader believes a header: it reserves what a value claims to take, 2 GiB at most, before it reads it. So
/// the header is read here first, and by the same rules, or something could be hidden between the two.
namespace tessera::scenes {
namespace {

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

    /// Up to a zero byte, which is taken too. Throws std::runtime_error where it is longer than OpenEXR lets names be.
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
    /// The next `count` bytes alone.
    Cursor part(std::size_t count) const { return Cursor(bytes_.first(std::min(at_ + count, bytes_.size())), at_); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_;
};

/// Values of these types take so many bytes, whatever they claim: the reader does not look.
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

struct Attribute {
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

/// The largest of the parts and their tiles. Source: "OpenEXR File Layout": attributes of name, type, size and value up
/// to an empty name; of several parts up to an empty header.
PictureSize claimedSizeOfExr(std::span<const std::byte> bytes) {
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
        const std::string type = cursor.text();
        const auto claimedBytes = cursor.number<std::uint32_t>();
        Attribute attribute{name, type, cursor.part(claimedBytes)};
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
