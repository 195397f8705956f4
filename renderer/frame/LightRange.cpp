#include "renderer/frame/LightRange.h"

#include <algorithm>
#include <cmath>

#include "scenes/AreaLight.h"

namespace tessera::frame {

namespace {

/// Solves brightest / (A + B r + C r^2) = tolerance for r, the positive root of c + b r + a r^2 with a = C, b = B and
/// c = A - brightest / tolerance. The form 2c / (-b - sqrt(b^2 - 4ac)) avoids cancellation and allows a = 0.
double truncatedReachMetres(double brightest, const glm::dvec3& abc, double tolerance) {
    if (abc.y == 0.0 && abc.z == 0.0) return scenes::kInfinity;
    // The fma keeps all digits of -c if A is close to brightest / tolerance: brightest is exact in double, as the
    // product of two floats.
    const double minusC = std::fma(-abc.x, tolerance, brightest) / tolerance;
    if (!(minusC > 0.0)) return 0.0;
    if (std::isinf(minusC)) return scenes::kInfinity;
    const double halfB = 0.5 * abc.y;
    // hypot and two roots keep b^2 and ac within double for any fp32 coefficients.
    return minusC / (halfB + std::hypot(halfB, std::sqrt(abc.z) * std::sqrt(minusC)));
}

/// At d metres from its position a light of radiance L causes an irradiance of at most L A / (d - b)^2, with A the
/// largest area of its surface visible from any direction and b its bounding radius: no part is nearer than d - b.
double areaReachMetres(const scenes::Light& light, double brightest, double tolerance) {
    return scenes::surfaceReachMetres(light) + std::sqrt(brightest * scenes::largestSeenArea(light) / tolerance);
}

glm::dvec3 mostFactor(const scenes::Light& light) {
    return scenes::infoOf(light.type).isFlat ? glm::dvec3(light.texture.most()) : glm::dvec3(1.0);
}

double brightestOf(const scenes::Light& light) {
    const glm::dvec3 color = mostColor(light);
    return std::max({color.r, color.g, color.b});
}

} // namespace

glm::dvec3 lightColor(const scenes::Light& light) {
    const glm::dvec3 most = glm::max(mostFactor(light), 1.0);
    return glm::min(glm::dvec3(light.color) * double(light.intensity), 1e30 / most);
}

glm::dvec3 mostColor(const scenes::Light& light) {
    return mostFactor(light) * lightColor(light);
}

bool mayBeTruncated(const scenes::Light& light) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (info.isArea) return std::isinf(light.rangeMetres);
    return info.hasPosition() && light.falloff == scenes::Falloff::Attenuation;
}

double reachMetres(const scenes::Light& light, double rangeTolerance) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (!info.hasPosition()) return scenes::kInfinity;
    if (info.isArea && !scenes::hasSurface(light)) return 0.0;
    if (!mayBeTruncated(light)) return light.rangeMetres;
    if (rangeTolerance == 0.0) return scenes::kInfinity;
    const double brightest = brightestOf(light);
    if (info.isArea) return areaReachMetres(light, brightest, rangeTolerance);
    return truncatedReachMetres(brightest, glm::dvec3(light.attenuation), rangeTolerance);
}

void TruncatedLights::add(const scenes::Light& light, double rangeTolerance) {
    if (!mayBeTruncated(light) || glm::vec3(mostColor(light)) == glm::vec3(0.0f)) return;
    if (scenes::infoOf(light.type).isArea && !scenes::hasSurface(light)) return;
    const double reach = reachMetres(light, rangeTolerance);
    if (std::isinf(reach)) {
        ++endless;
    } else if (reach > 0.0) {
        shortestMetres = ended == 0 ? reach : std::min(shortestMetres, reach);
        longestMetres = std::max(longestMetres, reach);
        ++ended;
    } else {
        ++belowAlready;
    }
}

} // namespace tessera::frame
