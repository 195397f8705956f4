#include <algorithm>
#include <climits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// Numbers of a TIFF file, in its order of bytes; 0 beyond its end. Source: Adobe 1992, TIFF revision 6.0, section 2.
class Tiff {
public:
    explicit Tiff(std::span<const std::byte> bytes)
        : bytes_(bytes), isBigEndian_(!bytes.empty() && bytes[0] == std::byte{'M'}) {}

    std::uint64_t number(std::size_t at, int count) const {
        std::uint64_t value = 0;
        for (int i = 0; i < count; ++i) {
            const std::size_t place = at + std::size_t(isBigEndian_ ? i : count - 1 - i);
            value = value << 8 | (place < bytes_.size() ? std::to_integer<std::uint64_t>(bytes_[place]) : 0);
        }
        return value;
    }

    /// The entry of a tag in the first directory, or 0.
    std::size_t entryOf(std::uint64_t tag) const {
        const std::size_t directory = number(4, 4);
        const std::uint64_t entries = number(directory, 2);
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::size_t entry = directory + 2 + 12 * i;
            if (number(entry, 2) == tag) return entry;
        }
        return 0;
    }

    /// The first number that a tag has, or `otherwise`.
    std::uint64_t valueOf(std::uint64_t tag, std::uint64_t otherwise) const {
        constexpr std::uint64_t kShort = 3;
        const std::size_t entry = entryOf(tag);
        if (entry == 0) return otherwise;
        const int size = number(entry + 2, 2) == kShort ? 2 : 4;
        const bool isElsewhere = number(entry + 4, 4) * std::uint64_t(size) > 4;
        return number(isElsewhere ? number(entry + 8, 4) : entry + 8, size);
    }

    /// The bytes of a tag, as far as the file has them.
    std::string_view textOf(std::uint64_t tag) const {
        const std::size_t entry = entryOf(tag);
        if (entry == 0) return {};
        const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
        const std::size_t first = std::min<std::size_t>(number(entry + 8, 4), text.size());
        return text.substr(first, number(entry + 4, 4));
    }

private:
    std::span<const std::byte> bytes_;
    bool isBigEndian_;
};

constexpr int kTooDeep = INT_MAX;

/// Where the tag that begins at `at` ends: at the first > outside quotes.
std::size_t endOfTag(std::string_view xml, std::size_t at) {
    char quote = 0;
    for (; at < xml.size(); ++at) {
        if (quote != 0)
            quote = xml[at] == quote ? 0 : quote;
        else if (xml[at] == '"' || xml[at] == '\'')
            quote = xml[at];
        else if (xml[at] == '>')
            break;
    }
    return std::min(at, xml.size());
}

/// How deep the elements of an XML text nest.
int depthOfXml(std::string_view xml) {
    constexpr std::pair<std::string_view, std::string_view> kSkipped[] = {
        {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
    int depth = 0, deepest = 0;
    for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
        const std::string_view rest = xml.substr(at);
        const auto skipped =
            std::ranges::find_if(kSkipped, [&](const auto& row) { return rest.starts_with(row.first); });
        if (skipped != std::end(kSkipped)) {
            at = xml.find(skipped->second, at + skipped->first.size());
        } else if (rest.starts_with("<!")) {
            return kTooDeep; // declarations, which descriptions have none of, may hide anything
        } else if (rest.starts_with("</")) {
            depth = std::max(depth - 1, 0);
            ++at;
        } else {
            deepest = std::max(deepest, ++depth);
            at = endOfTag(xml, at);
            if (xml[at - 1] == '/') --depth;
        }
    }
    return deepest;
}

} // namespace

/// libtiff and OpenImageIO reserve whole tiles, however small the picture is. OpenImageIO reads the description (XMP)
/// by recursion, which tens of thousands of levels end.
PictureSize claimedSizeOfTiff(std::span<const std::byte> bytes) {
    constexpr std::uint64_t kWidth = 256, kHeight = 257, kBits = 258, kSamples = 277, kTileWidth = 322,
                            kTileHeight = 323, kXmp = 700;
    constexpr int kMaxXmpDepth = 256; // Adobe's programs nest about ten deep
    const Tiff tiff(bytes);
    if (depthOfXml(tiff.textOf(kXmp)) > kMaxXmpDepth)
        throw std::runtime_error(fmt::format("its XMP description nests more than {} deep", kMaxXmpDepth));
    const auto wholeTiles = [&](std::uint64_t side, std::uint64_t tile) {
        return std::int64_t(tile == 0 ? side : (std::max<std::uint64_t>(side, 1) + tile - 1) / tile * tile);
    };
    const std::uint64_t bytesASample = std::max<std::uint64_t>((tiff.valueOf(kBits, 1) + 7) / 8, 1);
    // A row of tiles as it is stored and as it is handed over.
    return {wholeTiles(tiff.valueOf(kWidth, 0), tiff.valueOf(kTileWidth, 0)),
            wholeTiles(tiff.valueOf(kHeight, 0), tiff.valueOf(kTileHeight, 0)),
            2 * bytesASample * std::max<std::uint64_t>(tiff.valueOf(kSamples, 1), 1)};
}

} // namespace tessera::scenes
