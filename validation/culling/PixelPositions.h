#pragma once
#include "renderer/frame/DepthInterval.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"

namespace tessera::validation {

/// World positions of pixel centres from the depth buffer, in double precision. Follows the camera's definition, not
/// the renderer's matrices.
class PixelPositions {
public:
    /// `depths`: the view depths that depth values stand for.
    PixelPositions(const scenes::Camera& camera, const frame::FrameSettings& settings,
                   const frame::DepthInterval& depths);

    /// `row` counts from the bottom; `depth` is the depth buffer's value, reverse-Z, more than 0.
    glm::dvec3 positionWS(int column, int row, float depth) const;

private:
    scenes::Camera camera_;
    glm::ivec2 sizePixels_;
    bool isPerspective_;
    double halfHeight_; ///< half the image height in metres; perspective: 1 m ahead
    double nearMetres_, farMetres_;
};

} // namespace tessera::validation
