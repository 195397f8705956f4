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

/// All drawn meshes of a scene, concatenated, one array per vertex attribute. Streams that no feature needs are empty;
/// attributes that a mesh lacks but others have get neutral values (white, zero coordinates, computed tangents). A mesh
/// whose materials need different tangents is stored once for each. Triangles and their corners keep the mesh's order.
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
    /// With shadows: the front-side normal of the triangles whose last corner is the vertex, of length LIFTED_FACET if
    /// softened terminators lift their points, else unit; arbitrary for triangles without area. Triangles with the same
    /// last corner but other normals use copies of the vertex.
    std::vector<glm::vec3> facetNormalsOS;
};
/// Names of the streams that the features need, in order.
std::vector<std::string> streamNames(const FeatureSet& features);
/// Throws InputError if it would copy more than 2^25 vertices for different tangents.
VertexStreams makeVertexStreams(const scenes::Scene& scene, const FeatureSet& features);

} // namespace tessera::frame
