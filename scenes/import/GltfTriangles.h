#pragma once
#include <cstdint>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes::gltf {

/// The corners of the triangles that `corners` draw in a glTF primitive mode (4 list, 5 strip, 6 fan), three a
/// triangle; a list's incomplete last triangle is dropped, and so are a strip's or a fan's triangles that name one
/// corner twice. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners);

/// Gives every triangle three vertices of its own and its geometric normal; tangents are dropped, as they belonged to
/// other normals. A triangle without area gets an arbitrary unit normal.
void makeFlat(Mesh& mesh);

/// Makes normals unit length. Those that cannot be (zero, not finite) become the normal of a triangle at the vertex.
/// Returns how many these were.
std::size_t repairNormals(Mesh& mesh);

/// Makes tangents unit length and their w +1 or -1. False when one cannot be.
bool normalizeTangents(Mesh& mesh);

} // namespace tessera::scenes::gltf
