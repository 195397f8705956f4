#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Light.h"

/// Geometry of the surfaces of area lights (LightTypeInfo::isArea).
namespace tessera::scenes {

/// Smallest width, height, length or radius of a light that shines: products of two such lengths keep their precision
/// in fp32. For the area of an outline the limit is its square.
inline constexpr float kLeastAreaMetres = 1e-6f;

/// Signed area of an outline in m^2, positive if it runs counterclockwise, from x to y.
double signedArea(const LightCorners& corners);

/// Centroid of an outline's area, in metres like its corners.
glm::dvec2 middleOf(const LightCorners& corners);

/// Triangulates an outline; returns corner indices. Corners on straight edges give triangles without area. For corners
/// that form no outline (cornersProblem()) the triangles are arbitrary.
std::vector<std::array<std::uint8_t, 3>> trianglesOf(const LightCorners& corners);

/// Describes why corners form no valid outline: too few or too many, too far out, coincident, or with edges that cross,
/// touch or fold back; empty if it is valid. The text continues "its corners". Corners count from 0.
std::string cornersProblem(const LightCorners& corners);

/// Whether the light has an emitting surface.
bool hasSurface(const Light& light);

/// Largest projected area of the surface in m^2, over all distant viewpoints; an upper bound for tubes.
double largestSeenArea(const Light& light);

/// Radius in metres of the bounding sphere of the light's surface, centred at its position.
double surfaceReachMetres(const Light& light);

/// The unit vector perpendicular to unit vector `direction` that is nearest to unit vector `preferred`; nothing if the
/// two are parallel.
std::optional<glm::dvec3> acrossFrom(const glm::dvec3& direction, const glm::dvec3& preferred);

/// Default of Light::alongWS: a unit vector perpendicular to a unit direction, horizontal unless the direction is
/// vertical, else near +X.
glm::dvec3 usualAlong(const glm::dvec3& directionWS);

/// Unit vector perpendicular to the direction of a light that has one: Light::alongWS, or usualAlong() for types whose
/// rotation about the direction has no effect.
glm::dvec3 alongOf(const Light& light);

} // namespace tessera::scenes
