#include "scenes/builtin/Pictures.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <vector>

#include <tbb/parallel_for.h>

namespace tessera::scenes::builtin {
namespace {

Image blank(const std::string& name, TexelFormat format, int width, int height) {
    Image image;
    image.name = name;
    image.format = format;
    image.width = width;
    image.height = height;
    image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * texelBytes(format));
    return image;
}

std::byte toByte(double value) {
    return static_cast<std::byte>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// The transfer function as a table: a step of a byte is at least 3e-4 wide in linear values, so 16384 entries lose
/// nothing visible.
std::byte toSrgbByte(double linear) {
    constexpr int kEntries = 16384;
    static const auto table = [] {
        std::array<std::byte, kEntries + 1> bytes{};
        for (int i = 0; i <= kEntries; ++i) {
            const double l = static_cast<double>(i) / kEntries;
            const double encoded = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
            bytes[static_cast<std::size_t>(i)] = toByte(encoded);
        }
        return bytes;
    }();
    return table[static_cast<std::size_t>(std::lround(kEntries * std::clamp(linear, 0.0, 1.0)))];
}

template <typename Encode>
Image drawBytes(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& texel,
                Encode encode) {
    Image image = blank(name, TexelFormat::Rgba8Unorm, width, height);
    tbb::parallel_for(0, height, [&](int y) {
        std::byte* out = image.texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 4;
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 value = texel(x, y);
            for (glm::length_t k = 0; k < 3; ++k) *out++ = encode(value[k]);
            *out++ = std::byte{255};
        }
    });
    return image;
}

} // namespace

Image drawColors(const std::string& name, int width, int height,
                 const std::function<glm::dvec3(int, int)>& linearColor) {
    return drawBytes(name, width, height, linearColor, toSrgbByte);
}

Image drawValues(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& value) {
    return drawBytes(name, width, height, value, toByte);
}

Image drawNormals(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& normal) {
    Image image = blank(name, TexelFormat::Rgba16Unorm, width, height);
    tbb::parallel_for(0, height, [&](int y) {
        std::byte* out = image.texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 8;
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 n = normal(x, y);
            std::array<std::uint16_t, 4> texel{0, 0, 0, 65535};
            for (glm::length_t k = 0; k < 3; ++k) {
                const double stored = std::clamp(0.5 + 0.5 * n[k], 0.0, 1.0);
                texel[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(std::lround(65535.0 * stored));
            }
            std::memcpy(out, texel.data(), sizeof(texel));
            out += sizeof(texel);
        }
    });
    return image;
}

Image drawRadiance(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& radiance,
                   const std::function<void(double)>& progress) {
    Image image = blank(name, TexelFormat::Rgba32Float, width, height);
    std::atomic<int> rows = 0;
    const std::size_t rowBytes = static_cast<std::size_t>(width) * sizeof(glm::vec4);
    tbb::parallel_for(0, height, [&](int y) {
        std::byte* out = image.texels.data() + static_cast<std::size_t>(y) * rowBytes;
        for (int x = 0; x < width; ++x, out += sizeof(glm::vec4)) {
            const glm::vec4 texel(glm::vec3(radiance(x, y)), 1.0f);
            std::memcpy(out, &texel, sizeof(texel));
        }
        if (progress) progress(++rows / double(height));
    });
    return image;
}

Image normalsFromHeights(const std::string& name, int size, double texelMetres,
                         const std::function<double(int, int)>& heightMetres) {
    std::vector<double> heights(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    tbb::parallel_for(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)] =
                heightMetres(x, y);
        }
    });
    const auto height = [&](int x, int y) {
        return heights[static_cast<std::size_t>((y + size) % size) * static_cast<std::size_t>(size) +
                       static_cast<std::size_t>((x + size) % size)];
    };
    return drawNormals(name, size, size, [&](int x, int y) {
        const double slopeRight = (height(x + 1, y) - height(x - 1, y)) / (2.0 * texelMetres);
        const double slopeUp = (height(x, y - 1) - height(x, y + 1)) / (2.0 * texelMetres);
        return glm::normalize(glm::dvec3(-slopeRight, -slopeUp, 1.0));
    });
}

} // namespace tessera::scenes::builtin
