#include <cstring>
#include <limits>

#include <fmt/format.h>

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

#include "scenes/Error.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {

DecodedPicture decodeByStb(std::span<const std::byte> bytes, const std::string& name, const PictureFormat& format,
                           LoadLedger& ledger) {
    const auto require = [&](bool good) {
        if (!good)
            throw InputError(fmt::format("{}: the {} picture is broken or cut short ({}); save it again", name,
                                         format.name, stbi_failure_reason()));
    };
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
        throw InputError(fmt::format("{}: the {} picture is larger than 2 GiB; convert it to PNG", name, format.name));
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const auto count = static_cast<int>(bytes.size());
    constexpr int kChannels = 4;
    DecodedPicture decoded;
    Image& image = decoded.image;
    image.name = name;
    int stored = 0;
    require(stbi_info_from_memory(data, count, &image.width, &image.height, &stored) != 0);
    // The picture as it is stored, with four channels, and as texels.
    constexpr std::uint64_t kCopies = 3;
    requirePictureSize({image.width, image.height, kCopies * kChannels}, bytes, name, ledger);
    stbi_uc* texels = stbi_load_from_memory(data, count, &image.width, &image.height, &stored, kChannels);
    require(texels != nullptr);
    const auto* first = reinterpret_cast<const std::byte*>(texels);
    image.texels.assign(first, first + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                           kChannels);
    stbi_image_free(texels);
    return decoded;
}

} // namespace tessera::scenes
