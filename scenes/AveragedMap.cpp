#include "scenes/AveragedMap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>
#include <tbb/parallel_for.h>

#include "base/Srgb.h"

namespace tessera::scenes {
namespace {

/// The texels of an axis that one target texel overlaps.
struct Overlap {
    int first;
    std::vector<double> shares; ///< fractions of the target texel, from texel `first` on
};

/// Splits an axis of `size` texels into `count` parts. `measure` integrates the axis up to a position in texels.
template <typename Measure>
std::vector<Overlap> overlaps(int size, int count, const Measure& measure) {
    std::vector<Overlap> parts;
    for (std::int64_t i = 0; i < count; ++i) {
        const double begin = double(i * size) / count, end = double((i + 1) * size) / count;
        Overlap& part = parts.emplace_back(Overlap{int(i * size / count), {}});
        for (int texel = part.first; texel < end; ++texel)
            part.shares.push_back((measure(std::min(texel + 1.0, end)) - measure(std::max(double(texel), begin))) /
                                  (measure(end) - measure(begin)));
    }
    return parts;
}

/// Converts texels to linear values, which can be averaged, and back.
template <typename Texel>
class Coding {
public:
    explicit Coding(bool isSrgb) {
        if constexpr (kIsInteger)
            for (std::size_t code = 0; isSrgb && code <= std::size_t(kOne); ++code)
                linear_.push_back(linearFromSrgb(double(code) / kOne));
    }
    double decoded(Texel code, int channel) const {
        return isEncoded(channel) ? linear_[std::size_t(code)] : double(code) / kOne;
    }
    Texel encoded(double value, int channel) const {
        const double code = isEncoded(channel) ? srgbFromLinear(std::clamp(value, 0.0, 1.0)) : value;
        return kIsInteger ? Texel(std::lround(code * kOne)) : Texel(code);
    }

private:
    static constexpr bool kIsInteger = std::numeric_limits<Texel>::is_integer;
    static constexpr double kOne = kIsInteger ? double(std::numeric_limits<Texel>::max()) : 1.0;

    bool isEncoded(int channel) const { return !linear_.empty() && channel < 3; }

    std::vector<double> linear_; ///< linear value by code; empty: codes are linear
};

template <typename Texel>
void average(const Image& from, Image& to, bool isSrgb) {
    const Coding<Texel> coding(isSrgb);
    const auto length = [](double x) { return x; };
    const auto columns = overlaps(from.width, to.width, length), rows = overlaps(from.height, to.height, length);
    const auto* texels = reinterpret_cast<const Texel*>(from.texels.data());
    auto* averages = reinterpret_cast<Texel*>(to.texels.data());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) {
        for (std::size_t x = 0; x < columns.size(); ++x)
            for (int channel = 0; channel < 4; ++channel) {
                double sum = 0.0;
                for (std::size_t j = 0; j < rows[y].shares.size(); ++j)
                    for (std::size_t i = 0; i < columns[x].shares.size(); ++i) {
                        const std::size_t at = (std::size_t(rows[y].first) + j) * std::size_t(from.width) +
                                               std::size_t(columns[x].first) + i;
                        sum += rows[y].shares[j] * columns[x].shares[i] *
                               coding.decoded(texels[4 * at + std::size_t(channel)], channel);
                    }
                averages[4 * (y * columns.size() + x) + std::size_t(channel)] = coding.encoded(sum, channel);
            }
    });
}

} // namespace

Image averagedPicture(const Image& picture, int width, int height, bool isSrgb) {
    Image coarse;
    coarse.name = picture.name;
    coarse.format = picture.format;
    coarse.width = width;
    coarse.height = height;
    coarse.texels.resize(std::size_t(width) * std::size_t(height) * texelBytes(picture.format));
    switch (picture.format) {
    case TexelFormat::Rgba8Unorm:
        average<std::uint8_t>(picture, coarse, isSrgb);
        break;
    case TexelFormat::Rgba16Unorm:
        average<std::uint16_t>(picture, coarse, isSrgb);
        break;
    case TexelFormat::Rgba32Float:
        average<float>(picture, coarse, isSrgb);
        break;
    }
    return coarse;
}

Image averagedMap(const Image& map, int mostWidth, int mostHeight) {
    Image coarse;
    coarse.name = map.name;
    coarse.format = TexelFormat::Rgba32Float;
    coarse.width = std::min(map.width, mostWidth);
    coarse.height = std::min(map.height, mostHeight);
    coarse.texels.resize(std::size_t(coarse.width) * std::size_t(coarse.height) * sizeof(glm::vec4));
    const auto columns = overlaps(map.width, coarse.width, [](double x) { return x; });
    const auto rows =
        overlaps(map.height, coarse.height, [&](double y) { return -std::cos(std::numbers::pi * y / map.height); });
    tbb::parallel_for(0, coarse.height, [&](int y) {
        const Overlap& row = rows[std::size_t(y)];
        std::byte* out = coarse.texels.data() + std::size_t(y) * std::size_t(coarse.width) * sizeof(glm::vec4);
        for (int x = 0; x < coarse.width; ++x, out += sizeof(glm::vec4)) {
            const Overlap& column = columns[std::size_t(x)];
            glm::dvec3 sum(0.0);
            for (std::size_t j = 0; j < row.shares.size(); ++j)
                for (std::size_t i = 0; i < column.shares.size(); ++i) {
                    const std::size_t at =
                        (std::size_t(row.first) + j) * std::size_t(map.width) + std::size_t(column.first) + i;
                    glm::vec4 texel;
                    std::memcpy(&texel, map.texels.data() + at * sizeof(texel), sizeof(texel));
                    sum += row.shares[j] * column.shares[i] * glm::dvec3(glm::vec3(texel));
                }
            const glm::vec4 texel(glm::vec3(sum), 1.0f);
            std::memcpy(out, &texel, sizeof(texel));
        }
    });
    return coarse;
}

} // namespace tessera::scenes
