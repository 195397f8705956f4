#include "scenes/import/GltfHierarchy.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

namespace tessera::scenes::gltf {
namespace {

std::string placeOf(int node) {
    return fmt::format("/nodes/{}", node);
}

/// Every node's parent, or -1.
std::vector<int> parentsOf(const Document& document) {
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
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
    const tinygltf::Model& model = document.model;
    std::vector<int> roots;
    if (model.scenes.empty()) {
        for (std::size_t node = 0; node < parents.size(); ++node)
            if (parents[node] < 0) roots.push_back(static_cast<int>(node));
        return roots;
    }
    const int scene = std::max(model.defaultScene, 0);
    roots = model.scenes[static_cast<std::size_t>(scene)].nodes;
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

glm::dvec3 vectorOf(const std::vector<double>& values, glm::dvec3 otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
}

glm::dmat4 transformOf(const Document& document, int index) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(index)];
    glm::dmat4 parentFromNode(1.0);
    if (node.matrix.size() == 16) {
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                parentFromNode[column][row] = node.matrix[static_cast<std::size_t>(column * 4 + row)];
        const glm::dvec4 lastRow(parentFromNode[0][3], parentFromNode[1][3], parentFromNode[2][3],
                                 parentFromNode[3][3]);
        if (lastRow != glm::dvec4(0.0, 0.0, 0.0, 1.0))
            document.fail(placeOf(index) + "/matrix", "is not affine; its last row must be 0 0 0 1");
        return parentFromNode;
    }
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (node.rotation.size() == 4) {
        rotation =
            glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]); // glm takes w first
        if (glm::dot(rotation, rotation) == 0.0)
            document.fail(placeOf(index) + "/rotation", "is the zero quaternion, which is no rotation");
        rotation = glm::normalize(rotation);
    }
    const glm::dmat3 turned = glm::mat3_cast(rotation);
    const glm::dvec3 scale = vectorOf(node.scale, glm::dvec3(1.0));
    for (int column = 0; column < 3; ++column) parentFromNode[column] = glm::dvec4(turned[column] * scale[column], 0.0);
    parentFromNode[3] = glm::dvec4(vectorOf(node.translation, glm::dvec3(0.0)), 1.0);
    return parentFromNode;
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
    wait(rootsOf(document, parents), -1);
    while (!waiting.empty()) {
        PlacedNode next = waiting.back();
        waiting.pop_back();
        next.parentFromNode = transformOf(document, next.node);
        next.worldFromNode = next.parentFromNode;
        if (next.parent >= 0)
            next.worldFromNode = placed[static_cast<std::size_t>(next.parent)].worldFromNode * next.parentFromNode;
        if (!isFinite(next.worldFromNode))
            document.fail(placeOf(next.node), "its transform, with its ancestors', is not finite");
        placed.push_back(next);
        wait(document.model.nodes[static_cast<std::size_t>(next.node)].children, static_cast<int>(placed.size()) - 1);
    }
    return placed;
}

} // namespace tessera::scenes::gltf
