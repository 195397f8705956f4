#include "scenes/AveragedMap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>
#include <tbb/parallel_for.h>

namespace tessera::scenes {
namespace {

/// Of each of `count` parts of an axis of `size` texels, which texels overlap it.
struct Overlap {
    int first;
    std::vector<double> shares; ///< of the part, from the first on
};

/// `measure` tells how much of the axis lies before a place, in texels.
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

} // namespace

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
