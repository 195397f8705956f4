#pragma once
#include <array>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::reference {

/// Unit, at right angles to a unit direction.
glm::dvec3 besideOf(const glm::dvec3& direction);

/// What shadows see of a light with a size (scenes/Shadows.h), from its position.
class LightFace {
public:
    /// `ahead` is the unit way to the light, `radius` that of a disk that faces the point.
    LightFace(const scenes::Light& light, const glm::dvec3& ahead, double radius);

    /// In a ring, or of what is not round a column, of so many of equal area, by the share of the way round or up and a
    /// third number from 0 to 1: of the way along a tube, or across a column.
    glm::dvec3 at(int ring, int rings, double turn, double third) const;

    /// Of its area, from the light's position.
    const glm::dvec3& middle() const { return middle_; }
    double reachMetres() const { return reach_; }
    /// The most of its area, as a share, that a strip of its plane of so many metres can hold that another plane with
    /// this normal cuts out of space.
    double shareOfCut(double metres, const glm::dvec3& normal) const;

private:
    using Triangle = std::array<glm::dvec2, 3>;

    static double areaOf(const Triangle& triangle);
    glm::dvec3 inPlane(const glm::dvec2& place) const { return place.x * x_ + place.y * y_; }

    /// Where so many square metres of the triangles end.
    glm::dvec2 inTriangles(double squareMetres, double turn) const;

    scenes::LightType type_;
    glm::dvec3 x_{0.0}, y_{0.0}, axis_{0.0}, middle_{0.0};
    glm::dvec2 sidesMetres_{0.0};
    double radius_, halfLength_ = 0.0;
    double reach_, area_; ///< the largest that it shows
    bool isFlat_ = false;
    std::vector<Triangle> triangles_; ///< of a polygon
};

} // namespace tessera::reference
