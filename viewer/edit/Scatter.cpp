#include "viewer/edit/Scatter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "viewer/edit/Clearance.h"
#include "viewer/edit/Surfaces.h"

namespace tessera::viewer {
namespace {

/// Heights above the surface, as fractions of a light's range: lower lights overexpose what is below them.
constexpr double kLowest = 0.2;
constexpr double kHighest = 0.5;
/// Squares of ranges, relative to the square of the mean range; their mean is 1.
constexpr double kLeastSquare = 0.4;
constexpr double kMostSquare = 1.6;
/// A light at height h reaches a disc of radius sqrt(range^2 - h^2): its mean fraction of the disc of the range.
constexpr double kReachedShare = 1.0 - (kLowest * kLowest + kLowest * kHighest + kHighest * kHighest) / 3.0;
/// As a fraction of the distance to the surface above, so that lamps stay below a ceiling.
constexpr double kClearShare = 0.8;
/// As a fraction of the scene's size: narrower gaps get no lamps.
constexpr double kLeastClearShare = 0.01;
constexpr double kLeastUp = 0.5;   ///< 60 degrees from level: a steep roof still faces up
constexpr int kMostTries = 16;     ///< per light
constexpr int kMeasured = 512;     ///< positions where illuminance is measured
constexpr double kHottest = 10.0;  ///< relative to the mean, below any single light
constexpr double kBrightest = 2.5; ///< relative to the mean, of the brightest twentieth of the surfaces

/// std::mt19937_64 is the same everywhere, the distributions of <random> are not.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : engine_(seed) {}
    double unit() { return double(engine_() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 engine_;
};

/// A position for a lamp.
struct Spot {
    Surfaces::Place place;
    double clearMetres = 0.0;
};

/// Positions where lamps hang in a building: above surfaces that face up, and in front of walls and ceilings that other
/// surfaces face; not behind walls, below floors or in narrow gaps. Any positions if there are none of these.
std::vector<Spot> spotsIn(const Clearance& clearance, const Surfaces& surfaces, double diagonalMetres, int count,
                          Numbers& numbers, double& areaSquareMetres) {
    std::vector<Spot> spots;
    const auto wanted = std::size_t(count);
    for (const bool takesAll : {false, true}) {
        if (takesAll && !spots.empty()) break;
        std::size_t tried = 0;
        for (; tried < kMostTries * wanted && spots.size() < wanted; ++tried) {
            const double triangle = numbers.unit(), u = numbers.unit(), v = numbers.unit();
            const Surfaces::Place place = surfaces.at(triangle, u, v);
            const auto metres = clearance.metresAlong(place.positionWS, place.normalWS, diagonalMetres);
            const bool isGood = metres ? *metres >= kLeastClearShare * diagonalMetres : place.normalWS.y >= kLeastUp;
            if (isGood || takesAll) spots.push_back({place, metres.value_or(diagonalMetres)});
        }
        if (!takesAll && !spots.empty()) areaSquareMetres *= double(spots.size()) / double(tried);
    }
    return spots;
}

/// Illuminance in lux from point lights with colours of luminance 1, without shadows.
double illuminanceAt(const std::vector<scenes::Light>& lights, const Surfaces::Place& place) {
    double sum = 0.0;
    for (const scenes::Light& light : lights) {
        const glm::dvec3 toLight = light.positionWS - place.positionWS;
        const double metres = glm::length(toLight), height = glm::dot(toLight, place.normalWS);
        if (!(height > 0.0) || metres >= double(light.rangeMetres)) continue;
        const double window = 1.0 - std::pow(metres / double(light.rangeMetres), 4.0);
        sum += double(light.intensity) * window * window * height / (metres * metres * metres);
    }
    return sum;
}

/// Scales intensities to a mean illuminance of the surfaces; less if that would overexpose a twentieth of them, or the
/// surface point nearest to a light, whose illuminance is `hottestLux` before scaling.
void scaleTo(double lux, double hottestLux, std::vector<scenes::Light>& lights, const Surfaces& surfaces,
             Numbers& numbers) {
    std::vector<double> measured(kMeasured);
    for (double& here : measured) {
        const double triangle = numbers.unit(), u = numbers.unit(), v = numbers.unit();
        here = illuminanceAt(lights, surfaces.at(triangle, u, v));
    }
    const double mean = std::accumulate(measured.begin(), measured.end(), 0.0) / kMeasured;
    if (!(mean > 0.0)) return;
    const auto bright = measured.end() - kMeasured / 20;
    std::ranges::nth_element(measured, bright);
    const double scale = lux * std::min({1.0 / mean, kBrightest / *bright, kHottest / hottestLux});
    for (scenes::Light& light : lights) light.intensity *= float(scale);
}

scenes::Light lightOf(int number, double rangeMetres, Numbers& numbers) {
    scenes::Light light;
    light.name = fmt::format("scattered {}", number);
    // Uniform in the reciprocal temperature, which is perceptually even.
    light.color = lampColor(1.0 / glm::mix(1.0 / kWarmestKelvin, 1.0 / kCoolestKelvin, numbers.unit()));
    light.rangeMetres = float(rangeMetres * std::sqrt(glm::mix(kLeastSquare, kMostSquare, numbers.unit())));
    light.intensity = light.rangeMetres * light.rangeMetres;
    return light;
}

} // namespace

glm::vec3 lampColor(double kelvin) {
    assert(kelvin >= 1667.0 && kelvin <= 25000.0);
    const double k = 1000.0 / kelvin;
    const double x = kelvin < 4000.0 ? ((-0.2661239 * k - 0.2343589) * k + 0.8776956) * k + 0.179910
                                     : ((-3.0258469 * k + 2.1070379) * k + 0.2226347) * k + 0.240390;
    const double y = kelvin < 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : kelvin < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                       : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    const glm::dvec3 xyz(x / y, 1.0, (1.0 - x - y) / y);
    const glm::dmat3 rgbFromXyz = glm::transpose(glm::dmat3(3.2404542, -1.5371385, -0.4985314, //
                                                            -0.9692660, 1.8760108, 0.0415560,  //
                                                            0.0556434, -0.2040259, 1.0572252));
    const glm::dvec3 rgb = glm::max(rgbFromXyz * xyz, glm::dvec3(0.0));
    return glm::vec3(rgb / glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)));
}

std::vector<scenes::Light> scatterLights(const scenes::Scene& scene, const Scatter& scatter) {
    assert(scatter.count >= 0 && scatter.count <= kMostScattered && scatter.lightsPerPoint > 0.0);
    std::vector<scenes::Light> lights;
    if (scatter.count == 0) return lights;
    Numbers numbers(scatter.seed);
    const Surfaces surfaces(scene);
    const scenes::Box3 boundsWS =
        surfaces.empty() ? scenes::Box3{glm::dvec3(-1.0), glm::dvec3(1.0)} : scenes::worldBounds(scene);
    const double diagonalMetres = glm::length(boundsWS.max - boundsWS.min);
    double areaSquareMetres = surfaces.empty() ? 4.0 : surfaces.areaSquareMetres();
    const Clearance clearance(scene);
    const std::vector<Spot> spots =
        surfaces.empty() ? std::vector<Spot>()
                         : spotsIn(clearance, surfaces, diagonalMetres, scatter.count, numbers, areaSquareMetres);
    // The range at which lightsPerPoint lights reach each point of the surfaces.
    const double rangeMetres = std::min(diagonalMetres, std::sqrt(scatter.lightsPerPoint * areaSquareMetres /
                                                                  (std::numbers::pi * kReachedShare * scatter.count)));
    double hottestLux = 0.0;
    for (int i = 0; i < scatter.count; ++i) {
        scenes::Light light = lightOf(i, rangeMetres, numbers);
        if (spots.empty()) {
            const double x = numbers.unit(), y = numbers.unit(), z = numbers.unit();
            light.positionWS = boundsWS.min + glm::dvec3(x, y, z) * (boundsWS.max - boundsWS.min);
        } else {
            const auto& [place, clearMetres] = spots[std::size_t(i) % spots.size()];
            const double wantedMetres = double(light.rangeMetres) * glm::mix(kLowest, kHighest, numbers.unit());
            const double metres = std::min(wantedMetres, kClearShare * clearMetres);
            light.positionWS = glm::clamp(place.positionWS + metres * place.normalWS, boundsWS.min, boundsWS.max);
            // If a side has less clearance than the least height, it becomes as bright as from that height.
            const double roomMetres = kLowest * double(light.rangeMetres);
            const double nearMetres = clearance.metresAround(light.positionWS, roomMetres).value_or(roomMetres);
            light.intensity *= float(nearMetres * nearMetres / (roomMetres * roomMetres));
            hottestLux = std::max(hottestLux, double(light.intensity) / (nearMetres * nearMetres));
        }
        lights.push_back(std::move(light));
    }
    if (!spots.empty()) scaleTo(scatter.lux, hottestLux, lights, surfaces, numbers);
    return lights;
}

} // namespace tessera::viewer
