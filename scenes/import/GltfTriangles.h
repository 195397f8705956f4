#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/import/GltfContext.h"

/// What primitives of glTF leave open: which triangles their corners make, and normals.
namespace tessera::scenes::gltf {

/// The corners of the triangles that `corners` draw in a glTF primitive mode (4 list, 5 strip, 6 fan), three a
/// triangle; a list's incomplete last triangle is dropped, and so are a strip's or a fan's triangles that name one
/// corner twice. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners);

/// Completes a shape whose vertices have been read. Without normals it becomes flat: each triangle gets vertices of its
/// own and its normal. Normals and tangents become unit vectors; a normal without direction takes a triangle's, and
/// where a tangent has none all are left out, each with a warning. Morph targets keep only what they can be added to.
void finishNormals(Context& context, const std::string& place, Shape& shape);

} // namespace tessera::scenes::gltf
