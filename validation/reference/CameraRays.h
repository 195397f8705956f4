#pragma once
#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// A ray, relative to the eye. Its point at `depthMetres` ahead of the eye, measured along the camera's forward axis,
/// is origin + depthMetres * direction.
struct Ray {
    glm::dvec3 originRWS{0.0};
    glm::dvec3 direction{0.0}; ///< its component along the forward axis is 1
    /// Ray differentials: changes of both to the pixel to the right and to the one above.
    glm::dvec3 originDx{0.0}, originDy{0.0}, directionDx{0.0}, directionDy{0.0};
    glm::dvec3 at(double depthMetres) const { return originRWS + depthMetres * direction; }
};

/// The rays of a camera's pixels. RWS: world axes, the eye as the origin.
class CameraRays {
public:
    CameraRays(const scenes::Camera& camera, glm::ivec2 sizePixels);

    /// Through the centre of a pixel; rows count from the top.
    Ray through(int column, int row) const { return through(glm::dvec2(column + 0.5, row + 0.5)); }
    /// Through any point of the image, in pixels from its left and its top edge.
    Ray through(const glm::dvec2& placePixels) const;

    /// Depths that are drawn, in metres.
    double nearMetres() const { return nearMetres_; }
    double farMetres() const { return farMetres_; }

    const glm::dvec3& eyeWS() const { return eyeWS_; }
    const glm::dvec3& right() const { return right_; }
    const glm::dvec3& up() const { return up_; }
    const glm::dvec3& forward() const { return forward_; }
    /// Half the image's width and height in metres: 1 m ahead of the eye, or for parallel rays anywhere.
    glm::dvec2 halfExtent() const { return halfHeight_ * glm::dvec2(sizePixels_.x / sizePixels_.y, 1.0); }
    bool isPerspective() const { return isPerspective_; }

    /// Unit direction from a point to the viewer.
    glm::dvec3 toViewer(const glm::dvec3& positionRWS) const;

private:
    glm::dvec3 eyeWS_, right_, up_, forward_;
    glm::dvec2 sizePixels_;
    bool isPerspective_;
    double halfHeight_; ///< as halfExtent()
    double nearMetres_, farMetres_;
};

} // namespace tessera::reference
