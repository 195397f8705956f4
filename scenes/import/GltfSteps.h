#pragma once
#include <compare>

#include "scenes/import/GltfContext.h"

/// Steps of an import: functions that each add their part of the document to the scene.
namespace tessera::scenes::gltf {

class Materials;

/// A node of the imported scene, before anything is made of it.
struct PlacedNode {
    int node = -1;         ///< in the document
    int parent = -1;       ///< in the list of placed nodes
    bool isDrawn = true;   ///< false: a skin follows joints of its tree, which the scene does not have
    bool isVisible = true; ///< KHR_node_visibility, with all above, but for nodes that clips hide and show
    glm::dmat4 parentFromNode{1.0};
    glm::dmat4 worldFromNode{1.0};
};

inline constexpr glm::dvec4 kNoRotation{0.0, 0.0, 0.0, 1.0};
inline constexpr std::string_view kZeroQuaternion = "is the zero quaternion, which is no rotation";
inline constexpr std::string_view kNotRotated = "nothing is rotated";

/// Source: KHR_node_visibility.
bool isVisible(const tiny::Node& node);

inline std::string placeOf(int node) {
    return fmt::format("/nodes/{}", node);
}

/// The nodes of the document's default scene, else of scene 0, else those below every root, depth first, parents before
/// children; then, not drawn, those of the trees of other joints that skins follow.
std::vector<PlacedNode> placeNodes(const Document& document);

/// Node-from-instance of every instance of a node's mesh (EXT_mesh_gpu_instancing); none where the node has no such
/// extension. Throws InputError naming the attribute that is of the wrong type, of another number than the others, or
/// no transform.
std::vector<glm::dmat4> instanceTransforms(Context& context, int node);

/// What of a primitive is read beside its rest.
struct Deforms {
    bool byTargets = false;
    bool byJoints = false;
    auto operator<=>(const Deforms&) const = default;
};

/// The triangles of primitive `primitive` of glTF mesh `mesh`, or nothing (with a warning) when it draws none or has no
/// positions. Strips and fans become triangles, points and lines those of solids that have no size yet
/// (GltfThinSolids.cpp); missing normals become flat ones, for which vertices are unshared. Throws InputError naming
/// the mesh and the accessor.
std::optional<Shape> importPrimitive(Context& context, int mesh, int primitive, Deforms deforms = {});

/// The corners of the triangles that `corners` draw in a glTF primitive mode (4 list, 5 strip, 6 fan), three a
/// triangle; a list's incomplete last triangle is dropped, and so are a strip's or a fan's triangles that name one
/// corner twice. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners);

/// Completes a shape whose vertices have been read. Without normals it becomes flat: each triangle gets vertices of its
/// own and its normal. Normals and tangents become unit vectors; a normal without direction takes a triangle's, and
/// where a tangent has none all are left out, each with a warning. Morph targets keep only what they can be added to.
void finishNormals(Context& context, const std::string& place, Shape& shape);

/// Adds the camera that glTF node `node` carries, if any; scale and shear of the transform are taken out. Cameras'
/// names are made unique, as programs choose by name. Throws InputError naming the camera.
void importCamera(Context& context, int node, const glm::dmat4& worldFromNode);

/// Adds the light that glTF node `node` carries, if any. Of the node's transform only the position and the orientation
/// count. Source: KHR_lights_punctual. Throws InputError naming the light.
void importLight(Context& context, int node, const glm::dmat4& worldFromNode);

/// Brings the lights of a document from lumens to watts where it is in lumens: as the load asks, else as the exporter
/// is known to write them, which a note tells. Source: Blender's exporter, whose "Standard" lighting mode, the default,
/// writes 683 lumens for each watt; before its version 3.4 not for suns (glTF-Blender-IO, pull request 1760, October
/// 2022). Others' numbers are taken as they are.
void takeLightUnits(Document& document, std::vector<std::string>& notes);

/// The picture of glTF image `index`, named as the document names it. Nothing after a warning, which `instead` ends,
/// where it cannot be read; a load that is to be strict throws InputError with the same text.
std::optional<Image> readableImage(Context& context, int index, const char* instead);

/// The six faces of the level that is not filtered, turned by the light's rotation, resampled in latitude and
/// longitude: four times as wide as a face. Filtered levels are not read, since they are made anew. A face that cannot
/// be read is a stand-in, with a warning; a note tells where the document's irradiance is not that of its faces.
void importEnvironment(Context& context);

/// Node-from-instance, by nodes of the document whose meshes are drawn several times.
using Instancing = std::map<int, std::vector<glm::dmat4>>;

/// `Context::thicknessScales`: a document states thicknesses in the space of each mesh, the scene in metres of the
/// world. Source: KHR_materials_volume, "Properties". What a skin moves is taken to be as large as its mesh.
std::map<int, std::optional<double>> thicknessScales(const Context& context, const std::vector<PlacedNode>& allPlaced,
                                                     const Instancing& instancing);

/// Makes the scene's materials as thick as the nodes that show them say. What clips say of them the rig scales.
void placeThicknesses(Context& context, const Materials& materials);

// ---- Points and lines ----------------------------------------------------------------------------------------------
// They are drawn as thin solids of triangles: a point as an octahedron, each segment of a line as a prism of three
// sides with flat ends. Sizes are those of the model at rest, not of the picture that shows it.

/// The width of a line, a side of its prism, as a share of the longest side of the model's bounds in the world. Of a
/// model that spans 95 % of 360 rows these are 1.2 pixels, and seen from any side a prism is 87 to 100 % as wide, so
/// that a sample a pixel meets it everywhere. The specification asks for one pixel of any picture.
inline constexpr double kLineWidthShare = 1.0 / 280.0;
/// From corner to opposite corner of a point, in widths of a line: a third of the distance between neighbours of a
/// square grid of so many points, between 2 and 8, so that a cloud of few is no cloud of specks.
double pointLineWidths(std::size_t points);
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
