#pragma once
#include <optional>
#include <string>

#include "viewer/edit/LightFigure.h"

namespace tessera::viewer {

/// The point of an axis nearest to a line: metres along the axis from `middleWS` towards `axisWS` (unit). None if they
/// are nearly parallel, or if that point lies behind the line's origin.
std::optional<double> metresAlongAxis(const SightLine& line, const glm::dvec3& middleWS, const glm::dvec3& axisWS);

/// The intersection of a line and a sphere, else the sphere's direction nearest to the line.
struct SpherePoint {
    glm::dvec3 directionWS; ///< unit, from the sphere's centre
    bool isBeside = false;  ///< they do not intersect
};
/// The far or near intersection; also the far one if the near one lies behind the line's origin.
SpherePoint pointOnSphere(const SightLine& line, const glm::dvec3& middleWS, double radiusMetres, bool isFar);

/// A drag of a light's handle. The result depends only on the pointer and on the light's initial state: dragging back
/// restores it, up to rounding. A direction that is dragged out over the rim of the direction sphere, and back in,
/// continues on its other side.
class LightDrag {
public:
    /// Takes a handle of a light's figure. The pointer keeps its initial offset from the handle.
    LightDrag(const scenes::Light& light, const LightFigure& figure, const LightHandle& handle, const PictureView& view,
              const glm::dvec2& pointer);

    /// Changes the light for the pointer's position. `isOneSided`: the opposite side of a rectangle, or end of a tube,
    /// stays, else the light's middle. Returns whether it changed.
    bool drag(scenes::Light& light, double timeSeconds, const PictureView& view, const glm::dvec2& pointer,
              bool isOneSided);

    /// The dragged value: "Width 1.25 m", "Corner 0 at 0.5, -0.5 m", "Position x 1.250 m" at this time.
    std::string text(const scenes::Light& light, double timeSeconds) const;

private:
    void turn(scenes::Light& light, const glm::dvec3& middleWS, const SightLine& line);
    /// Moves a corner to where the line meets the displayed outline's plane, unless the outline becomes invalid.
    void dragCorner(scenes::Light& light, const scenes::Light& shown, const SightLine& line) const;
    /// Moves from the initial position displayed at this time, along the arm's axis as far as the pointer went.
    void slide(scenes::Light& light, double timeSeconds, const glm::dvec3& shownWS, const SightLine& line) const;
    /// `axis` is the middle and direction of the displayed light.
    void resize(scenes::Light& light, double timeSeconds, const SightLine& axis, const SightLine& line,
                bool isOneSided) const;
    /// Distance from the light's middle to the dragged handle.
    std::optional<double> draggedMetres(const SightLine& axis, const SightLine& line) const;

    LightHandle handle_;
    scenes::Light before_;
    glm::dvec3 middleWS_;   ///< of the figure, when the drag began
    double armMetres_;      ///< distance from the middle to the handle
    glm::dvec2 grip_;       ///< offset from the handle's true position to the pointer
    bool isFar_;            ///< of a direction: on the sphere's far side
    bool isBeside_ = false; ///< of a direction: outside the sphere's rim
};

} // namespace tessera::viewer
