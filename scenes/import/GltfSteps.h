#pragma once
#include <compare>
#include <cstdint>
#include <limits>

#include "scenes/import/GltfContext.h"

/// Steps of an import: each function adds its part of the document to the scene.
namespace tessera::scenes::gltf {

class Materials;

/// A node to import, with its transforms.
struct PlacedNode {
    int node = -1;         ///< in the document
    int parent = -1;       ///< in the list of placed nodes
    bool isDrawn = true;   ///< false: not in the scene, but a skin uses joints of its tree
    bool isVisible = true; ///< KHR_node_visibility of it and its ancestors, except nodes that clips hide
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

/// The nodes of the document's default scene, else of scene 0, else of all roots, depth first, parents before children;
/// then, not drawn, the trees of other joints that skins use.
std::vector<PlacedNode> placeNodes(const Document& document);

/// Node-from-instance of every instance of a node's mesh (EXT_mesh_gpu_instancing). Throws InputError if there are no
/// attributes, or one has the wrong type, another count than the others, or gives no finite transform.
std::vector<glm::dmat4> instanceTransforms(Context& context, int node);

/// The deformations of a primitive to read besides its rest shape.
struct Deforms {
    bool byTargets = false;
    bool byJoints = false;
    auto operator<=>(const Deforms&) const = default;
};

/// The triangles of primitive `primitive` of glTF mesh `mesh`, or nothing, with a warning, if it is flawed, draws none
/// or has no positions. Strips and fans become triangles; points and lines become solids without size yet
/// (GltfThinSolids.cpp). Missing normals become flat normals of unshared vertices. A strict load throws InputError for
/// flaws.
std::optional<Shape> importPrimitive(Context& context, int mesh, int primitive, Deforms deforms = {});

/// Converts the corners of a glTF primitive mode (4 list, 5 strip, 6 fan) to a triangle list. Drops a list's incomplete
/// last triangle, and triangles of a strip or fan that repeat a corner. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners);

/// Completes a shape whose vertices have been read. Without normals it becomes flat: each triangle gets unshared
/// vertices and its normal. Normals and tangents are normalised. A normal without direction takes a triangle's normal;
/// one tangent without direction drops all tangents; both warn. Morph targets keep only attributes that the mesh has.
void finishNormals(Context& context, const std::string& place, Shape& shape);

/// Adds the camera of glTF node `node`, if any; removes scale and shear from its transform. Camera names are made
/// unique, because cameras are selected by name. Throws InputError naming the camera.
void importCamera(Context& context, int node, const glm::dmat4& worldFromNode);

/// Adds the light of glTF node `node`, if any. Uses only position and orientation of the node's transform. Source:
/// KHR_lights_punctual. Throws InputError naming the light.
void importLight(Context& context, int node, const glm::dmat4& worldFromNode);

/// Converts a document's lights from lumens to watts if the load requests it, else if the exporter is known to write
/// lumens, which adds a note. Source: Blender's exporter, whose "Standard" lighting mode, the default, writes 683
/// lumens for each watt; before its version 3.4 not for suns (glTF-Blender-IO, pull request 1760, October 2022). Values
/// of other exporters are not changed.
void takeLightUnits(Document& document, std::vector<std::string>& notes);

/// Reads glTF image `index`, with its name in the document. If that fails, returns nothing after a warning that ends
/// with `instead`; a strict load throws InputError with the same text.
std::optional<Image> readableImage(Context& context, int index, const char* instead);

/// Imports EXT_lights_image_based: rotates the six faces of the unfiltered level and resamples them in latitude and
/// longitude, at most four times as wide as a face. Filtered levels are not read but computed again. A face that cannot
/// be read becomes a stand-in, with a warning; a note reports irradiance coefficients that contradict the faces.
void importEnvironment(Context& context);

/// Node-from-instance transforms, by document node whose mesh is instanced.
using Instancing = std::map<int, std::vector<glm::dmat4>>;

/// Computes `Context::thicknessScales`: a document states thicknesses in mesh space, the scene in world metres. Source:
/// KHR_materials_volume, "Properties". Skinned meshes count as scale 1.
std::map<int, std::optional<double>> thicknessScales(const Context& context, const std::vector<PlacedNode>& allPlaced,
                                                     const Instancing& instancing);

/// Scales the thicknesses of the scene's materials to world metres. Clips of thicknesses are scaled by the rig.
void placeThicknesses(Context& context, const Materials& materials);

// ---- Points and lines ----------------------------------------------------------------------------------------------
// They are drawn as thin solids of triangles: a point as an octahedron, each line segment as a three-sided prism with
// flat ends. Sizes depend on the model's rest pose, not on the image.

/// Width of a line (side of its prism) as a fraction of the longest side of the model's world bounds. For a model that
/// spans 95 % of 360 rows this is 1.2 pixels. From any direction a prism appears 87 to 100 % as wide, so one sample per
/// pixel hits it everywhere. The specification requires one pixel in any image.
inline constexpr double kLineWidthShare = 1.0 / 280.0;
/// Diameter of a point between opposite corners, in line widths: a third of the spacing of a square grid of so many
/// points, clamped to 2..8, so that few points do not become specks.
double pointLineWidths(std::size_t points);
/// Corners of the triangles of one octahedron or prism, which both have eight triangles.
inline constexpr std::size_t kCornersOfSolid = 24;
/// Whether 32-bit indices can name the corners of so many solids, each of which becomes a vertex.
constexpr bool canBeIndexed(std::size_t solids) {
    return solids <= std::numeric_limits<std::uint32_t>::max() / kCornersOfSolid;
}

/// The points or segments of a primitive's corners in glTF modes 0 to 3: one vertex per point, two per line segment.
/// Drops a list's incomplete last segment, and segments without length unless their ends may move. A loop of two
/// vertices is one segment. Source: glTF 2.0 section 3.7.2.1.
std::vector<std::uint32_t> thinElements(int mode, std::vector<std::uint32_t> corners,
                                        const std::vector<glm::vec3>& positionsOS, bool endsMayMove);

/// The vertex of each triangle corner of the solids of thinElements(). The triangles have no area until
/// sizeThinSolids().
std::vector<std::uint32_t> cornersOfSolids(int mode, const std::vector<std::uint32_t>& elements);

/// Sets the size and normals of all solids in meshes with these glTF modes, and adds a note on them. Called when all
/// nodes, instances and skins exist. A mesh shown at several scales uses the largest; a skin uses its first joint.
/// Solids are at least as wide as single precision resolves, and at most as wide as their mesh is long. A scale of 0,
/// with which a clip may begin, counts as 1.
void sizeThinSolids(Scene& scene, const std::map<int, int>& thinModes);

} // namespace tessera::scenes::gltf
