#pragma once
#include <optional>
#include <vector>

#include "viewer/camera/PictureView.h"
#include "viewer/edit/LightHandle.h"

/// What the picture shows of a selected light beside its marker: its outline, and handles that change it. Lengths in
/// the picture are in the unit of the view's size.
namespace tessera::viewer {

struct LightFigure {
    glm::dvec3 middleWS{0.0};                        ///< of the handles
    std::vector<std::vector<glm::dvec3>> outlinesWS; ///< lines through these points
    std::vector<std::vector<glm::dvec3>> rangeWS;    ///< the same: how far a light with a range shines
    std::vector<LightHandle> handles;                ///< those that can be taken now
    std::optional<glm::dvec2> sun;                   ///< place of a directional light, which has none in the scene
};

/// Of a light as lightAtTime() shows it. `scale` is that of lengths, for one on a display of usual density.
LightFigure lightFigure(const scenes::Light& light, const PictureView& view, double scale);

} // namespace tessera::viewer
