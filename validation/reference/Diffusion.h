#pragma once
#include <memory>
#include <span>

#include "validation/reference/Occlusion.h"
#include "validation/reference/Surroundings.h"

namespace tessera::reference {

/// Light that enters an object and leaves it elsewhere: the integral over the object's surface of the light that enters
/// at x', times the profile R(|x - x'|), over the integral of R. Distances are straight ones, in space, so that light
/// crosses thin parts. Points x' come from lines through the neighbourhood of x, along three axes, with the density of
/// the profile's Gaussians across the line. Source: King, Kulla, Conty and Fajardo 2013, "BSSRDF Importance Sampling".
/// May be used by several threads.
class Diffusion {
public:
    /// All must outlive it. Throws as makeTree().
    Diffusion(const Objects& objects, const Textures& textures, std::span<const ShiningLight> lights,
              const Surroundings& surroundings, const Occlusion& occlusion, const Settings& settings);
    ~Diffusion();

    struct Answer {
        glm::dvec3 light{0.0}; ///< what leaves of what enters, by channel, before the albedo after spreading
        glm::dvec3 whole{0.0}; ///< the integral of R over the object's surface: 1 on a plane without end
        double apart = 0.0;    ///< share of it where the surface faces away from x
    };
    /// At a point of an object that spreads light; `seed` turns the points.
    Answer at(const Hit& hit, const glm::dvec3& pointRWS, std::uint32_t seed) const;

private:
    struct Surfaces;
    std::unique_ptr<Surfaces> surfaces_;
};

} // namespace tessera::reference
