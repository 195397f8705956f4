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

} // namespace

/// Source: GIF89a specification, section 18, "Logical Screen Descriptor".
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes) {
    if (bytes.size() < 10) return {};
    const auto number = [&](std::size_t at) {
        return std::to_integer<int>(bytes[at]) + 256 * std::to_integer<int>(bytes[at + 1]);
    };
    return {number(6), number(8), 4};
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
