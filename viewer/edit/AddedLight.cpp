#include "viewer/edit/AddedLight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/edit/Clearance.h"

namespace tessera::viewer {

scenes::Light lightBefore(const scenes::Scene& scene, const CameraPose& pose, double luminance) {
    constexpr double kGrey = 0.5;   // reflectance
    constexpr double kRanges = 4.0; // the falloff's window leaves 99 % at a quarter of the range
    const Clearance clearance(scene);
    const glm::dvec3 forwardWS = pose.heading.forwardWS();
    const scenes::Box3 boundsWS = scenes::worldBounds(scene);
    const double beyondMetres = boundsWS.empty() ? pose.focusMetres
                                                 : glm::distance(pose.eyeWS, boundsWS.min) +
                                                       glm::distance(boundsWS.min, boundsWS.max); // past the scene
    const double aheadMetres =
        clearance.metresAlong(pose.eyeWS, forwardWS, beyondMetres, 1e-4 * pose.focusMetres).value_or(pose.focusMetres);
    const double halfMetres = 0.5 * aheadMetres;
    scenes::Light light;
    light.name = "light";
    light.positionWS = pose.eyeWS + halfMetres * forwardWS;
    light.directionWS = forwardWS;
    const double nearMetres = clearance.metresAround(light.positionWS, halfMetres).value_or(halfMetres);
    constexpr double kMostIntensity = 1e9; // for any exposure
    light.intensity = float(std::min(std::numbers::pi * luminance / kGrey * nearMetres * nearMetres, kMostIntensity));
    light.rangeMetres = float(kRanges * nearMetres);
    return light;
}

double noticedLuminance(double meanLuminance, double exposureEV) {
    constexpr double kTimes = 2.0, kLeast = 0.15, kMost = 0.5; // relative to a display's white
    const double exposed = std::exp2(exposureEV);
    return std::clamp(kTimes * meanLuminance * exposed, kLeast, kMost) / exposed;
}

} // namespace tessera::viewer
