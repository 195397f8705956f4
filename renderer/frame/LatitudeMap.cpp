#include "renderer/frame/LatitudeMap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include <tbb/parallel_for.h>

#include "scenes/Environment.h"

namespace tessera::frame {

const glm::vec4& LatitudeMap::at(int x, int y) const {
    const int column = (x % width + width) % width, row = std::clamp(y, 0, height - 1);
    return texels[std::size_t(row) * std::size_t(width) + std::size_t(column)];
}

glm::dvec3 LatitudeMap::radiance(const glm::dvec3& direction) const {
    const glm::dvec2 place = scenes::placeInMap(direction) * glm::dvec2(width, height) - 0.5;
    const glm::dvec2 corner = glm::floor(place), share = place - corner;
    const int x = int(corner.x), y = int(corner.y);
    const auto color = [&](int i, int j) { return glm::dvec3(glm::vec3(at(x + i, y + j))); };
    return glm::mix(glm::mix(color(0, 0), color(1, 0), share.x), glm::mix(color(0, 1), color(1, 1), share.x), share.y);
}

double LatitudeMap::cosineOfRow(int row) const {
    return std::cos(std::numbers::pi * row / height);
}

double LatitudeMap::solidAngle(int row) const {
    return 2.0 * std::numbers::pi / width * (cosineOfRow(row) - cosineOfRow(row + 1));
}

LatitudeMap latitudeMapOf(const scenes::Image& picture) {
    LatitudeMap map{picture.width, picture.height, {}};
    map.texels.resize(std::size_t(map.width) * std::size_t(map.height));
    std::memcpy(map.texels.data(), picture.texels.data(), map.texels.size() * sizeof(glm::vec4));
    return map;
}

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

LatitudeMap coarserMap(const scenes::Image& picture, int mostWidth, int mostHeight) {
    LatitudeMap map{std::min(picture.width, mostWidth), std::min(picture.height, mostHeight), {}};
    map.texels.resize(std::size_t(map.width) * std::size_t(map.height));
    const auto columns = overlaps(picture.width, map.width, [](double x) { return x; });
    const auto rows = overlaps(picture.height, map.height,
                               [&](double y) { return -std::cos(std::numbers::pi * y / picture.height); });
    tbb::parallel_for(0, map.height, [&](int y) {
        const Overlap& row = rows[std::size_t(y)];
        for (int x = 0; x < map.width; ++x) {
            const Overlap& column = columns[std::size_t(x)];
            glm::dvec3 sum(0.0);
            for (std::size_t j = 0; j < row.shares.size(); ++j)
                for (std::size_t i = 0; i < column.shares.size(); ++i) {
                    const std::size_t at =
                        (std::size_t(row.first) + j) * std::size_t(picture.width) + std::size_t(column.first) + i;
                    glm::vec4 texel;
                    std::memcpy(&texel, picture.texels.data() + at * sizeof(texel), sizeof(texel));
                    sum += row.shares[j] * column.shares[i] * glm::dvec3(glm::vec3(texel));
                }
            map.texels[std::size_t(y) * std::size_t(map.width) + std::size_t(x)] = glm::vec4(glm::vec3(sum), 1.0f);
        }
    });
    return map;
}

} // namespace tessera::frame
