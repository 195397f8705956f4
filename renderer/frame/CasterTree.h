#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/CameraView.h"
#include "scenes/Scene.h"
#include "shaders/shared/caster_tree.h"

namespace tessera::frame {

/// What rounding leaves of a position in fp32: four operations of sqrt(3) times the root of its products' squares, and
/// a turn of the axes, some eight roundings.
inline constexpr double kPositionRounding = 8.0 * 0x1p-24;

/// Where the casters of a scene are, and how exactly.
struct CasterSpace {
    /// The origin of casters' space: the median, on each axis, of the corners of their triangles. A stray far away does
    /// not take the digits of all others.
    glm::dvec3 centreWS{0.0};
    double unitMetres = 0.0;     ///< of casters' space
    double radius = 0.0;         ///< in units, around the origin: all casters
    double roundingMetres = 0.0; ///< by how much rounding to fp32 moves what is drawn of any object against its place
                                 ///< in double precision, beyond kPositionRounding of its distance from the origin
    std::uint32_t nodes = 0;     ///< of the tree
};

/// The casters (scenes/Shadows.h) as a bounding volume hierarchy that shaders walk.
struct CasterTree {
    CasterSpace space;
    std::vector<glm::uvec4> texels; ///< shaders/shared/caster_tree.h; triangles without area are left out
};

/// `passedRows` is by material the row of SubsurfaceConstants that lets light through, 0 for none; materials beyond it
/// have none. Throws std::runtime_error when Embree, which sorts the triangles, fails, or when the tree is too large to
/// be addressed.
CasterTree makeCasterTree(const scenes::Scene& scene, std::span<const std::size_t> passedRows = {});

/// How a view's surfaces find their place in the tree.
shared::CasterTreeConstants casterTreeConstants(const CasterSpace& casters, const CameraView& view);

} // namespace tessera::frame
