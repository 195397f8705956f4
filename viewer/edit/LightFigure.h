#pragma once
#include <optional>
#include <vector>

#include "viewer/camera/PictureView.h"
#include "viewer/edit/LightHandle.h"

/// The overlay of a selected light besides its marker: its outline, and handles that change it. Lengths in the image
/// are in the unit of the view's size.
namespace tessera::viewer {

struct LightFigure {
    glm::dvec3 middleWS{0.0};                        ///< reference point of the handles
    std::vector<std::vector<glm::dvec3>> outlinesWS; ///< lines through these points
    std::vector<std::vector<glm::dvec3>> rangeWS;    ///< the same, for the range
    std::vector<LightHandle> handles;                ///< those that can be grabbed now
    std::optional<glm::dvec2> sun; ///< image position of a directional light, which has no position in the scene
};

/// Figure of a light as returned by lightAtTime(). `scale` is that of lengths; 1 on a display of standard density.
LightFigure lightFigure(const scenes::Light& light, const PictureView& view, double scale);

} // namespace tessera::viewer
