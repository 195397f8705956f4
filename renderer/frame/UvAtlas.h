#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "shaders/shared/diffusion.h"

/// The UV atlas of a surface, for the diffusion of irradiance (docs/skin.md): the triangle at each texel, the length of
/// a step to the next texel on the surface, and where the surface continues past the edge of a chart. A chart is a set
/// of triangles connected by edges with common texture coordinates.
namespace tessera::frame {

/// One texel. Rows run with v. Outside of charts it lies in the plane of the nearest edge's triangle.
struct UvTexel {
    std::int32_t triangle = -1; ///< of the mesh; -1: nothing is near
    std::int32_t chart = 0;     ///< from 1; 0: nothing is near
    bool isCovered = false;     ///< its centre lies in a triangle
    /// Outside charts: where the surface continues, in texels. Past an edge without another triangle, the position
    /// mirrored at the edge.
    glm::dvec2 continued{0.0};
};

/// Steps along a triangle, in metres of the world.
struct UvStep {
    double uMetres = 0.0; ///< to the next texel along u
    double vMetres = 0.0; ///< to the next row, perpendicular to u on the surface
    double shear = 0.0;   ///< offset of such a step along u, in texels
};

struct UvAtlas {
    int sideTexels = 0;
    int borderTexels = 0;        ///< around the coordinates 0 to 1
    std::vector<UvTexel> texels; ///< row by row
    std::vector<UvStep> steps;   ///< by triangle; 0 without area, on the surface or in its coordinates
    double overlapping = 0.0;    ///< fraction of the covered texels in which several triangles lie
    std::size_t chartCount = 0;

    const UvTexel& at(int u, int v) const { return texels[std::size_t(v) * std::size_t(sideTexels) + std::size_t(u)]; }
    /// Position in texels: 0.5 is the centre of the first.
    glm::dvec2 placeOf(const glm::vec2& texCoord) const {
        return PLACE_IN_UV_ATLAS(glm::dvec2(texCoord), double(borderTexels), double(sideTexels));
    }
};

/// Texels up to `reachTexels` outside charts store where the surface continues.
UvAtlas makeUvAtlas(const scenes::Mesh& mesh, const glm::dmat4& worldFromObject, int sideTexels, int borderTexels,
                    int reachTexels);

/// Why a mesh's texture coordinates do not allow diffusion, and a remedy; empty if they do.
std::string unwrapProblem(const scenes::Mesh& mesh);

} // namespace tessera::frame
