#pragma once
#include "renderer/frame/DepthInterval.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"

namespace tessera::validation {

/// World positions of pixel centres from the depth buffer, in double precision, by the camera's definition and not by
/// the renderer's matrices.
class PixelPositions {
public:
    /// `depths` are the view depths of depth values.
    PixelPositions(const scenes::Camera& camera, const frame::FrameSettings& settings,
                   const frame::DepthInterval& depths);

    /// `row` counts from the bottom; `depth` is the depth buffer's value, reverse-Z, more than 0.
    glm::dvec3 positionWS(int column, int row, float depth) const;

private:
    scenes::Camera camera_;
    glm::ivec2 sizePixels_;
    bool isPerspective_;
    double halfHeight_; ///< of the picture: metres, or for a perspective camera those a metre ahead
    double nearMetres_, farMetres_;
};

} // namespace tessera::validation
