#include "renderer/frame/EnvironmentIrradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/frame/LatitudeMap.h"
#include "scenes/Environment.h"

namespace tessera::frame {

namespace {

using std::numbers::pi;

/// Normalised associated Legendre functions, by cosine and sine of the polar angle; (l, m) at l (l + 1) / 2 + m.
/// Source: Press et al. 2007, "Numerical Recipes", section 6.7.
std::vector<double> legendre(int order, double cosine, double sine) {
    std::vector<double> p(std::size_t(order + 1) * std::size_t(order + 2) / 2);
    const auto at = [&](int l, int m) -> double& { return p[std::size_t(l * (l + 1) / 2 + m)]; };
    double diagonal = std::sqrt(1.0 / (4.0 * pi));
    for (int m = 0; m <= order; ++m) {
        if (m > 0) diagonal *= -sine * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
        at(m, m) = diagonal;
        if (m < order) at(m + 1, m) = cosine * std::sqrt(2.0 * m + 3.0) * diagonal;
        for (int l = m + 2; l <= order; ++l) {
            const double a = std::sqrt((4.0 * l * l - 1.0) / (double(l) * l - double(m) * m));
            const double b = std::sqrt(((l - 1.0) * (l - 1.0) - double(m) * m) / (4.0 * (l - 1.0) * (l - 1.0) - 1.0));
            at(l, m) = a * (cosine * at(l - 1, m) - b * at(l - 2, m));
        }
    }
    return p;
}

/// Factor by which convolution with the clamped cosine scales harmonics of degree l.
double cosineFactor(int l) {
    if (l == 0) return pi;
    if (l == 1) return 2.0 * pi / 3.0;
    if (l % 2 == 1) return 0.0;
    double ratio = 1.0; // l! / (2^l (l/2)!^2)
    for (int i = 1; i <= l / 2; ++i) ratio *= (2.0 * i - 1.0) / (2.0 * i);
    return 2.0 * pi * ((l / 2) % 2 == 1 ? 1.0 : -1.0) / ((l + 2.0) * (l - 1.0)) * ratio;
}

struct Harmonics {
    std::vector<glm::dvec3> cosines, sines; ///< indexed as in legendre()
};

Harmonics harmonicsOf(const LatitudeMap& map, int order) {
    const std::size_t count = std::size_t(order + 1) * std::size_t(order + 2) / 2;
    Harmonics sum{std::vector<glm::dvec3>(count, glm::dvec3(0.0)), std::vector<glm::dvec3>(count, glm::dvec3(0.0))};
    // Per column: cosine and sine of its longitude, and of m times its longitude.
    std::vector<glm::dvec2> longitudes(std::size_t(map.width)), turns(std::size_t(map.width));
    for (int x = 0; x < map.width; ++x) {
        const double longitude = 2.0 * pi * ((x + 0.5) / map.width - 0.5);
        longitudes[std::size_t(x)] = {std::cos(longitude), std::sin(longitude)};
    }
    for (int row = 0; row < map.height; ++row) {
        const double cosine = 0.5 * (map.cosineOfRow(row) + map.cosineOfRow(row + 1));
        const std::vector<double> p = legendre(order, cosine, std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
        const double solidAngle = map.solidAngle(row);
        for (int m = 0; m <= order; ++m) {
            glm::dvec3 c(0.0), s(0.0);
            for (int x = 0; x < map.width; ++x) {
                const glm::dvec2& one = longitudes[std::size_t(x)];
                glm::dvec2& turn = turns[std::size_t(x)];
                turn = m == 0 ? glm::dvec2(1.0, 0.0)
                              : glm::dvec2(turn.x * one.x - turn.y * one.y, turn.x * one.y + turn.y * one.x);
                const glm::dvec3 light(glm::vec3(map.at(x, row)));
                c += turn.x * light;
                s += turn.y * light;
            }
            for (int l = m; l <= order; ++l) {
                const std::size_t at = std::size_t(l * (l + 1) / 2 + m);
                sum.cosines[at] += solidAngle * p[at] * c;
                sum.sines[at] += solidAngle * p[at] * s;
            }
        }
    }
    return sum;
}

/// Resamples a small map by interpolation to at least `width` x `width` / 2 texels.
LatitudeMap atLeast(const LatitudeMap& map, int width) {
    const auto parts = [](int size, int least) { return std::max((least + size - 1) / size, 1); };
    const int across = parts(map.width, width), down = parts(map.height, width / 2);
    if (across == 1 && down == 1) return map;
    LatitudeMap finer{map.width * across, map.height * down, {}};
    finer.texels.resize(std::size_t(finer.width) * std::size_t(finer.height));
    for (int y = 0; y < finer.height; ++y)
        for (int x = 0; x < finer.width; ++x)
            finer.texels[std::size_t(y) * std::size_t(finer.width) + std::size_t(x)] = glm::vec4(
                glm::vec3(map.radiance(scenes::directionInMap({(x + 0.5) / finer.width, (y + 0.5) / finer.height}))),
                1.0f);
    return finer;
}

} // namespace

DividedOctahedron irradianceOf(const scenes::Image& map, int order, int side) {
    constexpr int kLeastWidth = 256, kMostWidth = 1024; // far finer than irradiance changes
    const Harmonics light = harmonicsOf(atLeast(coarserMap(map, kMostWidth, kMostWidth / 2), kLeastWidth), order);
    return makeDivided(side, [&](const glm::dvec3& n) {
        const std::vector<double> p = legendre(order, n.y, std::sqrt(std::max(0.0, 1.0 - n.y * n.y)));
        const double longitude = std::atan2(n.x, -n.z);
        glm::dvec3 sum(0.0);
        for (int m = 0; m <= order; ++m) {
            const double c = (m == 0 ? 1.0 : 2.0) * std::cos(m * longitude), s = 2.0 * std::sin(m * longitude);
            for (int l = m; l <= order; ++l) {
                const std::size_t at = std::size_t(l * (l + 1) / 2 + m);
                sum += cosineFactor(l) * p[at] * (c * light.cosines[at] + s * light.sines[at]);
            }
        }
        return glm::max(sum, glm::dvec3(0.0));
    });
}

} // namespace tessera::frame
