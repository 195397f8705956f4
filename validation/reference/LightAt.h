#pragma once
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// A light that is on, at the settings' time. RWS: world axes, the eye as the origin.
struct ShiningLight {
    scenes::Light light;
    glm::dvec3 color{0.0}; ///< colour x intensity, which the light's image multiplies
    glm::dvec3 mean{1.0};  ///< mean factor of the image over the surface
    glm::dvec3 positionRWS{0.0};
    double rangeMetres = 0.0; ///< from here on the light is exactly 0; infinite without an end
    bool castsShadow = false;
};

/// Light that arrives at a point.
struct Incident {
    glm::dvec3 toLight{0.0};    ///< unit; 0 at the light itself, where it is undefined
    glm::dvec3 irradiance{0.0}; ///< irradiance at normal incidence; 0 where the light does not reach
};

std::vector<ShiningLight> shiningLights(const scenes::Scene& scene, const Settings& settings, const glm::dvec3& eyeWS);

/// The irradiance of a light at a point, by its type, falloff and range window. An area light is approximated by a
/// small source at its middle, with its projected area towards the point.
Incident incidentAt(const ShiningLight& shining, const glm::dvec3& positionRWS);

/// Range window of a light with a position: 1 at the light, 0 at its range with a slope of 0: (1 - (d/r)^4)^2.
double rangeWindow(double distanceMetres, double rangeMetres);

/// The distance in metres at which a light ends. A tolerance above 0 ends Falloff::Attenuation where its brightest
/// channel has fallen to the tolerance, found by bisection to the last digit. An area light without a range ends where
/// its brightest channel cannot exceed the tolerance.
double rangeOf(const scenes::Light& light, double brightest, double rangeTolerance);

} // namespace tessera::reference
