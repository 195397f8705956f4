#include "scenes/import/GltfTriangles.h"

#include <cmath>
#include <optional>

namespace tessera::scenes::gltf {
namespace {

constexpr int kStrip = 5;
constexpr int kFan = 6;

/// In double, because squares of a float's extremes overflow or vanish in float.
std::optional<glm::vec3> unit(const glm::dvec3& direction) {
    const double length = std::sqrt(glm::dot(direction, direction));
    if (!std::isfinite(length) || length == 0.0) return std::nullopt;
    return glm::vec3(direction / length);
}

glm::vec3 faceNormalOS(const Mesh& mesh, std::size_t firstCorner) {
    const glm::dvec3 a = mesh.positionsOS[mesh.indices[firstCorner]];
    const glm::dvec3 b = mesh.positionsOS[mesh.indices[firstCorner + 1]];
    const glm::dvec3 c = mesh.positionsOS[mesh.indices[firstCorner + 2]];
    return unit(glm::cross(b - a, c - a)).value_or(glm::vec3(0.0f, 0.0f, 1.0f));
}

template <typename T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> own;
    own.reserve(indices.size());
    for (const std::uint32_t index : indices) own.push_back(values[index]);
    values = std::move(own);
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

void makeFlat(Mesh& mesh) {
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

std::size_t repairNormals(Mesh& mesh) {
    std::vector<bool> isBroken(mesh.normalsOS.size(), false);
    std::size_t brokenCount = 0;
    for (std::size_t i = 0; i < mesh.normalsOS.size(); ++i) {
        const std::optional<glm::vec3> normalOS = unit(mesh.normalsOS[i]);
        mesh.normalsOS[i] = normalOS.value_or(glm::vec3(0.0f, 0.0f, 1.0f));
        isBroken[i] = !normalOS;
        brokenCount += normalOS ? 0 : 1;
    }
    for (std::size_t corner = 0; brokenCount > 0 && corner < mesh.indices.size(); ++corner) {
        const std::uint32_t vertex = mesh.indices[corner];
        if (isBroken[vertex]) mesh.normalsOS[vertex] = faceNormalOS(mesh, corner / 3 * 3);
    }
    return brokenCount;
}

bool normalizeTangents(Mesh& mesh) {
    for (glm::vec4& tangentOS : mesh.tangentsOS) {
        const std::optional<glm::vec3> direction = unit(glm::vec3(tangentOS));
        if (!direction || !(std::abs(tangentOS.w) > 0.0f)) return false;
        tangentOS = glm::vec4(*direction, tangentOS.w > 0.0f ? 1.0f : -1.0f);
    }
    return true;
}

} // namespace tessera::scenes::gltf
