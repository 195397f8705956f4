#include "scenes/import/MadeImages.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace tessera::scenes {
namespace {

template <typename T>
T loadAt(const Image& image, std::size_t index) {
    T value;
    std::memcpy(&value, image.texels.data() + index * sizeof(T), sizeof(T));
    return value;
}

/// A stored value, 0..1 for integer formats.
double valueAt(const Image& image, std::size_t texel, int channel) {
    const std::size_t index = texel * 4 + static_cast<std::size_t>(channel);
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return loadAt<std::uint8_t>(image, index) / 255.0;
    case TexelFormat::Rgba16Unorm:
        return loadAt<std::uint16_t>(image, index) / 65535.0;
    case TexelFormat::Rgba32Float:
        return static_cast<double>(loadAt<float>(image, index));
    }
    assert(false && "a texel format that cannot be read");
    return 0.0;
}

template <typename T>
void storeAt(Image& image, std::size_t index, T value) {
    std::memcpy(image.texels.data() + index * sizeof(T), &value, sizeof(T));
}

void setValue(Image& image, std::size_t texel, std::size_t channel, double value) {
    const std::size_t index = texel * 4 + channel;
    const double unit = std::clamp(value, 0.0, 1.0);
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return storeAt(image, index, static_cast<std::uint8_t>(std::lround(unit * 255.0)));
    case TexelFormat::Rgba16Unorm:
        return storeAt(image, index, static_cast<std::uint16_t>(std::lround(unit * 65535.0)));
    case TexelFormat::Rgba32Float:
        return storeAt(image, index, static_cast<float>(value));
    }
    assert(false && "a texel format that cannot be written");
}

} // namespace

Image standInPicture(LoadLedger& ledger, const std::string& who) {
    constexpr int kSquares = 8, kSquareTexels = 8, kSide = kSquares * kSquareTexels;
    using Texel = std::array<std::byte, 4>;
    constexpr Texel kMagenta{std::byte{255}, std::byte{0}, std::byte{255}, std::byte{255}};
    constexpr Texel kGrey{std::byte{40}, std::byte{40}, std::byte{40}, std::byte{255}};
    ledger.charge(kSide * kSide * sizeof(Texel), [&] { return who; });
    Image image;
    image.name = "stand-in for what cannot be read";
    image.width = image.height = kSide;
    image.texels.reserve(kSide * kSide * sizeof(Texel));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Texel& texel = (x / kSquareTexels + y / kSquareTexels) % 2 == 0 ? kMagenta : kGrey;
            image.texels.insert(image.texels.end(), texel.begin(), texel.end());
        }
    return image;
}

Image packChannels(const std::string& name, const std::array<ChannelSource, 4>& sources) {
    Image packed;
    packed.name = name;
    bool isFirst = true;
    for (const ChannelSource& source : sources) {
        if (source.image == nullptr) continue;
        if (isFirst) packed.format = source.image->format;
        isFirst = false;
        packed.width = std::max(packed.width, source.image->width);
        packed.height = std::max(packed.height, source.image->height);
    }
    assert(packed.width > 0 && packed.height > 0 && "at least one channel comes from a picture");
    packed.texels.resize(static_cast<std::size_t>(packed.width) * static_cast<std::size_t>(packed.height) *
                         texelBytes(packed.format));
    std::size_t texel = 0;
    for (std::int64_t y = 0; y < packed.height; ++y) {
        for (std::int64_t x = 0; x < packed.width; ++x, ++texel) {
            for (std::size_t channel = 0; channel < 4; ++channel) {
                double value = 1.0;
                if (const Image* from = sources[channel].image) {
                    const std::int64_t row = y * from->height / packed.height;
                    const std::int64_t column = x * from->width / packed.width;
                    value =
                        valueAt(*from, static_cast<std::size_t>(row * from->width + column), sources[channel].channel);
                    value = sources[channel].offset + sources[channel].scale * value;
                }
                setValue(packed, texel, channel, value);
            }
        }
    }
    return packed;
}

bool hasAlpha(const Image& image) {
    const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    for (std::size_t texel = 0; texel < texels; ++texel) {
        if (valueAt(image, texel, 3) < 1.0) return true;
    }
    return false;
}

} // namespace tessera::scenes
