#include "renderer/frame/EnvironmentFilter.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "renderer/frame/LatitudeMap.h"
#include "renderer/frame/VanDerCorput.h"
#include "shaders/shared/environment.h"

namespace tessera::frame {

namespace {

using shared::filteredSide, shared::filteredTop;
using std::numbers::pi;

/// All directions on the square of an unfolded octahedron, by texels with their values in their middles.
struct Octahedron {
    int side = 0;
    std::vector<glm::vec3> texels; ///< row after row

    static glm::dvec2 codeOfTexel(int x, int y, int side) {
        return glm::dvec2(2.0 * x + 1.0, 2.0 * y + 1.0) / double(side) - 1.0;
    }
    /// Past an edge the square goes on at the mirrored place of the same edge.
    const glm::vec3& at(int x, int y) const {
        const auto fold = [this](int& beyond, int& along) {
            if (beyond >= 0 && beyond < side) return;
            beyond = beyond < 0 ? -1 - beyond : 2 * side - 1 - beyond;
            along = side - 1 - along;
        };
        fold(x, y);
        fold(y, x);
        return texels[std::size_t(y) * std::size_t(side) + std::size_t(x)];
    }
};

template <typename Value>
Octahedron makeOctahedron(int side, const Value& value) {
    Octahedron result{side, std::vector<glm::vec3>(std::size_t(side) * std::size_t(side))};
    tbb::parallel_for(0, side, [&](int y) {
        for (int x = 0; x < side; ++x)
            result.texels[std::size_t(y) * std::size_t(side) + std::size_t(x)] = glm::vec3(value(x, y));
    });
    return result;
}

/// `value` of the unit direction of each corner; `rowDone` is called from any thread.
template <typename Value>
DividedOctahedron makeDivided(
    int side, const Value& value, const std::function<void()>& rowDone = [] {}) {
    const auto pitch = std::size_t(side) + 1;
    DividedOctahedron result{side, std::vector<glm::vec3>(pitch * pitch)};
    tbb::parallel_for(0, side + 1, [&](int y) {
        for (int x = 0; x <= side; ++x)
            result.corners[std::size_t(y) * pitch + std::size_t(x)] =
                glm::vec3(value(directionOf(DividedOctahedron::codeOfCorner(x, y, side))));
        rowDone();
    });
    return result;
}

/// Solid angle of a texel: the octahedron's plane seen from its middle.
double solidAngleOf(int x, int y, int side) {
    const glm::dvec3 direction = directionOf(Octahedron::codeOfTexel(x, y, side));
    const double sum =
        std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z); // 1 / distance of the plane
    return 4.0 / (double(side) * side) * sum * sum * sum;
}

/// A level with one more texel all around.
class Bordered {
public:
    explicit Bordered(const Octahedron& level) : side_(float(level.side)), pitch_(std::size_t(level.side) + 2) {
        texels_.reserve(pitch_ * pitch_);
        for (int y = -1; y <= level.side; ++y)
            for (int x = -1; x <= level.side; ++x) texels_.emplace_back(level.at(x, y), 0.0f);
    }
    /// Bilinear between the centres of texels.
    glm::vec4 interpolated(const glm::vec3& direction) const {
        const glm::vec3 size = glm::abs(direction);
        glm::vec2 p = glm::vec2(direction) / (size.x + size.y + size.z);
        if (direction.z < 0.0f)
            p = {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
        const glm::vec2 place = (0.5f * p + 0.5f) * side_ + 0.5f; // never negative
        const auto x = std::size_t(place.x), y = std::size_t(place.y);
        const glm::vec2 share = place - glm::vec2(float(x), float(y));
        const glm::vec4* const row = texels_.data() + y * pitch_ + x;
        const glm::vec4 above = row[0] + share.x * (row[1] - row[0]);
        const glm::vec4 below = row[pitch_] + share.x * (row[pitch_ + 1] - row[pitch_]);
        return above + share.y * (below - above);
    }

private:
    float side_;
    std::size_t pitch_;
    std::vector<glm::vec4> texels_;
};

Octahedron smaller(const Octahedron& source) {
    return makeOctahedron(source.side / 2, [&](int x, int y) {
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (int j = 2 * y; j < 2 * y + 2; ++j)
            for (int i = 2 * x; i < 2 * x + 2; ++i) {
                const double weight = solidAngleOf(i, j, source.side);
                sum += weight * glm::dvec3(source.at(i, j));
                weights += weight;
            }
        return sum / weights;
    });
}

/// A sample of a lobe around +z.
struct LobeSample {
    glm::vec3 direction;
    float weight;
    int level;   ///< of the source, whose texels are as far apart as the samples
    float share; ///< of the next level
};

/// Of D around the normal, which is also the viewer's direction: Karis 2013, with levels as in Krivanek and Colbert
/// 2008, "Real-time Shading with Filtered Importance Sampling".
std::vector<LobeSample> lobeSamples(double alpha, int count, int sourceSide, int levels) {
    std::vector<LobeSample> samples;
    double weights = 0.0;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, angle = 2.0 * pi * vanDerCorput(std::uint32_t(i));
        const double cosine2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u), cosine = std::sqrt(cosine2);
        const double sine = std::sqrt(1.0 - cosine2), up = 2.0 * cosine2 - 1.0;
        if (!(up > 0.0)) continue;
        const double t = cosine2 * (alpha * alpha - 1.0) + 1.0;
        const double density = alpha * alpha / (pi * t * t) / 4.0;
        const double solidAngle = 1.0 / (count * density), ofTexel = 4.0 * pi / (double(sourceSide) * sourceSide);
        const double level = std::clamp(0.5 * std::log2(solidAngle / ofTexel) + 0.5, 0.0, double(levels - 1));
        const double level0 = std::min(std::floor(level), double(std::max(levels - 2, 0)));
        const double across = 2.0 * cosine * sine;
        samples.push_back({glm::vec3(across * std::cos(angle), across * std::sin(angle), up), float(up), int(level0),
                           float(level - level0)});
        weights += up;
    }
    for (LobeSample& sample : samples) sample.weight = float(double(sample.weight) / weights);
    return samples;
}

glm::vec3 filtered(const std::vector<Bordered>& sources, const std::vector<LobeSample>& samples, const glm::vec3& n) {
    const glm::vec3 other = std::abs(n.z) < 0.9f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 t = glm::normalize(glm::cross(other, n)), b = glm::cross(n, t);
    glm::vec4 sum(0.0f);
    for (const LobeSample& sample : samples) {
        const glm::vec3 direction = sample.direction.x * t + sample.direction.y * b + sample.direction.z * n;
        const glm::vec4 fine = sources[std::size_t(sample.level)].interpolated(direction);
        const glm::vec4 coarse = sources[std::size_t(sample.level) + 1].interpolated(direction);
        sum += sample.weight * (fine + sample.share * (coarse - fine));
    }
    return glm::vec3(sum);
}

/// Normalised associated Legendre functions of the cosine and sine to the top: (l, m) at l (l + 1) / 2 + m. Source:
/// Press et al. 2007, "Numerical Recipes", section 6.7.
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

/// What a clamped cosine keeps of harmonics of an order.
double cosineFactor(int l) {
    if (l == 0) return pi;
    if (l == 1) return 2.0 * pi / 3.0;
    if (l % 2 == 1) return 0.0;
    double ratio = 1.0; // l! / (2^l (l/2)!^2)
    for (int i = 1; i <= l / 2; ++i) ratio *= (2.0 * i - 1.0) / (2.0 * i);
    return 2.0 * pi * ((l / 2) % 2 == 1 ? 1.0 : -1.0) / ((l + 2.0) * (l - 1.0)) * ratio;
}

struct Harmonics {
    std::vector<glm::dvec3> cosines, sines; ///< as legendre()
};

Harmonics harmonicsOf(const LatitudeMap& map, int order) {
    const std::size_t count = std::size_t(order + 1) * std::size_t(order + 2) / 2;
    Harmonics sum{std::vector<glm::dvec3>(count, glm::dvec3(0.0)), std::vector<glm::dvec3>(count, glm::dvec3(0.0))};
    // By column, cosine and sine of m times its longitude.
    std::vector<glm::dvec2> turns(std::size_t(map.width));
    for (int row = 0; row < map.height; ++row) {
        const double cosine = 0.5 * (map.cosineOfRow(row) + map.cosineOfRow(row + 1));
        const std::vector<double> p = legendre(order, cosine, std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
        const double solidAngle = map.solidAngle(row);
        for (int m = 0; m <= order; ++m) {
            glm::dvec3 c(0.0), s(0.0);
            for (int x = 0; x < map.width; ++x) {
                const double longitude = 2.0 * pi * ((x + 0.5) / map.width - 0.5);
                glm::dvec2& turn = turns[std::size_t(x)];
                if (m == 0) {
                    turn = {1.0, 0.0};
                } else if (row == 0 && m == 1) {
                    turn = {std::cos(longitude), std::sin(longitude)};
                } else {
                    const double cosOne = std::cos(longitude), sinOne = std::sin(longitude);
                    turn = {turn.x * cosOne - turn.y * sinOne, turn.x * sinOne + turn.y * cosOne};
                }
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

/// A small map with its interpolation as texels of their own.
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

glm::dvec3 directionOf(const glm::dvec2& code) {
    glm::dvec3 n(code, 1.0 - std::abs(code.x) - std::abs(code.y));
    if (n.z < 0.0)
        n = {(1.0 - std::abs(code.y)) * (code.x >= 0.0 ? 1.0 : -1.0),
             (1.0 - std::abs(code.x)) * (code.y >= 0.0 ? 1.0 : -1.0), n.z};
    return glm::normalize(n);
}

glm::dvec2 codeOf(const glm::dvec3& direction) {
    const glm::dvec2 p =
        glm::dvec2(direction) / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    if (direction.z >= 0.0) return p;
    return {(1.0 - std::abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0), (1.0 - std::abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0)};
}

glm::dvec2 DividedOctahedron::codeOfCorner(int x, int y, int side) {
    return glm::dvec2(2.0 * x, 2.0 * y) / double(side) - 1.0;
}

const glm::vec3& DividedOctahedron::at(int x, int y) const {
    return corners[std::size_t(y) * std::size_t(side + 1) + std::size_t(x)];
}

int filteredSideOf(const scenes::Image& map) {
    const auto side = int(std::bit_ceil(unsigned(std::max({map.width / 2, map.height, 1}))));
    return std::clamp(side, 4 * kLeastFilteredSide, kMostFilteredSide);
}

int filteredLevelsOf(int side) {
    return 2 * (std::countr_zero(unsigned(side)) - std::countr_zero(unsigned(kLeastFilteredSide)));
}

double alphaOfLevel(int level, int levels) {
    return std::pow(double(ENVIRONMENT_LEAST_ALPHA), double(levels - 1 - level) / double(levels - 1));
}

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

FilteredEnvironment filterEnvironment(const scenes::Image& map, const std::function<void(double)>& progress) {
    const int side = filteredSideOf(map), levels = filteredLevelsOf(side);
    FilteredEnvironment result;
    const LatitudeMap source = coarserMap(map, 4 * side, 2 * side);
    // Each texel by 4 x 4 places of it, which no texel of the map falls between.
    const Octahedron resampled = makeOctahedron(side, [&](int x, int y) {
        constexpr int kPlaces = 4;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < kPlaces * kPlaces; ++i)
            sum += source.radiance(directionOf(
                Octahedron::codeOfTexel(kPlaces * x + i % kPlaces, kPlaces * y + i / kPlaces, kPlaces * side)));
        return sum / double(kPlaces * kPlaces);
    });
    result.irradiance = irradianceOf(map, kIrradianceOrder, ENVIRONMENT_IRRADIANCE_SIDE);
    std::vector<Bordered> sources;
    for (Octahedron level = resampled; level.side > 1; level = smaller(level)) sources.emplace_back(level);
    // The smaller a level, the rougher its lobe: about as much work for each.
    constexpr int kLeastSamples = 32, kMostSamples = 1024, kFullSide = kMostFilteredSide / 2;
    double work = 0.0, done = 0.0;
    const auto samplesOf = [&](int level) {
        return std::min(kLeastSamples * (kFullSide / filteredSide(side, level)) *
                            (kFullSide / filteredSide(side, level)),
                        kMostSamples);
    };
    const auto workOf = [&](int level) {
        const int rows = filteredSide(side, level) + 1;
        return double(samplesOf(level)) * rows * rows;
    };
    for (int level = 0; level < levels; ++level) work += workOf(level);
    for (int level = 0; level < levels; ++level) {
        std::atomic<int> rows = 0;
        const int levelSide = filteredSide(side, level);
        const std::vector<LobeSample> samples =
            lobeSamples(alphaOfLevel(level, levels), samplesOf(level), side, int(sources.size()));
        result.levels.push_back(makeDivided(
            levelSide, [&](const glm::dvec3& n) { return filtered(sources, samples, glm::vec3(n)); },
            [&] { progress((done + workOf(level) * ++rows / double(levelSide + 1)) / work); }));
        done += workOf(level);
    }
    return result;
}

glm::ivec2 atlasTexels(int side) {
    return {std::max(side / 2, ENVIRONMENT_IRRADIANCE_SIDE) + 1,
            filteredTop(side, filteredLevelsOf(side)) + ENVIRONMENT_IRRADIANCE_SIDE + 1};
}

std::vector<glm::vec4> atlasOf(const FilteredEnvironment& filtered) {
    const int side = 2 * filtered.levels[0].side;
    const glm::ivec2 size = atlasTexels(side);
    std::vector<glm::vec4> atlas(std::size_t(size.x) * std::size_t(size.y), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    const auto put = [&](const DividedOctahedron& level, int number) {
        const int top = filteredTop(side, number);
        for (int y = 0; y <= level.side; ++y)
            for (int x = 0; x <= level.side; ++x)
                atlas[std::size_t(top + y) * std::size_t(size.x) + std::size_t(x)] = glm::vec4(level.at(x, y), 1.0f);
    };
    for (std::size_t i = 0; i < filtered.levels.size(); ++i) put(filtered.levels[i], int(i));
    put(filtered.irradiance, int(filtered.levels.size()));
    return atlas;
}

} // namespace tessera::frame
