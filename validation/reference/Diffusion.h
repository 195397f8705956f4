#pragma once
#include <memory>
#include <span>

#include "validation/reference/Occlusion.h"
#include "validation/reference/Surroundings.h"

namespace tessera::reference {

/// Subsurface diffusion: the integral over the object's surface of the light that enters at x', times the profile R(|x
/// - x'|), over the integral of R. Distances are straight lines in space, so that light crosses thin parts. Probe lines
/// through the neighbourhood of x, along three axes, find the points x', with the density of the profile's Gaussians
/// across the line. Source: King, Kulla, Conty and Fajardo 2013, "BSSRDF Importance Sampling". May be used by several
/// threads.
class Diffusion {
public:
    /// All must outlive it. Throws as makeTree().
    Diffusion(const Objects& objects, const Textures& textures, std::span<const ShiningLight> lights,
              const Surroundings& surroundings, const Occlusion& occlusion, const Settings& settings);
    ~Diffusion();

    struct Answer {
        glm::dvec3 light{0.0}; ///< diffused irradiance by channel, before the post-scatter albedo
        glm::dvec3 whole{0.0}; ///< the integral of R over the object's surface: 1 on an infinite plane
        double apart = 0.0;    ///< fraction of it from surfaces that face away from x
    };
    /// At a point of an object that diffuses light; `seed` shifts the sample points.
    Answer at(const Hit& hit, const glm::dvec3& pointRWS, std::uint32_t seed) const;

private:
    struct Surfaces;
    std::unique_ptr<Surfaces> surfaces_;
};

} // namespace tessera::reference
