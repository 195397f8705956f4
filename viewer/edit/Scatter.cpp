#include "viewer/edit/Scatter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "validation/reference/Visibility.h"
#include "viewer/edit/Surfaces.h"

namespace tessera::viewer {
namespace {

/// Heights above the surface, as shares of the range.
constexpr double kLowest = 0.1;
constexpr double kHighest = 0.5;
/// A light of height h reaches a disc of radius sqrt(range^2 - h^2): its mean share of the disc of the range.
constexpr double kReachedShare = 1.0 - (kLowest * kLowest + kLowest * kHighest + kHighest * kHighest) / 3.0;
/// Mean over the disc of the range of cos / d^2 times the falloff's window, for height 0.3 and in units of the range:
/// 2 h times the integral of (1 - d^4)^2 / d^2 from h to 1.
constexpr double kMeanIrradiance = 1.0965;
/// As a fraction of the distance to the surface above, so that lamps stay below a ceiling.
constexpr double kClearShare = 0.8;

/// std::mt19937_64 is the same everywhere, the distributions of <random> are not.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : engine_(seed) {}
    double unit() { return double(engine_() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 engine_;
};

/// The distance from a place to the surface that faces it. The eye of its rays is the middle of the bounds.
class Clearance {
public:
    Clearance(const scenes::Scene& scene, const scenes::Box3& boundsWS)
        : rays_(cameraIn(boundsWS), {1, 1}), objects_(scene, rays_), textures_(scene, reference::Filtering::Exact),
          visibility_(objects_, rays_, textures_) {}

    double metresAbove(const Surfaces::Place& place, double mostMetres) const {
        // Off the surface itself, by more than single precision blurs it.
        const double startMetres = 1e-4 * mostMetres;
        const reference::Ray ray{place.positionWS + startMetres * place.normalWS - rays_.eyeWS(), place.normalWS};
        const std::optional<reference::Hit> hit = visibility_.nearestOpaque(ray);
        return hit ? std::min(mostMetres, startMetres + hit->depthMetres) : mostMetres;
    }

private:
    static scenes::Camera cameraIn(const scenes::Box3& boundsWS) {
        scenes::Camera camera;
        camera.projection = scenes::Projection::Orthographic; // nothing is too near for parallel rays
        camera.nearMetres = 0.0;
        camera.worldFromCamera[3] = glm::dvec4(0.5 * (boundsWS.min + boundsWS.max), 1.0);
        camera.farMetres = 2.0 * glm::length(boundsWS.max - boundsWS.min) + 1.0;
        return camera;
    }

    reference::CameraRays rays_;
    reference::Objects objects_;
    reference::Textures textures_;
    reference::Visibility visibility_;
};

scenes::Light lightOf(int number, double hue, double rangeMetres, const Scatter& scatter) {
    scenes::Light light;
    light.name = fmt::format("scattered {}", number);
    light.color = equalLuminanceColor(hue);
    light.rangeMetres = float(rangeMetres);
    light.intensity =
        float(scatter.lux * kReachedShare * rangeMetres * rangeMetres / (scatter.lightsPerPoint * kMeanIrradiance));
    return light;
}

} // namespace

glm::vec3 equalLuminanceColor(double hue) {
    constexpr double kSaturation = 0.6;
    glm::dvec3 color;
    for (glm::length_t i = 0; i < 3; ++i) {
        // Each channel is full within a sixth of its hue and empty beyond a third.
        const double apart = hue - i / 3.0;
        const double distance = std::abs(apart - std::round(apart));
        color[i] = 1.0 - kSaturation + kSaturation * std::clamp(2.0 - 6.0 * distance, 0.0, 1.0);
    }
    return glm::vec3(color / glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)));
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
    // So many lights a square metre reach lightsPerPoint of them into the disc of the range.
    const double areaSquareMetres = surfaces.empty() ? 4.0 : surfaces.areaSquareMetres();
    const double rangeMetres = std::min(diagonalMetres, std::sqrt(scatter.lightsPerPoint * areaSquareMetres /
                                                                  (std::numbers::pi * kReachedShare * scatter.count)));
    std::optional<Clearance> clearance;
    if (!surfaces.empty()) clearance.emplace(scene, boundsWS);
    const double firstHue = numbers.unit();
    for (int i = 0; i < scatter.count; ++i) {
        // Steps of the golden ratio spread any number of hues evenly.
        const double hue = firstHue + i / std::numbers::phi;
        scenes::Light light = lightOf(i, hue - std::floor(hue), rangeMetres, scatter);
        const double triangle = numbers.unit(), u = numbers.unit(), v = numbers.unit(), height = numbers.unit();
        if (surfaces.empty()) {
            light.positionWS = boundsWS.min + glm::dvec3(triangle, u, v) * (boundsWS.max - boundsWS.min);
        } else {
            const Surfaces::Place place = surfaces.at(triangle, u, v);
            const double wantedMetres = rangeMetres * glm::mix(kLowest, kHighest, height);
            const double metres = kClearShare * clearance->metresAbove(place, wantedMetres / kClearShare);
            light.positionWS = glm::clamp(place.positionWS + metres * place.normalWS, boundsWS.min, boundsWS.max);
        }
        lights.push_back(std::move(light));
    }
    return lights;
}

} // namespace tessera::viewer
