#pragma once
#include <cstddef>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

/// The reach of a light, which decides whether the light is packed and which light lists contain it.
namespace tessera::frame {

/// colour x intensity, held inside fp32 so that an extreme light is very bright rather than infinite.
glm::dvec3 lightColor(const scenes::Light& light);

/// The distance in metres from which on the light is exactly 0: 0 where it is so everywhere, infinite where it never
/// is. `rangeTolerance`, in the unit of colour x intensity, ends lights of Falloff::Attenuation where their largest
/// channel has fallen to it; 0 ends none. The light's cone is not looked at.
double reachMetres(const scenes::Light& light, double rangeTolerance);

/// What a range tolerance does to lights of Falloff::Attenuation.
struct TruncatedLights {
    std::size_t ended = 0;        ///< end at a radius, in metres between the two below
    std::size_t endless = 0;      ///< B = C = 0: they do not fall off; without a tolerance, all
    std::size_t belowAlready = 0; ///< nowhere above the tolerance: they shine no more
    double shortestMetres = 0.0;
    double longestMetres = 0.0;

    /// Counts a light; ignores black lights and lights of other falloffs.
    void add(const scenes::Light& light, double rangeTolerance);
    std::size_t sum() const { return ended + endless + belowAlready; }
};

} // namespace tessera::frame
