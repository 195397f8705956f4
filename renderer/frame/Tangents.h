#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// How tangents are derived for the meshes of a material.
struct TangentBasis {
    scenes::TangentMethod method = scenes::TangentMethod::MikkTSpace;
    int texCoordSet = 0;
    glm::dmat2 textureFromUv{1.0}; ///< linear part of the transform of the texture coordinates, v downwards
    bool operator==(const TangentBasis&) const = default;
};

/// Empty if the material needs no tangents. They follow the texture coordinates of its tangent-space normal map, else
/// of its anisotropy, else of its coat's normal map.
std::optional<TangentBasis> tangentBasis(const scenes::Material& material);

/// Transforms vectors in a texture of the slot, x along u and y along -v, to the tangent frame of tangentBasis(): a
/// rotation, mirrored if just one of the two is mirrored. Both frames are the mesh's, rotated by the transforms of the
/// two textures; an empty slot has no transform.
glm::dmat2 tangentsFromTexture(const scenes::Material& material, scenes::TextureSlot slot);

/// A mesh with tangents. Vertices that triangles cannot share are split: those beyond the mesh's are copies.
struct TangentMesh {
    std::vector<std::uint32_t> indices;  ///< as many as the mesh's
    std::vector<std::uint32_t> copiedOf; ///< by added vertex: the mesh vertex that it copies except for the tangent
    std::vector<glm::vec4> tangentsOS;   ///< by vertex, the added ones last; xyz unit, w +1 or -1
};

/// Rotates and mirrors the mesh's tangents, if it has any, by the texture's transform: they belong to the untransformed
/// texture coordinates. Else derives them by the basis's method from the transformed coordinates, v upwards.
/// Source: glTF 2.0, "Meshes"; KHR_texture_transform; glTF Sample Renderer, which rotates tangents the same way;
/// MikkTSpace.h; Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", where each vertex sums
/// the directions of increasing u over its triangles without weights and is never split.
TangentMesh meshWithTangents(const scenes::Mesh& mesh, const TangentBasis& basis);

} // namespace tessera::frame
