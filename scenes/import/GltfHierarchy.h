#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// A node of the imported scene, before anything is made of it.
struct PlacedNode {
    int node = -1;         ///< in the document
    int parent = -1;       ///< in the list of placed nodes
    bool isDrawn = true;   ///< false: a skin follows joints of its tree, which the scene does not have
    bool isVisible = true; ///< KHR_node_visibility, with all above
    glm::dmat4 parentFromNode{1.0};
    glm::dmat4 worldFromNode{1.0};
};

inline constexpr glm::dvec4 kNoRotation{0.0, 0.0, 0.0, 1.0};
inline constexpr std::string_view kZeroQuaternion = "is the zero quaternion, which is no rotation";
inline constexpr std::string_view kNotRotated = "nothing is rotated";

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

} // namespace tessera::scenes::gltf
