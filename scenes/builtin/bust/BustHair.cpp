#include "scenes/builtin/bust/BustHair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/builtin/Noise.h"

namespace tessera::scenes::builtin {
namespace {

constexpr std::uint32_t kHairSeed = 29;
constexpr double kCellBU = 0.27;   // about one curl per cell
constexpr double kDomeBU = 0.05;   // height of a curl's middle
constexpr double kPitchBU = 0.055; // from one turn of the spiral to the next

/// Position of a cell's point within the cell.
glm::dvec3 scatterIn(const glm::ivec3& cell) {
    return {hashUnit(cell.x, cell.y, cell.z, kHairSeed), hashUnit(cell.x, cell.y, cell.z, kHairSeed + 1),
            hashUnit(cell.x, cell.y, cell.z, kHairSeed + 2)};
}

/// The same, from a table of the bust's cells: a bust calls it a hundred million times.
glm::dvec3 knownScatterIn(const glm::ivec3& cell) {
    constexpr int kReach = 10, kSide = 2 * kReach; // cells
    static const std::vector<glm::dvec3> table = [] {
        std::vector<glm::dvec3> scatters;
        for (int k = -kReach; k < kReach; ++k)
            for (int j = -kReach; j < kReach; ++j)
                for (int i = -kReach; i < kReach; ++i) scatters.push_back(scatterIn({i, j, k}));
        return scatters;
    }();
    const glm::ivec3 place = cell + kReach;
    const bool isIn =
        glm::all(glm::greaterThanEqual(place, glm::ivec3(0))) && glm::all(glm::lessThan(place, glm::ivec3(kSide)));
    return isIn ? table[std::size_t((place.z * kSide + place.y) * kSide + place.x)] : scatterIn(cell);
}

} // namespace

BustCurl bustCurl(const glm::dvec3& pointBU) {
    // Curls are the cells of points scattered one per cube (Worley 1996, "A cellular texture basis function").
    const glm::dvec3 scaled = pointBU / kCellBU;
    const glm::ivec3 cell(glm::floor(scaled));
    double nearest = 9.0;
    double second = 9.0;
    glm::dvec3 centerBU(0.0);
    double turn = 0.0;
    for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const glm::ivec3 c = cell + glm::ivec3(i, j, k);
                const glm::dvec3 scatter = knownScatterIn(c);
                const glm::dvec3 point = glm::dvec3(c) + 0.2 + 0.6 * scatter;
                const double distance = glm::distance(scaled, point);
                if (distance < nearest) {
                    second = nearest;
                    nearest = distance;
                    centerBU = kCellBU * point;
                    turn = scatter.x;
                } else {
                    second = std::min(second, distance);
                }
            }
        }
    }
    // The spiral lies in the skull's tangent plane below the curl.
    const glm::dvec3 out = glm::normalize(centerBU - glm::dvec3(0.0, 0.1, -0.15));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.13, 0.98, 0.15), out));
    const glm::dvec3 up = glm::cross(out, right);
    const glm::dvec3 arm = pointBU - centerBU;
    const double x = glm::dot(arm, right);
    const double y = glm::dot(arm, up);
    const double radius = std::hypot(x, y);
    const double angle = std::atan2(y, x) * (turn < 0.5 ? 1.0 : -1.0);

    BustCurl curl;
    const double t = std::clamp((second - nearest) / 0.5, 0.0, 1.0);
    curl.inside = t * t * (3.0 - 2.0 * t);
    curl.height = kDomeBU * curl.inside;
    curl.groove = std::cos(angle + 2.0 * std::numbers::pi * (radius / kPitchBU + turn));
    return curl;
}

} // namespace tessera::scenes::builtin
