#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/Renderer.h"

namespace tessera::viewer {

/// How many lights the pixels of a drawn picture visit at their opaque surfaces, by the light lists that its frame
/// used.
class PictureLights {
public:
    /// Whether pictures of a view tell: what they show is added up over lights, by a technique that visits them at each
    /// pixel, which is a single sample. A frame has one exactly where one is asked for: techniques and drivers that
    /// have no more refuse the others (engine/ChooseSamples.h).
    static bool areTold(const engine::ViewRequest& view);

    /// Of the renderer's latest frame, of such a view. Waits for the GPU.
    explicit PictureLights(const engine::Renderer& renderer)
        : lists_(renderer.downloadLists()), depth_(renderer.downloadDepth()) {}

    /// At a pixel from the upper left: as many as the view `lights` shows, where the surface takes light and nothing
    /// transparent is before it. None where nothing opaque is.
    std::optional<std::size_t> visitedAt(glm::ivec2 pixel) const;

private:
    engine::DrawnLists lists_;
    std::vector<float> depth_; ///< reverse-Z, rows from the bottom
};

} // namespace tessera::viewer
