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

} // namespace

CornerNormals::CornerNormals(const ObjFile& obj) : obj_(obj) {
    normals_.reserve(obj.normalsOS.size());
    for (const glm::vec3& normalOS : obj.normalsOS) normals_.push_back(unitOr(normalOS, glm::vec3(0.0f)));
    addSmoothNormals();
}

std::size_t CornerNormals::indexAt(const Triangle& triangle, std::size_t corner) {
    const Corner& index = triangle.corners[corner];
    if (isGiven(index)) return static_cast<std::size_t>(index.normal);
    if (index.normal != kNone) replacedZeroNormals_ = true;
    if (triangle.smoothingGroup != 0) return smooth_.at(keyOf(index.position, triangle.smoothingGroup));
    if (flatTriangle_ != &triangle) {
        const std::array<glm::dvec3, 3> normals = weightedNormals(triangle);
        normals_.push_back(unitOr(normals[0] + normals[1] + normals[2], kUp));
        flatTriangle_ = &triangle;
    }
    return normals_.size() - 1;
}

std::uint64_t CornerNormals::keyOf(int position, std::uint32_t smoothingGroup) {
    return static_cast<std::uint64_t>(position) << 32 | smoothingGroup;
}

bool CornerNormals::isGiven(const Corner& corner) const {
    return corner.normal != kNone && normals_[static_cast<std::size_t>(corner.normal)] != glm::vec3(0.0f);
}

/// The triangle's unit normal times its angle at each corner; zero without area.
std::array<glm::dvec3, 3> CornerNormals::weightedNormals(const Triangle& triangle) const {
    std::array<glm::dvec3, 3> positions;
    for (std::size_t i = 0; i < 3; ++i)
        positions[i] = obj_.positionsOS[static_cast<std::size_t>(triangle.corners[i].position)];
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

void CornerNormals::addSmoothNormals() {
    std::vector<glm::dvec3> sums; // of the normals that follow those of the file
    for (const Group& group : obj_.groups) {
        for (const Triangle& triangle : group.triangles) {
            // A triangle with all its normals needs none made, and its neighbours in a file have them too.
            const auto hasNormal = [&](const Corner& corner) { return isGiven(corner); };
            if (triangle.smoothingGroup == 0 || std::ranges::all_of(triangle.corners, hasNormal)) continue;
            const std::array<glm::dvec3, 3> normals = weightedNormals(triangle);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint64_t key = keyOf(triangle.corners[i].position, triangle.smoothingGroup);
                const auto [entry, isNew] = smooth_.try_emplace(key, normals_.size() + sums.size());
                if (isNew) sums.emplace_back(0.0);
                sums[entry->second - normals_.size()] += normals[i];
            }
        }
    }
    normals_.reserve(normals_.size() + sums.size());
    for (const glm::dvec3& sum : sums) normals_.push_back(unitOr(sum, kUp));
}

} // namespace tessera::scenes::obj
