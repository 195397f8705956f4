#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

#include "base/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// stb_image takes zeros, or whatever stands in memory, for texels that a file lacks: here that is noted.
struct Stream {
    std::span<const std::byte> bytes;
    const char* ahead = nullptr; ///< where stb_image reads more than it needs yet; it begins with that
    bool endsEarly = false;
};

int readStream(void* user, char* target, int count) {
    auto& stream = *static_cast<Stream*>(user);
    if (stream.ahead == nullptr) stream.ahead = target;
    const std::size_t given = std::min(static_cast<std::size_t>(count), stream.bytes.size());
    const std::size_t needed = target == stream.ahead ? 1 : static_cast<std::size_t>(count);
    stream.endsEarly |= given < needed;
    std::memcpy(target, stream.bytes.data(), given);
    stream.bytes = stream.bytes.subspan(given);
    return static_cast<int>(given);
}

void skipStream(void* user, int count) {
    auto& stream = *static_cast<Stream*>(user);
    stream.bytes = stream.bytes.subspan(std::min(static_cast<std::size_t>(count), stream.bytes.size()));
}

int isStreamAtEnd(void* user) {
    return static_cast<Stream*>(user)->bytes.empty() ? 1 : 0;
}

} // namespace

DecodedPicture decodeByStb(std::span<const std::byte> bytes, const std::string& name, const PictureFormat& format,
                           LoadLedger& ledger) {
    constexpr stbi_io_callbacks kCallbacks{readStream, skipStream, isStreamAtEnd};
    constexpr int kChannels = 4;
    DecodedPicture decoded;
    Image& image = decoded.image;
    image.name = name;
    const auto require = [&](bool good, const Stream& stream) {
        if (!good || stream.endsEarly)
            throw InputError(fmt::format("{}: the {} picture is broken or cut short ({}); save it again", name,
                                         format.name,
                                         stream.endsEarly ? "the file ends early" : stbi_failure_reason()));
    };
    int stored = 0;
    Stream header{bytes};
    require(stbi_info_from_callbacks(&kCallbacks, &header, &image.width, &image.height, &stored) != 0, header);
    image.height = static_cast<int>(std::min<std::int64_t>(std::abs(std::int64_t{image.height}), INT_MAX)); // top-down
    // The picture as it is stored, with four channels, and as texels.
    constexpr std::uint64_t kCopies = 3;
    requirePictureSize({image.width, image.height, kCopies * kChannels}, bytes, name, format, ledger);
    Stream stream{bytes};
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
        stbi_load_from_callbacks(&kCallbacks, &stream, &image.width, &image.height, &stored, kChannels),
        stbi_image_free);
    require(texels != nullptr, stream);
    const auto* first = reinterpret_cast<const std::byte*>(texels.get());
    image.texels.assign(first, first + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                           kChannels);
    return decoded;
}

} // namespace tessera::scenes
