#include "scenes/import/GltfSteps.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scenes/Direction.h"

namespace tessera::scenes::gltf {
namespace {

glm::vec3 faceNormalOS(const Mesh& mesh, std::size_t firstCorner) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positionsOS[mesh.indices[firstCorner + i]]); };
    return glm::vec3(normalOfTriangle(corner(0), corner(1), corner(2)));
}

template <typename T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices, std::size_t each = 1) {
    if (values.empty()) return;
    std::vector<T> own;
    own.reserve(indices.size() * each);
    for (const std::uint32_t index : indices)
        for (std::size_t i = 0; i < each; ++i) own.push_back(values[index * each + i]);
    values = std::move(own);
}

/// Gives every triangle three vertices of its own and its geometric normal; tangents are dropped, as they belonged to
/// other normals. A triangle without area gets an arbitrary unit normal.
void makeFlat(Shape& shape) {
    Mesh& mesh = shape.rest;
    shape.isFlat = true;
    for (MorphTarget& target : shape.targets) {
        unshare(target.positionsOS, mesh.indices);
        for (auto& set : target.texCoords) unshare(set, mesh.indices);
        unshare(target.colors, mesh.indices);
        target.normalsOS.clear();
        target.tangentsOS.clear();
    }
    unshare(shape.joints, mesh.indices, shape.influences);
    unshare(shape.weights, mesh.indices, shape.influences);
    std::vector<glm::vec3> normalsOS;
    normalsOS.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        normalsOS.insert(normalsOS.end(), 3, faceNormalOS(mesh, i));
    unshare(mesh.positionsOS, mesh.indices);
    for (auto& set : mesh.texCoords) unshare(set, mesh.indices);
    unshare(mesh.colors, mesh.indices);
    mesh.normalsOS = std::move(normalsOS);
    mesh.tangentsOS.clear();
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
}

/// Makes normals unit length. Those that cannot be (zero, not finite) become the normal of a triangle at the vertex.
/// Returns how many these were.
std::size_t repairNormals(Mesh& mesh) {
    std::vector<bool> isBroken(mesh.normalsOS.size(), false);
    std::size_t brokenCount = 0;
    for (std::size_t i = 0; i < mesh.normalsOS.size(); ++i) {
        const std::optional<glm::dvec3> normalOS = directionOf(mesh.normalsOS[i]);
        mesh.normalsOS[i] = normalOS.value_or(glm::dvec3(0.0, 0.0, 1.0));
        isBroken[i] = !normalOS;
        brokenCount += normalOS ? 0 : 1;
    }
    for (std::size_t corner = 0; brokenCount > 0 && corner < mesh.indices.size(); ++corner) {
        const std::uint32_t vertex = mesh.indices[corner];
        if (isBroken[vertex]) mesh.normalsOS[vertex] = faceNormalOS(mesh, corner / 3 * 3);
    }
    return brokenCount;
}

/// Makes tangents unit length and their w +1 or -1. False when one cannot be.
bool normalizeTangents(Mesh& mesh) {
    for (glm::vec4& tangentOS : mesh.tangentsOS) {
        const std::optional<glm::dvec3> direction = directionOf(glm::vec3(tangentOS));
        if (!direction || !(std::abs(tangentOS.w) > 0.0f)) return false;
        tangentOS = glm::vec4(glm::vec3(*direction), tangentOS.w > 0.0f ? 1.0f : -1.0f);
    }
    return true;
}

} // namespace

std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners) {
    if (mode != kStrip && mode != kFan) {
        corners.resize(corners.size() / 3 * 3);
        return corners;
    }
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool isOdd = i % 2 == 1;
        const std::uint32_t a = mode == kFan ? corners[i + 1] : corners[i];
        const std::uint32_t b = mode == kFan ? corners[i + 2] : corners[i + (isOdd ? 2 : 1)];
        const std::uint32_t c = mode == kFan ? corners[0] : corners[i + (isOdd ? 1 : 2)];
        if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

void finishNormals(Context& context, const std::string& place, Shape& shape) {
    Mesh& mesh = shape.rest;
    // What is added to attributes that are not there is nothing.
    for (MorphTarget& target : shape.targets) {
        if (mesh.colors.empty()) target.colors.clear();
        for (std::size_t set = 0; set < mesh.texCoords.size(); ++set)
            if (mesh.texCoords[set].empty()) target.texCoords[set].clear();
    }
    if (mesh.normalsOS.empty()) {
        constexpr std::size_t kMostVertexBytes = 2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4);
        const std::size_t mostBytes =
            (1 + shape.targets.size()) * kMostVertexBytes + shape.influences * (sizeof(std::uint32_t) + sizeof(float));
        context.document.charge(mesh.indices.size() * mostBytes, place);
        return makeFlat(shape);
    }
    if (const std::size_t broken = repairNormals(mesh); broken > 0)
        context.warn("{}/attributes/NORMAL: {} normals have no direction; their triangles' are used", place, broken);
    if (!normalizeTangents(mesh)) {
        mesh.tangentsOS.clear();
        context.warn("{}/attributes/TANGENT: holds tangents without a direction; tangents are derived instead", place);
    }
    if (mesh.tangentsOS.empty())
        for (MorphTarget& target : shape.targets) target.tangentsOS.clear();
}

} // namespace tessera::scenes::gltf
