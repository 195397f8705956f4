#pragma once
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// A node of the imported scene, before anything is made of it.
struct PlacedNode {
    int node = -1;       ///< in the document
    int parent = -1;     ///< in the list of placed nodes
    bool isDrawn = true; ///< false: a skin follows joints of its tree, which the scene does not have
    glm::dmat4 parentFromNode{1.0};
    glm::dmat4 worldFromNode{1.0};
};

inline std::string placeOf(int node) {
    return fmt::format("/nodes/{}", node);
}

/// The nodes of the document's default scene, else of scene 0, else those below every root, depth first, parents before
/// children; then, not drawn, those of the trees of other joints that skins follow. Throws InputError naming the node
/// when the graph is not a forest or a transform is not finite.
std::vector<PlacedNode> placeNodes(const Document& document);

/// Node-from-instance of every instance of a node's mesh (EXT_mesh_gpu_instancing); none where the node has no such
/// extension. Throws InputError naming the attribute that is of the wrong type, of another number than the others, or
/// no transform.
std::vector<glm::dmat4> instanceTransforms(Context& context, int node);

} // namespace tessera::scenes::gltf
