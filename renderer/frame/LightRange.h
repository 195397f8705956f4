#pragma once
#include <cstddef>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

/// The reach of a light, which decides whether the light is packed and which light lists contain it.
namespace tessera::frame {

/// colour x intensity, held inside fp32 so that an extreme light is very bright rather than infinite, with all factors
/// of its picture.
glm::dvec3 lightColor(const scenes::Light& light);

/// The same of the brightest place of a light's surface, by channel: times the greatest factor of its picture.
glm::dvec3 mostColor(const scenes::Light& light);

/// Whether a range tolerance may end the light: by Falloff::Attenuation, and an area light without a range of its own.
bool takesTolerance(const scenes::Light& light);

/// The distance in metres from its position from which on the light is exactly 0: 0 where it is so everywhere, infinite
/// where it never is. `rangeTolerance` ends lights of Falloff::Attenuation where their largest channel has fallen to
/// it, in the unit of colour x intensity, and area lights where the irradiance that they cause is nowhere above it,
/// were their surface all over as bright as its brightest place; 0 ends none. The light's cone is not looked at.
double reachMetres(const scenes::Light& light, double rangeTolerance);

/// What a range tolerance does to the lights that takesTolerance().
struct TruncatedLights {
    std::size_t ended = 0;        ///< end at a radius, in metres between the two below
    std::size_t endless = 0;      ///< B = C = 0: they do not fall off; without a tolerance, all
    std::size_t belowAlready = 0; ///< nowhere above the tolerance: they shine no more
    double shortestMetres = 0.0;
    double longestMetres = 0.0;

    /// Counts a light; ignores black lights, those without a surface to shine from, and others.
    void add(const scenes::Light& light, double rangeTolerance);
    std::size_t sum() const { return ended + endless + belowAlready; }
};

} // namespace tessera::frame
