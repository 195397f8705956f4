#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/Features.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// All meshes of a scene that are drawn, end to end, one array a vertex attribute. Streams that no feature needs are
/// empty; where a mesh lacks an attribute that others have, it gets the neutral value (white, zero coordinates,
/// computed tangents). A mesh whose materials want different tangents is there once for each. Triangles and their
/// corners stay in the mesh's order.
struct VertexStreams {
    struct Range {
        std::uint32_t firstIndex = 0;
        std::uint32_t indexCount = 0;
        std::int32_t baseVertex = 0;
    };
    using Ranges = std::map<std::pair<int, int>, Range>;
    Ranges ranges; ///< by mesh and material, of all mesh instances that are drawn
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;
    std::vector<glm::vec4> tangentsOS;
    std::vector<glm::vec2> texCoords[2];
    std::vector<glm::vec4> colors;
    /// With shadows: of the triangles that end with a vertex, out of the front of its mesh; LIFTED_FACET long where
    /// softened terminators lift their points, else unit; of those without an area any. Where triangles of one end have
    /// different ones, each that differs from the first has a copy of it.
    std::vector<glm::vec3> facetNormalsOS;
};
/// What the streams are called that such features need, in their order.
std::vector<std::string> streamNames(const FeatureSet& features);
/// Throws InputError where that would make very many copies.
VertexStreams makeVertexStreams(const scenes::Scene& scene, const FeatureSet& features);

} // namespace tessera::frame
