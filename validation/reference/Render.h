#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/Diffusion.h"
#include "validation/reference/Layers.h"
#include "validation/reference/Settings.h"

/// The reference renderer: the definition of a picture, in double precision on the CPU, by the formulas of the
/// textbooks. It shares the plain scene with the product and nothing else.
namespace tessera::reference {

/// Radiance that a driver is free to show, channel by channel from `least` to `most`.
struct Span {
    glm::dvec3 least{0.0}, most{0.0};
};

/// Rows from the top.
struct Rendered {
    int width = 0, height = 0;
    std::vector<glm::dvec3> radiance;  ///< linear, before exposure
    std::vector<std::uint8_t> covered; ///< 1 where anything was drawn
    std::vector<Ids> ids;

    /// By pixel, what else the definition allows: another texel of a `nearest` filter where the coordinate lies within
    /// rounding of an edge, or another filter where the level does; what Filtering::Hardware leaves to a driver;
    /// another of several triangles in one place.
    std::vector<std::vector<Span>> alternatives;
    std::vector<std::uint8_t> undecidedShadows; ///< 1 where rounding decides whether a light is hidden
    /// Of the sum of the channels, by Settings::shadowSamples rays to each light with a size; none where there is
    /// another alternative than their noise.
    std::vector<Noise> shadowNoise;
    std::vector<Diffusion::Answer> spread; ///< of opaque surfaces that light spreads over; all 0 elsewhere
    std::vector<Estimate> surroundings;    ///< of opaque surfaces in light of an environment; all 0 elsewhere
    std::vector<Estimate> areaLights;      ///< what all surfaces together show of area lights (AreaLights.h)
    /// Of an error of the pixel, by channel: radiance over what it would be if rough glass transmitted at least
    /// Settings::leastRoughTransmittance.
    std::vector<glm::vec3> errorWeights;
};

/// Renders on all cores. `rowDone` is called once a row of the picture, from any thread. The scene must have passed
/// checkScene(). Throws std::runtime_error when the rays cannot be traced for lack of memory.
Rendered render(
    const scenes::Scene& scene, const Settings& settings, const std::function<void()>& rowDone = [] {});

/// Sees at single places of a picture which triangles are there. May be used by several threads.
class Probe {
public:
    /// The scene must outlive it. Throws as render() does.
    Probe(const scenes::Scene& scene, const Settings& settings);
    ~Probe();
    /// In pixels from the picture's left and its top edge: a pixel's centre is half a pixel in.
    Layers at(const glm::dvec2& placePixels) const;

private:
    struct Look;
    std::unique_ptr<const Look> look_;
};

} // namespace tessera::reference
