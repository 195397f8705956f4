#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "shaders/shared/diffusion.h"

/// A surface as texels of its texture coordinates, for light that spreads over it (docs/skin.md): which triangle lies
/// at each texel, how long a step to the next texel is on the surface, and where the surface goes on past the rim of a
/// chart. A chart is a part whose triangles meet in edges with common texture coordinates.
namespace tessera::frame {

/// One texel. Rows run with v. Outside of charts it lies in the plane of the nearest edge's triangle.
struct UvTexel {
    std::int32_t triangle = -1; ///< of the mesh; -1: nothing is near
    std::int32_t chart = 0;     ///< from 1; 0: nothing is near
    bool isCovered = false;     ///< its middle lies in a triangle
    /// Outside of charts: where the surface goes on, in texels. Past an edge that no triangle shares, the place
    /// mirrored at the edge.
    glm::dvec2 continued{0.0};
};

/// Steps along a triangle, in metres of the world.
struct UvStep {
    double uMetres = 0.0; ///< to the next texel along u
    double vMetres = 0.0; ///< to the next row, at right angles to that on the surface
    double shear = 0.0;   ///< texels along u that such a step goes besides
};

struct UvAtlas {
    int sideTexels = 0;
    int borderTexels = 0;        ///< around what the coordinates 0 to 1 cover
    std::vector<UvTexel> texels; ///< row by row
    std::vector<UvStep> steps;   ///< by triangle; 0 without area, on the surface or in its coordinates
    double overlapping = 0.0;    ///< share of the covered texels in which several triangles lie
    std::size_t chartCount = 0;

    const UvTexel& at(int u, int v) const { return texels[std::size_t(v) * std::size_t(sideTexels) + std::size_t(u)]; }
    /// In texels: 0.5 is the middle of the first.
    glm::dvec2 placeOf(const glm::vec2& texCoord) const {
        return PLACE_IN_UV_ATLAS(glm::dvec2(texCoord), double(borderTexels), double(sideTexels));
    }
};

/// Texels that lie up to `reachTexels` outside of charts know where the surface goes on.
UvAtlas makeUvAtlas(const scenes::Mesh& mesh, const glm::dmat4& worldFromObject, int sideTexels, int borderTexels,
                    int reachTexels);

/// Why light cannot spread over a mesh by its texture coordinates, and what to do; empty: it can.
std::string unwrapProblem(const scenes::Mesh& mesh);

} // namespace tessera::frame
