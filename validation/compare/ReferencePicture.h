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

/// The reference renderer (validation/reference) beside the product: the same frame, and what a technique is held to
/// there.
namespace tessera::validation {

/// Throws InputError unless the reference renders frames of these settings: the final view, one sample per pixel.
void requireReferenceTakes(const frame::FrameSettings& settings);

/// A frame's settings as the reference takes them.
reference::Settings referenceSettings(const scenes::Scene& scene, const frame::FrameSettings& settings);

struct ReferencePicture {
    Picture picture; ///< rounded to single precision
    std::vector<reference::Ids> ids;
    std::vector<std::vector<reference::Span>> alternatives; ///< as in reference::Rendered

    /// Of the pictures that the definition allows the one nearest to `shown`, which is of the same size.
    Picture nearestTo(const Picture& shown) const;

    /// As in reference::Rendered: below 1 where rough glass transmits so little that the error of the table of lobes is
    /// a large part of it, as far as that light is of the pixel's.
    std::vector<glm::vec3> errorWeights;

    /// The picture that differs from `shown` by the error of `truth` times its weight. Tolerances hold for it.
    Picture weighted(Picture truth, const Picture& shown) const;

    std::vector<std::uint8_t> undecidedShadows; ///< as in reference::Rendered
    std::vector<reference::Noise> shadowNoise;  ///< as in reference::Rendered

    std::vector<reference::Diffusion::Answer> spread; ///< as in reference::Rendered
    std::vector<reference::Estimate> surroundings;    ///< the same
    std::vector<reference::Estimate> areaLights;      ///< the same

    /// What is known of the shadows of `shown` against the picture. `excluded` as errorFigures() takes it.
    ShadowFigures shadowFigures(const Picture& shown, std::span<const std::uint8_t> excluded) const;
};

/// What else than the picture is found: nothing; the alternatives, which take up to fifteen times as long; or among
/// these also what the noise of traced rays to lights with a size may show.
enum class Leeway : std::uint8_t { None, Definition, DefinitionAndNoise };

/// What a frame shows by definition, with the filter of the settings. `rowDone` is called once a row, from any thread.
/// Throws InputError when the settings name what the scene lacks, requireReferenceTakes() does, or the scene has a
/// hook.
ReferencePicture referencePicture(
    const scenes::Scene& scene, const frame::FrameSettings& settings, const std::function<void()>& rowDone = [] {},
    Leeway leeway = Leeway::DefinitionAndNoise);

/// The same of a renderer's scene at the time of the settings, with what its hook moves and changes, which the renderer
/// runs. Where vertices move, the latest frame is gone.
ReferencePicture referencePicture(
    engine::Renderer& renderer, const frame::FrameSettings& settings, const std::function<void()>& rowDone = [] {},
    Leeway leeway = Leeway::DefinitionAndNoise);

/// Whether a frame has shadows, and those traced, so that ReferencePicture::shadowFigures() tells something.
bool hasTracedShadows(const scenes::Scene& scene, const frame::FrameSettings& settings);

/// What a technique with every G-buffer channel in fp32 is held to against the reference, with the reason.
Tolerance referenceTolerance(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::validation
