#include "scenes/Illuminance.h"

#include <algorithm>
#include <cmath>

#include "scenes/AreaLight.h"

namespace tessera::scenes {

double luminanceOf(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

double illuminanceAt(const Light& light, const glm::dvec3& positionWS) {
    const LightTypeInfo& info = infoOf(light.type);
    const double strength = luminanceOf(light.color) * double(light.intensity);
    if (!info.hasPosition()) return strength;
    const glm::dvec3 awayWS = positionWS - light.positionWS;
    const double metres = glm::length(awayWS);
    if (metres > double(light.rangeMetres)) return 0.0;
    const bool isInCone = light.type != LightType::Spot || metres == 0.0 ||
                          glm::dot(awayWS / metres, light.directionWS) >= std::cos(double(light.outerConeRadians));
    if (!isInCone) return 0.0;
    if (light.falloff == Falloff::Attenuation) {
        const glm::dvec3 by(light.attenuation);
        return strength / (by.x + by.y * metres + by.z * metres * metres);
    }
    const double area = info.isArea ? largestSeenArea(light) : 1.0; // intensity is radiance, else candela
    constexpr double kLeastMetres = 0.01;
    const double nearest = std::max(metres, kLeastMetres);
    return strength * area / (nearest * nearest);
}

} // namespace tessera::scenes
