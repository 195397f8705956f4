#pragma once
#include <optional>
#include <utility>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// The view ray of an image position.
struct SightLine {
    glm::dvec3 originWS{0.0};
    glm::dvec3 directionWS{0.0, 0.0, -1.0}; ///< unit, away from the viewer
};

/// Maps world-space points to positions in a camera's image, and back to view rays. Positions count from the upper left
/// in the unit of the image's size, and may lie outside the image.
class PictureView {
public:
    /// Sizes must be > 0.
    PictureView(const scenes::Camera& camera, const glm::dvec2& size);

    const glm::dvec2& size() const { return size_; }
    /// Image position of a point; none behind the camera or its near plane.
    std::optional<glm::dvec2> placeOf(const glm::dvec3& positionWS) const;
    /// The ends of the visible part of a line in the image; none if no part is visible.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> lineBetween(const glm::dvec3& aWS, const glm::dvec3& bWS) const;
    /// The view ray at an image position.
    SightLine sightLineAt(const glm::dvec2& place) const;
    /// Unit direction from a point to the viewer. The point must not be the eye.
    glm::dvec3 towardsViewerWS(const glm::dvec3& positionWS) const;
    /// Metres across the image per unit of its size at a point's depth; none where placeOf() returns none.
    std::optional<double> metresPerUnit(const glm::dvec3& positionWS) const;

    bool isPerspective() const { return isPerspective_; }
    glm::dvec3 eyeWS() const { return glm::dvec3(worldFromCamera_[3]); }
    glm::dvec3 rightWS() const { return glm::dvec3(worldFromCamera_[0]); }
    double nearMetres() const { return nearMetres_; }

private:
    /// Image position of a view-space point in front of the camera.
    glm::dvec2 placeOfVS(const glm::dvec3& positionVS) const;
    double halfHeightMetres(double depthMetres) const;

    glm::dmat4 worldFromCamera_, cameraFromWorld_;
    glm::dvec2 size_;
    bool isPerspective_;
    double nearMetres_;
    double halfHeight_; ///< half the image height: metres, for perspective cameras at a depth of 1 m
};

} // namespace tessera::viewer
