#pragma once
#include "scenes/import/GltfContext.h"

/// Points and lines, which are drawn as thin solids of triangles: a point as an octahedron, each segment of a line as a
/// prism of three sides with flat ends. Sizes are those of the model at rest, not of the picture that shows it.
namespace tessera::scenes::gltf {

/// The width of a line, a side of its prism, as a share of the longest side of the model's bounds in the world. Of a
/// model that spans 95 % of 720 rows these are 1.7 pixels; seen from any side a prism is 87 to 100 % as wide. The
/// specification asks for one pixel of any picture.
inline constexpr double kLineWidthShare = 1.0 / 400.0;
/// From corner to opposite corner of a point, in widths of a line.
inline constexpr double kPointLineWidths = 2.0;
/// Corners of the triangles of one octahedron or prism: both have eight.
inline constexpr std::size_t kCornersOfSolid = 24;

/// What the corners of a primitive draw in a glTF mode 0 to 3: of points one vertex each, of lines two a segment. A
/// list's incomplete last segment is dropped, and so are segments without length unless their ends may move. A loop of
/// two vertices is one segment. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> thinElements(int mode, std::vector<std::uint32_t> corners,
                                        const std::vector<glm::vec3>& positionsOS, bool endsMayMove);

/// Of thinElements(), for each corner of the solids' triangles the vertex at which it stands: triangles without area
/// until sizeThinSolids().
std::vector<std::uint32_t> cornersOfSolids(int mode, const std::vector<std::uint32_t>& elements);

/// Gives all solids of the scene, in meshes of these glTF modes, their size and normals, and notes that they are drawn.
/// Called when all nodes, instances and skins are there. Of nodes that show one mesh at several scales the largest
/// counts, and of skins their first joint; no solid becomes so thin that single precision cannot hold it, nor wider
/// than its mesh is long. What a node flattens to nothing, as a clip may begin, is as wide as at a scale of 1.
void sizeThinSolids(Scene& scene, const std::map<int, int>& thinModes);

} // namespace tessera::scenes::gltf
