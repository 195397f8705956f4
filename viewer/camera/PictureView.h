#pragma once
#include <optional>
#include <utility>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// What one place of a picture shows, whatever its depth.
struct SightLine {
    glm::dvec3 originWS{0.0};
    glm::dvec3 directionWS{0.0, 0.0, -1.0}; ///< unit, away from the viewer
};

/// How a camera's picture shows points, and what its places show. Places count from the picture's upper left in the
/// unit of its size; those outside of the picture lie beyond that.
class PictureView {
public:
    /// Sizes are above 0.
    PictureView(const scenes::Camera& camera, const glm::dvec2& size);

    const glm::dvec2& size() const { return size_; }
    /// Where a point is shown; none where it lies behind the camera or its near plane.
    std::optional<glm::dvec2> placeOf(const glm::dvec3& positionWS) const;
    /// The ends of the part of a line that the picture shows; none where it shows nothing of it.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> lineBetween(const glm::dvec3& aWS, const glm::dvec3& bWS) const;
    /// What is seen at a place.
    SightLine sightLineAt(const glm::dvec2& place) const;
    /// Of the line of sight to a point: unit, towards the viewer. The point is not the eye.
    glm::dvec3 towardsViewerWS(const glm::dvec3& positionWS) const;
    /// Metres across the picture that a unit of its size shows at a point's depth; none where placeOf() is.
    std::optional<double> metresPerUnit(const glm::dvec3& positionWS) const;

    bool isPerspective() const { return isPerspective_; }
    glm::dvec3 eyeWS() const { return glm::dvec3(worldFromCamera_[3]); }
    glm::dvec3 rightWS() const { return glm::dvec3(worldFromCamera_[0]); }
    double nearMetres() const { return nearMetres_; }

private:
    /// Of a point in the camera's space, in front of it.
    glm::dvec2 placeOfVS(const glm::dvec3& positionVS) const;
    double halfHeightMetres(double depthMetres) const;

    glm::dmat4 worldFromCamera_, cameraFromWorld_;
    glm::dvec2 size_;
    bool isPerspective_;
    double nearMetres_;
    double halfHeight_; ///< of the picture: metres, or of a perspective camera at a depth of 1 m
};

} // namespace tessera::viewer
