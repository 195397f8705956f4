#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/CameraView.h"
#include "scenes/Scene.h"
#include "shaders/shared/caster_tree.h"

namespace tessera::frame {

/// Relative rounding error of a position in fp32, about eight roundings: four operations on sqrt(3) times the root of
/// the sum of squared products, and a rotation of the axes.
inline constexpr double kPositionRounding = 8.0 * 0x1p-24;

/// The coordinate space of a scene's casters, and its rounding error.
struct CasterSpace {
    /// The origin of casters' space: the per-axis median of the casters' triangle corners, so that a distant outlier
    /// costs the others no precision.
    glm::dvec3 centreWS{0.0};
    double unitMetres = 0.0;     ///< length of a unit of casters' space
    double radius = 0.0;         ///< bounding radius of all casters around the origin, in units
    double roundingMetres = 0.0; ///< largest fp32 rounding error of any object's drawn position, beyond
                                 ///< kPositionRounding times its distance from the origin
    std::uint32_t nodes = 0;     ///< of the tree
};

/// The casters (scenes/Shadows.h) as a bounding volume hierarchy that shaders traverse.
struct CasterTree {
    CasterSpace space;
    std::vector<glm::uvec4> texels; ///< shaders/shared/caster_tree.h; triangles without area are left out
};

/// `passedRows`: per material, the row of SubsurfaceConstants with its transmission, 0 for none; missing materials have
/// none. Throws std::runtime_error if Embree, which builds the hierarchy, fails, or if the tree exceeds the addressable
/// size.
CasterTree makeCasterTree(const scenes::Scene& scene, std::span<const std::size_t> passedRows = {});

/// Constants that transform a view's positions to casters' space, and their rounding errors.
shared::CasterTreeConstants casterTreeConstants(const CasterSpace& casters, const CameraView& view);

} // namespace tessera::frame
