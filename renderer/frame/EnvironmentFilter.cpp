#include "renderer/frame/EnvironmentFilter.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <tbb/parallel_for.h>

#include "renderer/frame/EnvironmentIrradiance.h"
#include "renderer/frame/LatitudeMap.h"
#include "renderer/frame/VanDerCorput.h"
#include "shaders/shared/environment.h"

namespace tessera::frame {

namespace {

using shared::filteredSide, shared::filteredTop;
using std::numbers::pi;

/// An octahedral map with values at texel centres.
struct Octahedron {
    int side = 0;
    std::vector<glm::vec3> texels; ///< row after row

    static glm::dvec2 codeOfTexel(int x, int y, int side) {
        return glm::dvec2(2.0 * x + 1.0, 2.0 * y + 1.0) / double(side) - 1.0;
    }
    /// Past an edge, the map continues at the mirrored position along the same edge.
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

/// Solid angle of a texel, from its area on the octahedron's face.
double solidAngleOf(int x, int y, int side) {
    const glm::dvec3 direction = directionOf(Octahedron::codeOfTexel(x, y, side));
    const double sum =
        std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z); // 1 / distance to the octahedron
    return 4.0 / (double(side) * side) * sum * sum * sum;
}

/// A level with a border of one texel.
class Bordered {
public:
    explicit Bordered(const Octahedron& level) : side_(float(level.side)), pitch_(std::size_t(level.side) + 2) {
        texels_.reserve(pitch_ * pitch_);
        for (int y = -1; y <= level.side; ++y)
            for (int x = -1; x <= level.side; ++x) texels_.emplace_back(level.at(x, y), 0.0f);
    }
    /// Bilinear between the centres of texels.
    glm::vec4 interpolated(const glm::vec3& direction) const {
        const glm::vec2 place = (0.5f * codeOf(direction) + 0.5f) * side_ + 0.5f; // never negative
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

} // namespace

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

int filteredHalvingsOf(const scenes::Image& map) {
    constexpr int kLeastSide = 128;
    const auto side = int(std::bit_ceil(unsigned(std::max({map.width / 2, map.height, 1}))));
    return std::countr_zero(unsigned(ENVIRONMENT_MOST_SIDE)) -
           std::countr_zero(unsigned(std::clamp(side, kLeastSide, ENVIRONMENT_MOST_SIDE)));
}

double alphaOfLevel(int level) {
    constexpr double kLast = ENVIRONMENT_LEVELS - 1;
    return std::pow(double(ENVIRONMENT_LEAST_ALPHA), (kLast - level) / kLast);
}

FilteredEnvironment filterEnvironment(const scenes::Image& map, const std::function<void(double)>& progress) {
    const int halvings = filteredHalvingsOf(map), side = ENVIRONMENT_MOST_SIDE >> halvings;
    FilteredEnvironment result;
    progress(0.0); // the steps before the levels take a while too
    const LatitudeMap source = coarserMap(map, 4 * side, 2 * side);
    progress(0.0);
    // 4 x 4 samples per texel, dense enough to hit every texel of the map.
    const Octahedron resampled = makeOctahedron(side, [&](int x, int y) {
        constexpr int kPlaces = 4;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < kPlaces * kPlaces; ++i)
            sum += source.radiance(directionOf(
                Octahedron::codeOfTexel(kPlaces * x + i % kPlaces, kPlaces * y + i / kPlaces, kPlaces * side)));
        return sum / double(kPlaces * kPlaces);
    });
    progress(0.0);
    result.irradiance = irradianceOf(map, kIrradianceOrder, ENVIRONMENT_IRRADIANCE_SIDE);
    std::vector<Bordered> sources;
    for (Octahedron level = resampled; level.side > 1; level = smaller(level)) sources.emplace_back(level);
    // Smaller levels take more samples, so that all levels of a large map cost about the same.
    double work = 0.0, done = 0.0;
    const auto samplesOf = [halvings](int level) {
        constexpr int kLeastSamples = 32, kLeastOfSmallMaps = 256, kMostSamples = 1024;
        const int narrower = filteredSide(0, 0) / filteredSide(halvings, level);
        return std::clamp(kLeastSamples * narrower * narrower, halvings > 0 ? kLeastOfSmallMaps : 0, kMostSamples);
    };
    const auto workOf = [&](int level) {
        const int rows = filteredSide(halvings, level) + 1;
        return double(samplesOf(level)) * rows * rows;
    };
    for (int level = 0; level < ENVIRONMENT_LEVELS; ++level) work += workOf(level);
    for (int level = 0; level < ENVIRONMENT_LEVELS; ++level) {
        std::atomic<int> rows = 0;
        const int levelSide = filteredSide(halvings, level);
        const std::vector<LobeSample> samples =
            lobeSamples(alphaOfLevel(level), samplesOf(level), side, int(sources.size()));
        result.levels.push_back(makeDivided(
            levelSide, [&](const glm::dvec3& n) { return glm::dvec3(filtered(sources, samples, glm::vec3(n))); },
            [&] { progress((done + workOf(level) * ++rows / double(levelSide + 1)) / work); }));
        done += workOf(level);
    }
    return result;
}

glm::ivec2 atlasTexels(int halvings) {
    return {std::max(filteredSide(halvings, 0), ENVIRONMENT_IRRADIANCE_SIDE) + 1,
            filteredTop(halvings, ENVIRONMENT_LEVELS) + ENVIRONMENT_IRRADIANCE_SIDE + 1};
}

std::vector<glm::vec4> atlasOf(const FilteredEnvironment& filtered) {
    const int halvings =
        std::countr_zero(unsigned(ENVIRONMENT_MOST_SIDE / 2)) - std::countr_zero(unsigned(filtered.levels[0].side));
    const glm::ivec2 size = atlasTexels(halvings);
    std::vector<glm::vec4> atlas(std::size_t(size.x) * std::size_t(size.y), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    const auto put = [&](const DividedOctahedron& level, int number) {
        const int top = filteredTop(halvings, number);
        for (int y = 0; y <= level.side; ++y)
            for (int x = 0; x <= level.side; ++x)
                atlas[std::size_t(top + y) * std::size_t(size.x) + std::size_t(x)] = glm::vec4(level.at(x, y), 1.0f);
    };
    for (std::size_t i = 0; i < filtered.levels.size(); ++i) put(filtered.levels[i], int(i));
    put(filtered.irradiance, int(filtered.levels.size()));
    return atlas;
}

} // namespace tessera::frame
