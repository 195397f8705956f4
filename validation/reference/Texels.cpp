#include "validation/reference/Texels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tessera::reference {

namespace {

/// Component `component` of texel `index`, 0..1 for normalised formats.
double storedAt(const scenes::Image& image, std::size_t index, std::size_t component) {
    const std::size_t at = 4 * index + component;
    switch (image.format) {
    case scenes::TexelFormat::Rgba8Unorm:
        return std::to_integer<int>(image.texels[at]) / 255.0;
    case scenes::TexelFormat::Rgba16Unorm: {
        std::uint16_t word = 0;
        std::memcpy(&word, &image.texels[at * sizeof word], sizeof word);
        return word / 65535.0;
    }
    case scenes::TexelFormat::Rgba32Float:
        break;
    }
    float value = 0.0f;
    std::memcpy(&value, &image.texels[at * sizeof value], sizeof value);
    return double(value);
}

} // namespace

Transfer transferOf(scenes::TextureSlot slot) {
    switch (slot) {
    case scenes::TextureSlot::BaseColor:
    case scenes::TextureSlot::Emissive:
    case scenes::TextureSlot::SpecularColor:
    case scenes::TextureSlot::SheenColor:
        return Transfer::Srgb;
    default:
        return Transfer::Linear;
    }
}

double linearFromSrgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

glm::dvec4 texelAt(const scenes::Image& image, Transfer transfer, int column, int row) {
    const std::size_t index = std::size_t(row) * std::size_t(image.width) + std::size_t(column);
    const bool decodes = transfer == Transfer::Srgb && image.format != scenes::TexelFormat::Rgba32Float;
    glm::dvec4 texel;
    for (int c = 0; c < 4; ++c) {
        const double stored = storedAt(image, index, std::size_t(c));
        texel[c] = decodes && c < 3 ? linearFromSrgb(stored) : stored;
    }
    return texel;
}

int wrapped(long long index, int size, scenes::Wrap wrap) {
    if (wrap == scenes::Wrap::ClampToEdge) return int(std::clamp<long long>(index, 0, size - 1));
    const auto modulo = [index](long long period) { return (index % period + period) % period; };
    if (wrap == scenes::Wrap::Repeat) return int(modulo(size));
    const long long inside = modulo(2LL * size);
    return int(inside < size ? inside : 2LL * size - 1 - inside);
}

glm::dvec2 transformed(const scenes::TextureTransform& transform, const glm::dvec2& uv) {
    const glm::dvec2 scaled = glm::dvec2(transform.scale) * uv;
    const double sine = std::sin(double(transform.rotationRadians)),
                 cosine = std::cos(double(transform.rotationRadians));
    // v points down, so a counter-clockwise turn carries (1, 0) to (cosine, -sine).
    const glm::dvec2 turned(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x);
    return glm::dvec2(transform.offset) + turned;
}

} // namespace tessera::reference
