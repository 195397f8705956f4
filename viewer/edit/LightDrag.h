#pragma once
#include <optional>
#include <string>

#include "viewer/edit/LightFigure.h"

namespace tessera::viewer {

/// Where a line passes an axis: metres along the axis, from `middleWS` towards `axisWS` (unit), of its point nearest to
/// the line. None where they are nearly parallel, and where that point lies behind the line's origin.
std::optional<double> metresAlongAxis(const SightLine& line, const glm::dvec3& middleWS, const glm::dvec3& axisWS);

/// A point of a sphere by a line: where they meet, or else what the line comes nearest to.
struct SpherePoint {
    glm::dvec3 directionWS; ///< unit, from the sphere's middle
    bool isBeside = false;  ///< they do not meet
};
/// At the far side or the near one; at the far one, too, where the near one lies behind the line's origin.
SpherePoint pointOnSphere(const SightLine& line, const glm::dvec3& middleWS, double radiusMetres, bool isFar);

/// A handle of a light in the hand of the user. What it makes of the light follows from where the pointer is and from
/// the light as it was: the way back brings that back, to rounding. A direction that is dragged over the rim of the
/// sphere of all directions, and back over it, comes to the sphere's other side.
class LightDrag {
public:
    /// Takes a handle of the figure of a light. The pointer may be beside it, and stays so.
    LightDrag(const scenes::Light& light, const LightFigure& figure, const LightHandle& handle, const PictureView& view,
              const glm::dvec2& pointer);

    /// Changes the light to where the pointer is now. `isOneSided`: the opposite side of a rectangle, or end of a tube,
    /// stays, else the light's middle. Returns whether it changed.
    bool drag(scenes::Light& light, double timeSeconds, const PictureView& view, const glm::dvec2& pointer,
              bool isOneSided);

    /// What the handle sets: "Width 1.25 m", "Corner 0 at 0.5, -0.5 m", "Position x 1.250 m" at this time.
    std::string text(const scenes::Light& light, double timeSeconds) const;

private:
    void turn(scenes::Light& light, const glm::dvec3& middleWS, const SightLine& line);
    /// To where the line meets the plane of the outline of the light as it is shown; not where that makes no outline.
    void dragCorner(scenes::Light& light, const scenes::Light& shown, const SightLine& line) const;
    /// From where it was to be shown at this time, as far along the arm's axis as the pointer went.
    void slide(scenes::Light& light, double timeSeconds, const glm::dvec3& shownWS, const SightLine& line) const;
    /// `axis` is the light's middle and direction, as it is shown.
    void resize(scenes::Light& light, double timeSeconds, const SightLine& axis, const SightLine& line,
                bool isOneSided) const;
    /// From the light's middle to where the pointer has the handle.
    std::optional<double> draggedMetres(const SightLine& axis, const SightLine& line) const;

    LightHandle handle_;
    scenes::Light before_;
    glm::dvec3 middleWS_;   ///< of the figure, when the handle was taken
    double armMetres_;      ///< from the middle to the handle
    glm::dvec2 grip_;       ///< from the handle's true place to the pointer
    bool isFar_;            ///< of a direction: away from the viewer
    bool isBeside_ = false; ///< the same: over the rim
};

} // namespace tessera::viewer
