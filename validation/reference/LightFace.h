#pragma once
#include <array>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::reference {

/// A unit vector perpendicular to a unit direction.
glm::dvec3 besideOf(const glm::dvec3& direction);

/// The surface that shadow rays to a light with a size sample (scenes/Shadows.h), relative to the light's position.
class LightFace {
public:
    /// `ahead` is the unit direction to the light, `radius` that of a disk facing the point.
    LightFace(const scenes::Light& light, const glm::dvec3& ahead, double radius);

    /// A sample point in one of several rings of equal area (columns where the light is not round). `turn` is the
    /// fraction of the way round or up; `third`, 0 to 1, that of the way along a tube or across a column.
    glm::dvec3 at(int ring, int rings, double turn, double third) const;

    /// The centre of its area, from the light's position.
    const glm::dvec3& middle() const { return middle_; }
    double reachMetres() const { return reach_; }
    /// An upper bound of the fraction of its area between two parallel planes with this normal, `metres` apart.
    double shareOfCut(double metres, const glm::dvec3& normal) const;

private:
    using Triangle = std::array<glm::dvec2, 3>;

    static double areaOf(const Triangle& triangle);
    glm::dvec3 inPlane(const glm::dvec2& place) const { return place.x * x_ + place.y * y_; }

    /// The point up to which the triangles have an area of `squareMetres`.
    glm::dvec2 inTriangles(double squareMetres, double turn) const;

    scenes::LightType type_;
    glm::dvec3 x_{0.0}, y_{0.0}, axis_{0.0}, middle_{0.0};
    glm::dvec2 sidesMetres_{0.0};
    double radius_, halfLength_ = 0.0;
    double reach_, area_; ///< radius of its bounding ball; largest projected area
    bool isFlat_ = false;
    std::vector<Triangle> triangles_; ///< of a polygon
};

} // namespace tessera::reference
