#include "scenes/import/MadeImages.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

/// A stored channel, 0..1 for integer formats.
double channelAt(const Image& image, std::size_t index) {
    return withChannel(image.format, [&]<typename Channel>(Channel) {
        return double(texelsOf<Channel>(image)[index]) / double(kOneOf<Channel>);
    });
}

void setChannel(Image& image, std::size_t index, double value) {
    withChannel(image.format, [&]<typename Channel>(Channel) {
        if (std::is_integral_v<Channel>) value = std::round(std::clamp(value, 0.0, 1.0) * double(kOneOf<Channel>));
        texelsOf<Channel>(image)[index] = Channel(value);
    });
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

std::vector<glm::vec2> boxCoordinates(const Mesh& mesh) {
    glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
    for (const glm::vec3& position : mesh.positionsOS) {
        least = glm::min(least, glm::dvec3(position));
        most = glm::max(most, glm::dvec3(position));
    }
    const glm::dvec3 sides = most - least;
    const double longest = std::max({sides.x, sides.y, sides.z, double(std::numeric_limits<float>::min())});
    std::vector<glm::vec2> coordinates;
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::dvec3 place = (glm::dvec3(mesh.positionsOS[i]) - least) / longest,
                         normal = glm::abs(mesh.normalsOS[i]);
        const bool isAlongX = normal.x > std::max(normal.y, normal.z), isAlongY = !isAlongX && normal.y > normal.z;
        coordinates.emplace_back(isAlongX ? place.z : place.x, isAlongY ? place.z : place.y);
    }
    return coordinates;
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
    packed.texels.resize(std::size_t(packed.width) * std::size_t(packed.height) * texelBytes(packed.format));
    std::size_t texel = 0;
    for (std::int64_t y = 0; y < packed.height; ++y) {
        for (std::int64_t x = 0; x < packed.width; ++x, ++texel) {
            for (std::size_t channel = 0; channel < 4; ++channel) {
                double value = 1.0;
                if (const Image* from = sources[channel].image) {
                    const std::int64_t row = y * from->height / packed.height;
                    const std::int64_t column = x * from->width / packed.width;
                    const std::int64_t index = 4 * (row * from->width + column) + sources[channel].channel;
                    value = sources[channel].offset + sources[channel].scale * channelAt(*from, std::size_t(index));
                }
                setChannel(packed, 4 * texel + channel, value);
            }
        }
    }
    return packed;
}

bool hasAlpha(const Image& image) {
    const std::size_t texels = std::size_t(image.width) * std::size_t(image.height);
    for (std::size_t texel = 0; texel < texels; ++texel)
        if (channelAt(image, 4 * texel + 3) < 1.0) return true;
    return false;
}

} // namespace tessera::scenes
