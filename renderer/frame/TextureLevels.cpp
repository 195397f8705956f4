#include "renderer/frame/TextureLevels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <tbb/parallel_for.h>

namespace tessera::frame {

namespace {

using scenes::TexelFormat;

// IEC 61966-2-1, both in double.
double decodeSrgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
double encodeSrgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// A level in linear light.
struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels;
    const glm::vec4* row(int y) const { return texels.data() + std::size_t(y) * std::size_t(width); }
};

template <class Component>
Component componentAt(const scenes::Image& image, std::size_t index) {
    Component component;
    std::memcpy(&component, image.texels.data() + index * sizeof component, sizeof component);
    return component;
}

/// A component of an image, in linear light.
float linearAt(const scenes::Image& image, bool srgb, std::size_t index) {
    if (image.format == TexelFormat::Rgba32Float) return componentAt<float>(image, index);
    const bool isEncoded = srgb && index % 4 != 3;
    if (image.format == TexelFormat::Rgba16Unorm) {
        const double code = componentAt<std::uint16_t>(image, index) / 65535.0;
        return float(isEncoded ? decodeSrgb(code) : code);
    }
    static const auto linear = [] {
        std::array<float, 256> byCode{};
        for (std::size_t code = 0; code < byCode.size(); ++code) byCode[code] = float(decodeSrgb(double(code) / 255.0));
        return byCode;
    }();
    const auto code = componentAt<std::uint8_t>(image, index);
    return isEncoded ? linear[code] : float(code / 255.0);
}

/// The texels of a larger level that one texel of the smaller level covers; the first and the last one partly.
struct Span {
    int first, last;
    double firstShare, lastShare; ///< covered fractions
};

Span spanOf(int index, int size, int sizeBefore) {
    // In integer units of 1/size of a texel, so that all is exact.
    const std::int64_t begin = std::int64_t(index) * sizeBefore, end = std::int64_t(index + 1) * sizeBefore;
    const int first = int(begin / size), last = int((end - 1) / size);
    return {first, last, double(std::int64_t(first + 1) * size - begin) / size,
            double(end - std::int64_t(last) * size) / size};
}

/// The weighted mean of a span's texels; `texel` returns them by index. The mean of equal texels is exact.
template <class Texel>
glm::dvec4 meanOver(const Span& span, const Texel& texel) {
    if (span.first == span.last) return texel(span.first);
    const glm::dvec4 first = texel(span.first);
    glm::dvec4 beyond = span.lastShare * (texel(span.last) - first);
    for (int i = span.first + 1; i < span.last; ++i) beyond += texel(i) - first;
    return first + beyond / (span.firstShare + span.lastShare + double(span.last - span.first - 1));
}

/// The next smaller level; `texel` returns texels of the larger one by column and row.
template <class Texel>
Level halved(int width, int height, const Texel& texel) {
    Level next{std::max(width / 2, 1), std::max(height / 2, 1), {}};
    next.texels.resize(std::size_t(next.width) * std::size_t(next.height));
    tbb::parallel_for(0, next.height, [&](int y) {
        const Span rows = spanOf(y, next.height, height);
        for (int x = 0; x < next.width; ++x) {
            const Span columns = spanOf(x, next.width, width);
            next.texels[std::size_t(y) * std::size_t(next.width) + std::size_t(x)] =
                glm::vec4(meanOver(rows, [&](int row) {
                    return meanOver(columns, [&](int column) { return glm::dvec4(texel(column, row)); });
                }));
        }
    });
    return next;
}

/// Level 1. Decodes on the fly: a copy of level 0 in linear light would take four times the image's memory.
Level firstLevel(const scenes::Image& image, bool srgb) {
    return halved(image.width, image.height, [&](int column, int row) {
        const std::size_t first = 4 * (std::size_t(row) * std::size_t(image.width) + std::size_t(column));
        glm::vec4 texel;
        for (std::size_t c = 0; c < 4; ++c) texel[int(c)] = linearAt(image, srgb, first + c);
        return texel;
    });
}

template <class Component, class Encode>
std::vector<std::byte> encoded(const Level& level, const Encode& encode) {
    std::vector<std::byte> bytes(level.texels.size() * 4 * sizeof(Component));
    for (std::size_t i = 0; i < 4 * level.texels.size(); ++i) {
        const Component component = encode(level.texels[i / 4][int(i % 4)], i % 4 == 3);
        std::memcpy(bytes.data() + i * sizeof component, &component, sizeof component);
    }
    return bytes;
}

std::vector<std::byte> storedLevel(const Level& level, graph::Format format) {
    if (format == graph::Format::Rgba32Float) return encoded<float>(level, [](float value, bool) { return value; });
    if (format == graph::Format::Rgba16Unorm)
        return encoded<std::uint16_t>(level, [](float value, bool) { return std::uint16_t(value * 65535.0 + 0.5); });
    const bool srgb = format == graph::Format::Srgb8Alpha8;
    return encoded<std::uint8_t>(level, [&](float value, bool isAlpha) {
        return std::uint8_t((srgb && !isAlpha ? encodeSrgb(value) : double(value)) * 255.0 + 0.5);
    });
}

} // namespace

graph::Format storedFormat(TexelFormat format, bool srgb) {
    if (format == TexelFormat::Rgba8Unorm) return srgb ? graph::Format::Srgb8Alpha8 : graph::Format::Rgba8Unorm;
    if (format == TexelFormat::Rgba16Unorm && !srgb) return graph::Format::Rgba16Unorm;
    return graph::Format::Rgba32Float;
}

bool isStoredDecoded(const scenes::Image& image, bool srgb) {
    return image.format == TexelFormat::Rgba16Unorm && srgb;
}

std::vector<float> decodedTexels(const scenes::Image& image) {
    std::vector<float> linear(std::size_t(image.width) * std::size_t(image.height) * 4);
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearAt(image, true, i);
    return linear;
}

bool hasOddLevel(int width, int height) {
    return (width & (width - 1)) != 0 || (height & (height - 1)) != 0;
}

std::vector<std::vector<std::byte>> smallerLevels(const scenes::Image& image, bool srgb) {
    std::vector<std::vector<std::byte>> levels;
    if (std::max(image.width, image.height) == 1) return levels;
    Level level = firstLevel(image, srgb);
    levels.push_back(storedLevel(level, storedFormat(image.format, srgb)));
    while (std::max(level.width, level.height) > 1) {
        level = halved(level.width, level.height, [&](int column, int row) { return level.row(row)[column]; });
        levels.push_back(storedLevel(level, storedFormat(image.format, srgb)));
    }
    return levels;
}

} // namespace tessera::frame
