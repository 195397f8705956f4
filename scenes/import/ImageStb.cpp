#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// The input of stb_image. Detects a truncated file, whose missing texels stb_image fills with zeros or stale memory.
struct Stream {
    std::span<const std::byte> bytes;
    const char* ahead = nullptr; ///< stb_image's read-ahead buffer, which it fills first
    bool endsEarly = false;
};

int readStream(void* user, char* target, int count) {
    auto& stream = *static_cast<Stream*>(user);
    if (stream.ahead == nullptr) stream.ahead = target;
    const std::size_t given = std::min(std::size_t(count), stream.bytes.size());
    const std::size_t needed = target == stream.ahead ? 1 : std::size_t(count);
    stream.endsEarly |= given < needed;
    std::memcpy(target, stream.bytes.data(), given);
    stream.bytes = stream.bytes.subspan(given);
    return int(given);
}

void skipStream(void* user, int count) {
    auto& stream = *static_cast<Stream*>(user);
    stream.bytes = stream.bytes.subspan(std::min(std::size_t(count), stream.bytes.size()));
}

int isStreamAtEnd(void* user) {
    return static_cast<Stream*>(user)->bytes.empty() ? 1 : 0;
}

} // namespace

DecodedPicture decodeByStb(const PictureSource& source) {
    constexpr stbi_io_callbacks kCallbacks{readStream, skipStream, isStreamAtEnd};
    constexpr int kChannels = 4;
    const auto require = [&](bool isGood, const Stream& stream) {
        if (stream.endsEarly) source.fail("the file ends early");
        if (!isGood) source.fail(stbi_failure_reason());
    };
    int width = 0, height = 0, stored = 0;
    Stream header{source.bytes};
    require(stbi_info_from_callbacks(&kCallbacks, &header, &width, &height, &stored) != 0, header);
    height = int(std::min<std::int64_t>(std::abs(std::int64_t{height}), INT_MAX)); // top-down
    // The image as stored, with four channels, and as texels.
    constexpr std::uint64_t kCopies = 3;
    DecodedPicture decoded = source.blank(width, height, TexelFormat::Rgba8Unorm, kCopies * kChannels);
    Stream stream{source.bytes};
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
        stbi_load_from_callbacks(&kCallbacks, &stream, &decoded.image.width, &decoded.image.height, &stored, kChannels),
        stbi_image_free);
    require(texels != nullptr, stream);
    const auto* first = reinterpret_cast<const std::byte*>(texels.get());
    const std::size_t count = std::size_t(decoded.image.width) * std::size_t(decoded.image.height);
    decoded.image.texels.assign(first, first + count * kChannels);
    return decoded;
}

} // namespace tessera::scenes
