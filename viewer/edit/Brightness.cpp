#include "viewer/edit/Brightness.h"

#include <algorithm>
#include <cmath>

#include "scenes/AreaLight.h"

namespace tessera::viewer {
namespace {

/// About the illuminance in lux of what faces the light; of lights that fall off by A, B and C in their own unit.
double illuminanceAt(const scenes::Light& light, const glm::dvec3& positionWS) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const glm::dvec3 weights(0.2126, 0.7152, 0.0722); // Rec. ITU-R BT.709, of luminance
    const double strength = glm::dot(weights, glm::dvec3(light.color)) * double(light.intensity);
    if (!info.hasPosition()) return strength;
    const glm::dvec3 awayWS = positionWS - light.positionWS;
    const double metres = glm::length(awayWS);
    if (metres > double(light.rangeMetres)) return 0.0;
    const bool isInCone = light.type != scenes::LightType::Spot || metres == 0.0 ||
                          glm::dot(awayWS / metres, light.directionWS) >= std::cos(double(light.outerConeRadians));
    if (!isInCone) return 0.0;
    if (light.falloff == scenes::Falloff::Attenuation) {
        const glm::dvec3 by(light.attenuation);
        return strength / (by.x + by.y * metres + by.z * metres * metres);
    }
    const double area = info.isArea ? scenes::largestSeenArea(light) : 1.0; // of radiance, else candela
    constexpr double kLeastMetres = 0.01;
    const double nearest = std::max(metres, kLeastMetres);
    return strength * area / (nearest * nearest);
}

} // namespace

std::optional<int> brightestAt(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS,
                               double timeSeconds) {
    std::optional<int> brightest;
    double most = 0.0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!lights[i].enabled) continue;
        const double here = illuminanceAt(scenes::lightAtTime(lights[i], timeSeconds), positionWS);
        if (!(here > most)) continue;
        most = here;
        brightest = int(i);
    }
    return brightest;
}

std::size_t lightsReaching(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS, double timeSeconds) {
    return std::size_t(std::ranges::count_if(lights, [&](const scenes::Light& light) {
        return light.enabled && illuminanceAt(scenes::lightAtTime(light, timeSeconds), positionWS) > 0.0;
    }));
}

} // namespace tessera::viewer
