#pragma once
#include <array>
#include <span>
#include <vector>

#include "validation/reference/LightAt.h"
#include "validation/reference/Sampling.h"

namespace tessera::reference {

/// Triangles that cover an outline once, in metres from the light's position.
std::vector<std::array<glm::dvec2, 3>> trianglesWithin(const scenes::LightCorners& corners);

/// The part of an area light that shines at a point, in patches over unit squares. Solids shine from outside alone, and
/// no direction meets two patches. As a strategy it is even over the area of its patches, over the solid angle of a
/// sphere; with it sampled() integrates what is too ragged for cubature, as a light behind casters.
class SeenArea : public Strategy {
public:
    /// `normal` is that of the surface that sees it: a point in the plane of a flat light lies on that side of it.
    SeenArea(const ShiningLight& light, const glm::dvec3& positionRWS, const glm::dvec3& normal = glm::dvec3(0.0));

    std::size_t patchCount() const { return patches_.size(); }
    /// Whether a patch's first coordinate is the distance from its middle, and the second the angle around it.
    bool isRound(std::size_t patch) const;
    /// Whether a patch's first coordinate is the distance from a place, so that rings grow with it.
    bool isFan(std::size_t patch) const;

    struct Place {
        glm::dvec3 direction{0.0}; ///< unit, from the point
        double solidAngle = 0.0;   ///< sr, of the unit square if all of it were as here
    };
    Place at(std::size_t patch, const glm::dvec2& square) const;

    glm::dvec3 direction(const glm::dvec2& random) const override;
    /// 0 in directions that do not meet the light.
    double density(const glm::dvec3& direction) const override;

private:
    enum class Shape {
        Rectangle,
        Disk,
        Cone,   ///< of a sphere's directions
        Mantle, ///< of a cylinder, what is seen of it
        Triangle
    };
    struct Patch {
        Shape shape;
        glm::dvec3 middle{0.0}; ///< from the point; of a mantle's axis; the first corner of a triangle
        /// A rectangle's and a mantle's x and y are along the first and the second coordinate of the square, and
        /// unit, like z: the front of what is flat, the axis of a cone. The middle of what is seen of a mantle is
        /// along z, its axis along y.
        Frame frame;
        glm::dvec2 sizeMetres{0.0}; ///< sides; radius; a mantle's radius and length
        double opening = 0.0;       ///< a cone's 1 - cos; a mantle's half angle around its axis
        double share = 0.0;         ///< of the directions
        /// A triangle's, metres along x and y from the first corner to the two others.
        std::array<glm::dvec2, 2> sides{};
        double area() const;
    };
    void addSphere(const glm::dvec3& middle, double radiusMetres);
    void addTube(const glm::dvec3& middle, const scenes::Light& light);
    void addPolygon(const glm::dvec3& middle, const scenes::Light& light, const glm::dvec3& front);
    /// Whether a place in the frame of a flat patch lies within its outline, whatever its height.
    static bool isWithin(const Patch& patch, const glm::dvec3& place);
    static double density(const Patch& patch, const glm::dvec3& direction);

    std::vector<Patch> patches_;
};

} // namespace tessera::reference
