#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/Diffusion.h"
#include "validation/reference/Layers.h"
#include "validation/reference/Settings.h"

/// The reference renderer: defines an image, in double precision on the CPU, by the formulas of the textbooks. It
/// shares the plain scene with the product and nothing else.
namespace tessera::reference {

/// A range of radiance that a driver may show, by channel.
struct Span {
    glm::dvec3 least{0.0}, most{0.0};
};

/// A rendered image, rows from the top.
struct Rendered {
    int width = 0, height = 0;
    std::vector<glm::dvec3> radiance;  ///< linear, before exposure
    std::vector<std::uint8_t> covered; ///< 1 where anything was drawn
    std::vector<Ids> ids;

    /// Per pixel, other radiance that the definition allows: by another texel of a `nearest` filter where the
    /// coordinate lies within rounding of an edge, or another filter where the level does; by what Filtering::Hardware
    /// leaves to a driver; by another of several coincident triangles; by shadows that rounding or ray noise decides.
    std::vector<std::vector<Span>> alternatives;
    std::vector<std::uint8_t> undecidedShadows; ///< 1 where rounding decides whether a light is hidden
    /// Noise of the channels' sum by Settings::shadowSamples rays to each light with a size; none where there are other
    /// alternatives than their noise.
    std::vector<Noise> shadowNoise;
    std::vector<Diffusion::Answer> diffused; ///< diffused light of opaque surfaces; all 0 elsewhere
    std::vector<Estimate> surroundings;      ///< environment light of opaque surfaces; all 0 elsewhere
    std::vector<Estimate> areaLights;        ///< light of area lights from all surfaces together (AreaLights.h)
    /// Weight of the pixel's error, by channel: radiance over the radiance if rough glass transmitted at least
    /// Settings::leastRoughTransmittance.
    std::vector<glm::vec3> errorWeights;
};

/// Renders on all cores. Calls `rowDone` once per row of the image, from any thread. The scene must have passed
/// checkScene(). Throws std::runtime_error when there is not enough memory to trace rays.
Rendered render(
    const scenes::Scene& scene, const Settings& settings, const std::function<void()>& rowDone = [] {});

/// Finds the visible triangles at single points of an image. May be used by several threads.
class Probe {
public:
    /// The scene must outlive it. Throws as render() does.
    Probe(const scenes::Scene& scene, const Settings& settings);
    ~Probe();
    /// In pixels from the image's left and its top edge: a pixel's centre is half a pixel in.
    Layers at(const glm::dvec2& placePixels) const;

private:
    struct Look;
    std::unique_ptr<const Look> look_;
};

} // namespace tessera::reference
