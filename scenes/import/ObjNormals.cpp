#include "scenes/import/ObjNormals.h"

#include <algorithm>
#include <cmath>

namespace tessera::scenes::obj {
namespace {

glm::vec3 unitOr(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

constexpr glm::vec3 kUp{0.0f, 1.0f, 0.0f};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 vectorAt(const std::vector<tinyobj::real_t>& values, int index) {
    const std::size_t at = static_cast<std::size_t>(index) * 3;
    return {values[at], values[at + 1], values[at + 2]};
}

} // namespace

CornerNormals::CornerNormals(const tinyobj::attrib_t& attributes, const std::vector<tinyobj::shape_t>& shapes)
    : attributes_(attributes) {
    const std::size_t given = attributes.normals.size() / 3;
    normals_.reserve(given);
    for (std::size_t i = 0; i < given; ++i)
        normals_.push_back(unitOr(vectorAt(attributes.normals, static_cast<int>(i)), glm::vec3(0.0f)));
    addSmoothNormals(shapes);
}

std::size_t CornerNormals::indexAt(const tinyobj::mesh_t& mesh, std::size_t triangle, std::size_t corner) {
    const tinyobj::index_t& index = mesh.indices[triangle * 3 + corner];
    if (isGiven(index)) return static_cast<std::size_t>(index.normal_index);
    if (index.normal_index >= 0) replacedZeroNormals_ = true;
    const unsigned int group = mesh.smoothing_group_ids[triangle];
    if (group != 0) return smooth_.at(keyOf(index.vertex_index, group));
    if (flatMesh_ != &mesh || flatTriangle_ != triangle) {
        const std::array<glm::dvec3, 3> normals = weightedNormals(mesh, triangle);
        normals_.push_back(unitOr(normals[0] + normals[1] + normals[2], kUp));
        flatMesh_ = &mesh;
        flatTriangle_ = triangle;
    }
    return normals_.size() - 1;
}

std::uint64_t CornerNormals::keyOf(int position, unsigned int group) {
    return static_cast<std::uint64_t>(position) << 32 | group;
}

glm::dvec3 CornerNormals::positionOf(const tinyobj::index_t& index) const {
    return vectorAt(attributes_.vertices, index.vertex_index);
}

bool CornerNormals::isGiven(const tinyobj::index_t& index) const {
    return index.normal_index >= 0 && normals_[static_cast<std::size_t>(index.normal_index)] != glm::vec3(0.0f);
}

/// The triangle's unit normal times its angle at each corner; zero without area.
std::array<glm::dvec3, 3> CornerNormals::weightedNormals(const tinyobj::mesh_t& mesh, std::size_t triangle) const {
    std::array<glm::dvec3, 3> positions;
    for (std::size_t i = 0; i < 3; ++i) positions[i] = positionOf(mesh.indices[triangle * 3 + i]);
    std::array<glm::dvec3, 3> normals{};
    const glm::dvec3 areaNormal = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
    const double length = glm::length(areaNormal);
    if (!(length > 0.0)) return normals;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 toNext = positions[(i + 1) % 3] - positions[i];
        const glm::dvec3 toPrevious = positions[(i + 2) % 3] - positions[i];
        normals[i] = areaNormal / length * angleBetween(toNext, toPrevious);
    }
    return normals;
}

void CornerNormals::addSmoothNormals(const std::vector<tinyobj::shape_t>& shapes) {
    std::unordered_map<std::uint64_t, std::size_t> sumOfKey;
    std::vector<glm::dvec3> sums;
    for (const tinyobj::shape_t& shape : shapes) {
        const tinyobj::mesh_t& mesh = shape.mesh;
        for (std::size_t triangle = 0; triangle < mesh.smoothing_group_ids.size(); ++triangle) {
            const unsigned int group = mesh.smoothing_group_ids[triangle];
            const auto corners = mesh.indices.begin() + static_cast<std::ptrdiff_t>(triangle * 3);
            // A triangle with all its normals needs none made, and its neighbours in a file have them too.
            if (group == 0 || std::all_of(corners, corners + 3, [&](const auto& index) { return isGiven(index); }))
                continue;
            const std::array<glm::dvec3, 3> normals = weightedNormals(mesh, triangle);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint64_t key = keyOf(mesh.indices[triangle * 3 + i].vertex_index, group);
                const auto [entry, isNew] = sumOfKey.try_emplace(key, sums.size());
                if (isNew) sums.emplace_back(0.0);
                sums[entry->second] += normals[i];
            }
        }
    }
    for (const auto& [key, sum] : sumOfKey) smooth_[key] = normals_.size() + sum;
    for (const glm::dvec3& sum : sums) normals_.push_back(unitOr(sum, kUp));
}

} // namespace tessera::scenes::obj
