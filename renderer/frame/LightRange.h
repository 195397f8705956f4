#pragma once
#include <cstddef>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

/// The range of a light, which decides whether the light is packed and which light lists contain it.
namespace tessera::frame {

/// colour x intensity, clamped so that all products with its texture are finite in fp32: an extreme light is very
/// bright rather than infinite.
glm::dvec3 lightColor(const scenes::Light& light);

/// lightColor() at the brightest point of a light's surface, by channel: times the largest factor of its texture.
glm::dvec3 mostColor(const scenes::Light& light);

/// Whether a range tolerance may truncate the light: of Falloff::Attenuation, or an area light without a range.
bool mayBeTruncated(const scenes::Light& light);

/// Distance in metres from its position beyond which the light is exactly 0: 0 if it is 0 everywhere, infinite if it
/// never is. `rangeTolerance` truncates lights of Falloff::Attenuation where their largest channel has fallen to it, in
/// the unit of colour x intensity, and area lights where their irradiance is nowhere above it, assuming that their
/// whole surface is as bright as its brightest point; 0 truncates none. Ignores the light's cone.
double reachMetres(const scenes::Light& light, double rangeTolerance);

/// Effect of a range tolerance on the lights with mayBeTruncated().
struct TruncatedLights {
    std::size_t ended = 0;        ///< truncated at a distance between the two below
    std::size_t endless = 0;      ///< B = C = 0: no falloff; without a tolerance, all
    std::size_t belowAlready = 0; ///< nowhere above the tolerance: switched off
    double shortestMetres = 0.0;
    double longestMetres = 0.0;

    /// Counts a light. Ignores black lights, area lights without a surface, and lights without mayBeTruncated().
    void add(const scenes::Light& light, double rangeTolerance);
    std::size_t sum() const { return ended + endless + belowAlready; }
};

} // namespace tessera::frame
