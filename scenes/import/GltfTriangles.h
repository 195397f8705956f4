#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/import/GltfContext.h"

/// What primitives of glTF leave open: which triangles their corners make, and normals.
namespace tessera::scenes::gltf {

inline constexpr int kPoints = 0, kTriangles = 4, kStrip = 5, kFan = 6; ///< modes; lines are 1 to 3

/// The corners of the triangles that `corners` draw in a glTF primitive mode (4 list, 5 strip, 6 fan), three a
/// triangle; a list's incomplete last triangle is dropped, and so are a strip's or a fan's triangles that name one
/// corner twice. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners);

/// Gives a shape whose vertices are read the normals that it lacks, flat ones, for which vertices are unshared; others
/// become unit vectors, and so do tangents, or they are left out with a warning. Morph targets keep only what there is
/// to be changed.
void finishNormals(Context& context, const std::string& place, Shape& shape);

} // namespace tessera::scenes::gltf
