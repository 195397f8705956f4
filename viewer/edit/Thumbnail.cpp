#include "viewer/edit/Thumbnail.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tessera::viewer {
namespace {

template <typename Component>
glm::vec4 componentsAt(const std::byte* texel, float white) {
    Component values[4];
    std::memcpy(values, texel, sizeof values);
    return glm::vec4(values[0], values[1], values[2], values[3]) / white;
}

} // namespace

glm::vec4 texelOf(const scenes::Image& image, int x, int y) {
    const std::size_t number = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
    const std::byte* const texel = image.texels.data() + number * scenes::texelBytes(image.format);
    switch (image.format) {
    case scenes::TexelFormat::Rgba8Unorm:
        return componentsAt<std::uint8_t>(texel, 255.0f);
    case scenes::TexelFormat::Rgba16Unorm:
        return componentsAt<std::uint16_t>(texel, 65535.0f);
    case scenes::TexelFormat::Rgba32Float:
        break;
    }
    return componentsAt<float>(texel, 1.0f);
}

Thumbnail thumbnailOf(const scenes::Image& image, int mostPixels) {
    Thumbnail small;
    const glm::ivec2 size(image.width, image.height);
    if (size.x < 1 || size.y < 1 || image.texels.empty()) return small;
    const double share = std::min(1.0, double(mostPixels) / std::max(size.x, size.y));
    small.sizePixels = glm::max(glm::ivec2(glm::round(share * glm::dvec2(size))), glm::ivec2(1));
    constexpr int kMostSamples = 4; // per side of a pixel: large images are not read completely
    const glm::dvec2 step = glm::dvec2(size) / glm::dvec2(small.sizePixels);
    const glm::ivec2 samples = glm::clamp(glm::ivec2(glm::ceil(step)), 1, kMostSamples);
    for (int y = 0; y < small.sizePixels.y; ++y)
        for (int x = 0; x < small.sizePixels.x; ++x) {
            glm::vec4 sum(0.0f);
            for (int row = 0; row < samples.y; ++row)
                for (int column = 0; column < samples.x; ++column) {
                    const glm::dvec2 within = (glm::dvec2(column, row) + 0.5) / glm::dvec2(samples);
                    const glm::ivec2 texel(glm::floor((glm::dvec2(x, y) + within) * step));
                    sum += glm::clamp(texelOf(image, std::min(texel.x, size.x - 1), std::min(texel.y, size.y - 1)),
                                      0.0f, 1.0f);
                }
            small.pixels.emplace_back(glm::round(255.0f * sum / float(samples.x * samples.y)));
        }
    return small;
}

} // namespace tessera::viewer
