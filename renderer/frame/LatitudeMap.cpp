#include "renderer/frame/LatitudeMap.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "scenes/AveragedMap.h"
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

LatitudeMap coarserMap(const scenes::Image& picture, int mostWidth, int mostHeight) {
    if (picture.width <= mostWidth && picture.height <= mostHeight) return latitudeMapOf(picture);
    return latitudeMapOf(scenes::averagedMap(picture, mostWidth, mostHeight));
}

} // namespace tessera::frame
