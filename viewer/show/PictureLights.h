#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/Renderer.h"

namespace tessera::viewer {

/// Number of lights that the pixels of a drawn image visit at their opaque surfaces, by the light lists of its frame.
class PictureLights {
public:
    /// Whether images of a view have these numbers: the view sums over lights, and the technique visits them per pixel,
    /// with a single sample. A frame has one sample exactly if one is requested: techniques and drivers that support no
    /// more refuse the others (engine/ChooseSamples.h).
    static bool areCounted(const engine::ViewRequest& view);

    /// For the renderer's latest frame, of such a view. Waits for the GPU.
    explicit PictureLights(const engine::Renderer& renderer)
        : lists_(renderer.downloadLists()), depth_(renderer.downloadDepth()) {}

    /// At a pixel from the upper left: the number that the view `lights` shows, if the surface is lit and nothing
    /// transparent is in front of it. None without an opaque surface.
    std::optional<std::size_t> visitedAt(glm::ivec2 pixel) const;

private:
    engine::DrawnLists lists_;
    std::vector<float> depth_; ///< reverse-Z, rows from the bottom
};

} // namespace tessera::viewer
