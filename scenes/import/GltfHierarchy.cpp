#include "scenes/import/GltfHierarchy.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "scenes/Transform.h"

namespace tessera::scenes::gltf {
namespace {

/// Every node's parent, or -1.
std::vector<int> parentsOf(const Document& document) {
    const std::vector<tiny::Node>& nodes = document.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t node = 0; node < nodes.size(); ++node)
        for (const int child : nodes[node].children) {
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0)
                document.fail(
                    placeOf(child),
                    fmt::format("is a child of both node {} and node {}; a node may have one parent", parent, node));
            parent = static_cast<int>(node);
        }
    return parents;
}

/// With one parent each, a cycle is where climbing never ends.
void refuseCycles(const Document& document, const std::vector<int>& parents) {
    enum class Mark : char { New, Climbing, Rooted };
    std::vector<Mark> marks(parents.size(), Mark::New);
    for (std::size_t start = 0; start < parents.size(); ++start) {
        std::vector<int> climbed;
        int node = static_cast<int>(start);
        while (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::New) {
            marks[static_cast<std::size_t>(node)] = Mark::Climbing;
            climbed.push_back(node);
            node = parents[static_cast<std::size_t>(node)];
        }
        if (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::Climbing)
            document.fail(placeOf(node), "is its own ancestor; the node graph must not have cycles");
        for (const int done : climbed) marks[static_cast<std::size_t>(done)] = Mark::Rooted;
    }
}

std::vector<int> rootsOf(const Document& document, const std::vector<int>& parents) {
    std::vector<int> roots;
    if (document.model.scenes.empty()) {
        for (std::size_t node = 0; node < parents.size(); ++node)
            if (parents[node] < 0) roots.push_back(static_cast<int>(node));
        return roots;
    }
    const int scene = std::max(document.model.defaultScene, 0);
    roots = document.scene()->nodes;
    std::vector<bool> isListed(parents.size(), false);
    for (const int root : roots) {
        if (isListed[static_cast<std::size_t>(root)])
            document.fail(fmt::format("/scenes/{}/nodes", scene), fmt::format("lists node {} twice", root));
        if (parents[static_cast<std::size_t>(root)] >= 0)
            document.fail(fmt::format("/scenes/{}/nodes", scene),
                          fmt::format("lists node {}, which is no root but a child of node {}", root,
                                      parents[static_cast<std::size_t>(root)]));
        isListed[static_cast<std::size_t>(root)] = true;
    }
    return roots;
}

glm::dmat4 parentFromNodeOf(const Document& document, int index) {
    const tiny::Node& node = elementAt(document.model.nodes, index);
    if (!node.matrix.empty()) {
        const glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        if (glm::dvec4(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]) != glm::dvec4(0.0, 0.0, 0.0, 1.0))
            document.fail(placeOf(index) + "/matrix", "is not affine; its last row must be 0 0 0 1");
        return matrix;
    }
    const glm::dvec4 rotation = rotationOf(node);
    if (glm::dot(rotation, rotation) == 0.0)
        document.fail(placeOf(index) + "/rotation", "is the zero quaternion, which is no rotation");
    return transformOf(translationOf(node), rotation, scaleOf(node));
}

bool isFinite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

} // namespace

std::vector<PlacedNode> placeNodes(const Document& document) {
    const std::vector<int> parents = parentsOf(document);
    refuseCycles(document, parents);
    std::vector<PlacedNode> placed;
    std::vector<PlacedNode> waiting; // a stack, so that a deep hierarchy does not overflow the call stack
    const auto wait = [&](const std::vector<int>& nodes, int parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            PlacedNode next;
            next.node = *node;
            next.parent = parent;
            waiting.push_back(next);
        }
    };
    std::vector<bool> isPlaced(parents.size());
    const auto placeTrees = [&](const std::vector<int>& roots, bool isDrawn) {
        wait(roots, -1);
        while (!waiting.empty()) {
            PlacedNode next = waiting.back();
            waiting.pop_back();
            next.isDrawn = isDrawn;
            isPlaced[static_cast<std::size_t>(next.node)] = true;
            next.parentFromNode = parentFromNodeOf(document, next.node);
            next.worldFromNode = next.parentFromNode;
            if (next.parent >= 0)
                next.worldFromNode = placed[static_cast<std::size_t>(next.parent)].worldFromNode * next.parentFromNode;
            if (!isFinite(next.worldFromNode))
                document.fail(placeOf(next.node), "its transform, with its ancestors', is not finite");
            placed.push_back(next);
            wait(elementAt(document.model.nodes, next.node).children, static_cast<int>(placed.size()) - 1);
        }
    };
    placeTrees(rootsOf(document, parents), true);
    const std::size_t drawn = placed.size();
    std::vector<bool> isFollowed(document.model.skins.size()); // once each
    for (std::size_t i = 0; i < drawn; ++i) {
        const tiny::Node& node = document.model.nodes[static_cast<std::size_t>(placed[i].node)];
        if (node.skin == kNone || node.mesh == kNone || isFollowed[static_cast<std::size_t>(node.skin)]) continue;
        isFollowed[static_cast<std::size_t>(node.skin)] = true;
        for (int joint : elementAt(document.model.skins, node.skin).joints) {
            if (isPlaced[static_cast<std::size_t>(joint)]) continue;
            while (parents[static_cast<std::size_t>(joint)] >= 0) joint = parents[static_cast<std::size_t>(joint)];
            placeTrees({joint}, false);
        }
    }
    return placed;
}

// ---- Instances ------------------------------------------------------------------------------------------------------

namespace {

/// Reads the attributes that place the instances of one node.
class InstanceReader {
public:
    InstanceReader(Context& context, int node)
        : context_(context),
          attributes_(integersByName(
              valueAt(elementAt(context.document.model.nodes, node).extensions, "EXT_mesh_gpu_instancing/attributes"))),
          place_(fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", node)) {
        if (attributes_.empty()) context_.document.fail(place_, "holds nothing that says how many instances there are");
        const auto& [name, accessor] = *attributes_.begin();
        count_ = elementAt(context_.document.model.accessors, accessor).count;
    }

    std::vector<glm::dmat4> read() {
        const std::optional<Elements> translations = elements("TRANSLATION", 3), rotations = elements("ROTATION", 4),
                                      scales = elements("SCALE", 3);
        context_.document.ledger.charge(count_ * sizeof(glm::dmat4),
                                        [&] { return fmt::format("{}: {}", context_.document.file, place_); });
        std::vector<glm::dmat4> transforms;
        transforms.reserve(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto vector = [&](const std::optional<Elements>& stored, glm::dvec3 otherwise) {
                return stored ? glm::dvec3(stored->values[3 * i], stored->values[3 * i + 1], stored->values[3 * i + 2])
                              : otherwise;
            };
            glm::dvec4 rotation(0.0, 0.0, 0.0, 1.0);
            for (glm::length_t c = 0; rotations && c < 4; ++c)
                rotation[c] = rotations->values[4 * i + static_cast<std::size_t>(c)];
            if (glm::dot(rotation, rotation) == 0.0)
                context_.document.fail(place_ + "/ROTATION",
                                       fmt::format("element {} is the zero quaternion, which is no rotation", i));
            transforms.push_back(
                transformOf(vector(translations, glm::dvec3(0.0)), rotation, vector(scales, glm::dvec3(1.0))));
            for (glm::length_t entry = 0; entry < 16; ++entry)
                if (!std::isfinite(transforms.back()[entry / 4][entry % 4]))
                    context_.document.fail(place_, fmt::format("the transform of instance {} is not finite", i));
        }
        return transforms;
    }

private:
    std::optional<Elements> elements(const char* name, int components) {
        const auto found = attributes_.find(name);
        if (found == attributes_.end()) return std::nullopt;
        Elements read = context_.accessors.elements(found->second);
        const auto fail = [&](const std::string& what) {
            context_.document.fail(fmt::format("{}/{}", place_, name),
                                   fmt::format("accessor {} has {}", found->second, what));
        };
        if (read.components != components)
            fail(fmt::format("{} components an element; {} needs {}", read.components, name, components));
        if (read.count != count_) fail(fmt::format("{} elements, but there are {} instances", read.count, count_));
        return read;
    }

    Context& context_;
    const std::map<std::string, int> attributes_;
    std::string place_;
    std::size_t count_ = 0;
};

} // namespace

std::vector<glm::dmat4> instanceTransforms(Context& context, int node) {
    return InstanceReader(context, node).read();
}

} // namespace tessera::scenes::gltf
