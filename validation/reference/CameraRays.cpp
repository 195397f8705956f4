#include "validation/reference/CameraRays.h"

#include <cmath>

namespace tessera::reference {

CameraRays::CameraRays(const scenes::Camera& camera, glm::ivec2 sizePixels)
    : eyeWS_(camera.worldFromCamera[3]), right_(camera.worldFromCamera[0]), up_(camera.worldFromCamera[1]),
      forward_(-glm::dvec3(camera.worldFromCamera[2])), sizePixels_(sizePixels),
      isPerspective_(camera.projection == scenes::Projection::Perspective),
      halfHeight_(isPerspective_ ? std::tan(0.5 * camera.fovYRadians) : camera.halfHeightMetres),
      nearMetres_(camera.nearMetres), farMetres_(camera.farMetres) {}

Ray CameraRays::through(const glm::dvec2& placePixels) const {
    // -1 to 1 from the left to the right and from the bottom to the top edge of the image.
    const double x = 2.0 * placePixels.x / sizePixels_.x - 1.0;
    const double y = 1.0 - 2.0 * placePixels.y / sizePixels_.y;
    const glm::dvec2 half = halfExtent();
    const glm::dvec3 aside = x * half.x * right_ + y * half.y * up_;
    const double stepMetres = 2.0 * halfHeight_ / sizePixels_.y;
    const glm::dvec3 dx = stepMetres * right_, dy = stepMetres * up_, none(0.0);
    if (isPerspective_) return {none, forward_ + aside, none, none, dx, dy};
    return {aside, forward_, dx, dy, none, none};
}

glm::dvec3 CameraRays::toViewer(const glm::dvec3& positionRWS) const {
    return isPerspective_ ? -glm::normalize(positionRWS) : -forward_;
}

} // namespace tessera::reference
