#pragma once
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// A light that is on, as it is at the settings' time. RWS: world axes, the eye as the origin.
struct ShiningLight {
    scenes::Light light;
    glm::dvec3 color{0.0}; ///< colour x intensity; a picture has factors of it
    glm::dvec3 mean{1.0};  ///< factor of the picture, all over the surface
    glm::dvec3 positionRWS{0.0};
    double rangeMetres = 0.0; ///< exactly 0 from here on; infinite where it has no end
    bool castsShadow = false;
};

/// Light as it arrives at a point.
struct Incident {
    glm::dvec3 toLight{0.0};    ///< unit; zero at the light itself, where no direction is better than another
    glm::dvec3 irradiance{0.0}; ///< irradiance at normal incidence; 0 where the light does not reach
};

std::vector<ShiningLight> shiningLights(const scenes::Scene& scene, const Settings& settings, const glm::dvec3& eyeWS);

/// The irradiance of a light at a point, by its type, falloff and range window. An area light is small here, and of the
/// same size as seen from the point, at its middle.
Incident incidentAt(const ShiningLight& shining, const glm::dvec3& positionRWS);

/// 1 at a light with a position, 0 at its range with a slope of 0: (1 - (d/r)^4)^2.
double rangeWindow(double distanceMetres, double rangeMetres);

/// Where a light ends. With Falloff::Attenuation a tolerance above 0 ends it where its brightest channel has fallen to
/// the tolerance; found by bisection, to the last digit. An area light without a range ends where its brightest channel
/// can be no more than the tolerance.
double rangeOf(const scenes::Light& light, double brightest, double rangeTolerance);

} // namespace tessera::reference
