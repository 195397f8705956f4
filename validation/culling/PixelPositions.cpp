#include "validation/culling/PixelPositions.h"

#include <cmath>

namespace tessera::validation {

PixelPositions::PixelPositions(const scenes::Camera& camera, const frame::FrameSettings& settings,
                               const frame::DepthInterval& depths)
    : camera_(camera), sizePixels_(settings.sizePixels),
      isPerspective_(camera.projection == scenes::Projection::Perspective),
      halfHeight_(isPerspective_ ? std::tan(camera.fovYRadians / 2.0) : camera.halfHeightMetres),
      nearMetres_(depths.nearMetres), farMetres_(depths.farMetres) {
    camera_.worldFromCamera[3] += glm::dvec4(settings.eyeOffsetWS, 0.0);
}

glm::dvec3 PixelPositions::positionWS(int column, int row, float depth) const {
    const double n = nearMetres_, f = farMetres_, d = depth;
    double ahead = f - d * (f - n);
    if (isPerspective_) ahead = std::isinf(f) ? n / d : f * n / (n + d * (f - n));
    const double aspect = double(sizePixels_.x) / double(sizePixels_.y);
    const double u = 2.0 * (column + 0.5) / sizePixels_.x - 1.0, v = 2.0 * (row + 0.5) / sizePixels_.y - 1.0;
    const double scale = halfHeight_ * (isPerspective_ ? ahead : 1.0);
    return glm::dvec3(camera_.worldFromCamera * glm::dvec4(u * aspect * scale, v * scale, -ahead, 1.0));
}

} // namespace tessera::validation
