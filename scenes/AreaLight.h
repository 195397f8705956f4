#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Light.h"

/// The surfaces of area lights (LightTypeInfo::isArea) as numbers.
namespace tessera::scenes {

/// A width, height, length or radius below this counts as none, and the light is dark: products of two of them keep
/// their digits in single precision. So does an outline's area below its square.
inline constexpr float kLeastAreaMetres = 1e-6f;

/// The square metres within an outline; above 0 where it runs counterclockwise, from x to y.
double signedArea(const LightCorners& corners);

/// The middle of the area within an outline, in metres as its corners.
glm::dvec2 middleOf(const LightCorners& corners);

/// The numbers of the corners of triangles that cover an outline once; on straight edges some have no area. Of corners
/// that make no outline (cornersProblem()) any triangles.
std::vector<std::array<std::uint8_t, 3>> trianglesOf(const LightCorners& corners);

/// What keeps corners from being the outline of an area: too few or too many, corners too far out or in one place,
/// edges that cross, touch or fold back; empty where nothing does. It follows "its corners". Corners count from 0.
std::string cornersProblem(const LightCorners& corners);

/// Whether there is a surface that shines.
bool hasSurface(const Light& light);

/// The largest area in m^2 that the surface shows from anywhere, seen from afar.
double largestSeenArea(const Light& light);

/// The radius in metres of the ball around the light's position that its surface lies in.
double surfaceReachMetres(const Light& light);

/// The unit vector at right angles to a unit direction that is nearest to `wish`, of unit length too; nothing where
/// that runs along the direction.
std::optional<glm::dvec3> acrossFrom(const glm::dvec3& direction, const glm::dvec3& wish);

/// A unit vector at right angles to a unit direction, horizontal where the direction is not vertical, else near +X:
/// Light::alongWS of a light that states none.
glm::dvec3 usualAlong(const glm::dvec3& directionWS);

/// Of a light with a direction, a unit vector at right angles to that: Light::alongWS, or of one that may be turned
/// about its direction and shines the same, usualAlong().
glm::dvec3 alongOf(const Light& light);

} // namespace tessera::scenes
