#pragma once
#include <array>
#include <span>
#include <vector>

#include "validation/reference/LightAt.h"
#include "validation/reference/Sampling.h"

namespace tessera::reference {

/// Triangulates an outline, in metres from the light's position.
std::vector<std::array<glm::dvec2, 3>> trianglesWithin(const scenes::LightCorners& corners);

/// The part of an area light that is visible from a point, as patches over unit squares. Solids emit from outside only,
/// and no direction meets two patches. As a sampling strategy it is uniform over the area of its patches, for a sphere
/// over solid angle. sampled() uses it for integrands too discontinuous for cubature, as of a light behind casters.
class SeenArea : public Strategy {
public:
    /// `normal` is that of the lit surface: a point in the plane of a flat light counts as being on that side of it.
    SeenArea(const ShiningLight& light, const glm::dvec3& positionRWS, const glm::dvec3& normal = glm::dvec3(0.0));

    std::size_t patchCount() const { return patches_.size(); }
    /// Whether a patch's coordinates are polar: the distance from its middle, and the angle around it.
    bool isRound(std::size_t patch) const;
    /// Whether a patch's first coordinate is the distance from a point, so that the area element grows with it.
    bool isFan(std::size_t patch) const;

    struct Place {
        glm::dvec3 direction{0.0}; ///< unit, from the point
        double solidAngle = 0.0;   ///< sr per unit of the square's area
    };
    Place at(std::size_t patch, const glm::dvec2& square) const;

    glm::dvec3 direction(const glm::dvec2& random) const override;
    /// 0 in directions that do not meet the light.
    double density(const glm::dvec3& direction) const override;

private:
    enum class Shape {
        Rectangle,
        Disk,
        Cone,   ///< the directions to a sphere
        Mantle, ///< the visible part of a cylinder's side
        Triangle
    };
    struct Patch {
        Shape shape;
        glm::dvec3 middle{0.0}; ///< from the point; of a mantle its axis's middle; of a triangle its first corner
        /// Unit axes. x and y of rectangles and mantles follow the square's first and second coordinate. z is the front
        /// of a flat patch, the axis of a cone, the middle of a mantle's visible part; a mantle's axis is y.
        Frame frame;
        glm::dvec2 sizeMetres{0.0}; ///< sides; radius; a mantle's radius and length
        double opening = 0.0;       ///< a cone's 1 - cos; a mantle's half angle around its axis
        double share = 0.0;         ///< fraction of the sampled directions
        /// A triangle's edges, metres along x and y from the first corner to the two others.
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
