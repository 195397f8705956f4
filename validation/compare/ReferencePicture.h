#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/Picture.h"
#include "engine/Renderer.h"
#include "validation/figures/ShadowFigures.h"
#include "validation/figures/Tolerance.h"
#include "validation/reference/Render.h"

/// The reference renderer (validation/reference) applied to the product's frames, and the tolerances of techniques
/// against it.
namespace tessera::validation {

/// Throws InputError unless the reference renders frames of these settings: the final view, one sample per pixel.
void requireReferenceSupports(const frame::FrameSettings& settings);

/// Converts a frame's settings to the reference's.
reference::Settings referenceSettings(const scenes::Scene& scene, const frame::FrameSettings& settings);

struct ReferencePicture {
    Picture picture; ///< rounded to single precision
    std::vector<reference::Ids> ids;
    std::vector<std::vector<reference::Span>> alternatives; ///< as in reference::Rendered

    /// The image nearest to `shown`, of the same size, among those that the definition allows.
    Picture nearestTo(const Picture& shown) const;

    /// As in reference::Rendered: below 1 where rough glass transmits so little that the lobe table's error is a large
    /// part of it, in proportion to that light's fraction of the pixel.
    std::vector<glm::vec3> errorWeights;

    /// An image that differs from `shown` by the error of `truth` times errorWeights. Tolerances apply to it.
    Picture weighted(Picture truth, const Picture& shown) const;

    std::vector<std::uint8_t> undecidedShadows; ///< as in reference::Rendered
    std::vector<reference::Noise> shadowNoise;  ///< as in reference::Rendered

    std::vector<reference::Diffusion::Answer> diffused; ///< as in reference::Rendered
    std::vector<reference::Estimate> surroundings;      ///< as in reference::Rendered
    std::vector<reference::Estimate> areaLights;        ///< as in reference::Rendered

    /// Shadow figures of `shown` against the reference's image. `excluded` is as in errorFigures().
    ShadowFigures shadowFigures(const Picture& shown, std::span<const std::uint8_t> excluded) const;
};

/// Alternatives to find besides the image: none; those that the definition allows, which take up to fifteen times as
/// long; or also those that the noise of traced rays to lights with a size allows.
enum class Alternatives : std::uint8_t { None, Definition, DefinitionAndNoise };

/// Renders a frame by definition, with the texture filter of the settings. `rowDone` is called once per row, from any
/// thread. Throws InputError if the settings name something that the scene lacks, if requireReferenceSupports() throws,
/// or if the scene has a hook.
ReferencePicture referencePicture(
    const scenes::Scene& scene, const frame::FrameSettings& settings, const std::function<void()>& rowDone = [] {},
    Alternatives alternatives = Alternatives::DefinitionAndNoise);

/// The same for a renderer's scene at the time of the settings, with its hook, which the renderer runs. Moving vertices
/// invalidates the latest frame.
ReferencePicture referencePicture(
    engine::Renderer& renderer, const frame::FrameSettings& settings, const std::function<void()>& rowDone = [] {},
    Alternatives alternatives = Alternatives::DefinitionAndNoise);

/// Whether a frame has traced shadows, so that ReferencePicture::shadowFigures() is meaningful.
bool hasTracedShadows(const scenes::Scene& scene, const frame::FrameSettings& settings);

/// The tolerance, with its reason, of a technique with every G-buffer channel in fp32 against the reference.
Tolerance referenceTolerance(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::validation
