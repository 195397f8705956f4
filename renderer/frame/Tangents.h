#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// What the tangents follow of the meshes that a material is drawn on.
struct TangentBasis {
    scenes::TangentMethod method = scenes::TangentMethod::MikkTSpace;
    int texCoordSet = 0;
    glm::dmat2 textureFromUv{1.0}; ///< linear part of the transform of the texture's coordinates, v downwards
    bool operator==(const TangentBasis&) const = default;
};

/// Empty where the material needs no tangents. They follow its tangent-space normal map, else its direction of
/// anisotropy, else the normal map of its coat.
std::optional<TangentBasis> tangentBasis(const scenes::Material& material);

/// From vectors in a texture of the slot, x along u and y against v, to the frame of tangent and bitangent that
/// tangentBasis() names: a rotation, and a mirroring where just one of them is mirrored. Both are taken for the mesh's
/// own frame, turned by the transforms of the two textures; an empty slot has none.
glm::dmat2 tangentsFromTexture(const scenes::Material& material, scenes::TextureSlot slot);

/// A mesh with tangents. What its triangles cannot share is split: vertices beyond the mesh's own are copies.
struct TangentMesh {
    std::vector<std::uint32_t> indices;  ///< as many as the mesh's
    std::vector<std::uint32_t> copiedOf; ///< by added vertex: which of the mesh's own it is but for its tangent
    std::vector<glm::vec4> tangentsOS;   ///< by vertex, the added ones last; xyz unit, w +1 or -1
};

/// The mesh's own tangents, where it has some, are those of its texture coordinates as they are: they are turned and
/// mirrored as the texture is. Where it has none they are derived by the basis's method from the transformed
/// coordinates, v upwards.
/// Source: glTF 2.0, "Meshes"; KHR_texture_transform; glTF Sample Renderer, which turns tangents the same way;
/// MikkTSpace.h; Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", where each vertex sums
/// the directions in which u grows over its triangles without weights and is never split.
TangentMesh meshWithTangents(const scenes::Mesh& mesh, const TangentBasis& basis);

} // namespace tessera::frame
