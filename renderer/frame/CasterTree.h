#pragma once
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/DrawList.h"
#include "scenes/Scene.h"
#include "shaders/shared/caster_tree.h"

namespace tessera::frame {

/// What rounding leaves of a position in fp32: products, sums and a turn of the axes, some eight operations.
inline constexpr double kPositionRounding = 8.0 * 0x1p-24;

/// Where the casters of a scene are, and how exactly.
struct CasterSpace {
    glm::dvec3 centreWS{0.0};         ///< the origin of casters' space
    double radiusMetres = 0.0;        ///< around it, all casters; 1 in casters' space
    double drawnRoundingMetres = 0.0; ///< by how much rounding to fp32 moves what is drawn of any object against its
                                      ///< place in double precision, whatever the view
    std::uint32_t nodes = 0;          ///< of the tree
};

/// The casters (scenes/Shadows.h) as a bounding volume hierarchy that shaders walk.
struct CasterTree {
    CasterSpace space;
    std::vector<glm::uvec4> texels; ///< shaders/shared/caster_tree.h; triangles without area are left out
};

/// `drawn` is the scene's. Throws std::runtime_error when Embree, which sorts the triangles, fails, or when the tree is
/// too large to be addressed.
CasterTree makeCasterTree(const scenes::Scene& scene, const DrawList& drawn);

/// How a view's surfaces find their place in the tree.
shared::CasterTreeConstants casterTreeConstants(const CasterSpace& casters, const CameraView& view);

} // namespace tessera::frame
