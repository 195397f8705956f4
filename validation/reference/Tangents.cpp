#include "validation/reference/Tangents.h"

#include <cmath>

namespace tessera::reference {

namespace {

/// Directions in object space in which the texture coordinates grow.
struct Growth {
    glm::dvec3 u{0.0}, v{0.0};
};

/// Those of one triangle, by solving [edge1 edge2] = [u v] [uv1 uv2]; zero where its coordinates span no area.
Growth growthOf(const glm::dmat2x3& edges, const glm::dmat2& uv) {
    const double area = glm::determinant(uv);
    if (area == 0.0) return {};
    const glm::dmat2x3 directions = edges * glm::inverse(uv);
    return {directions[0], directions[1]};
}

/// Duff et al. 2017, listing 3, first vector.
glm::dvec3 perpendicularTo(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    return {1.0 - sign * n.x * n.x / (sign + n.z), -sign * n.x * n.y / (sign + n.z), -sign * n.x};
}

/// Shares of a direction below this are what rounding leaves of one along the normal.
constexpr double kSmallestShare = 1e-12;

glm::dvec4 frameOf(const glm::dvec3& vertexNormal, const Growth& growth) {
    const glm::dvec3 normal = glm::normalize(vertexNormal);
    const glm::dvec3 flat = growth.u - glm::dot(normal, growth.u) * normal;
    if (!(glm::length(flat) > kSmallestShare * glm::length(growth.u))) return {perpendicularTo(vertexNormal), 1.0};
    const glm::dvec3 tangent = glm::normalize(flat);
    const double side = glm::dot(glm::cross(normal, tangent), growth.v);
    return {tangent, side < 0.0 ? -1.0 : 1.0};
}

} // namespace

std::vector<glm::dvec4> tangentsOS(const scenes::Mesh& mesh, std::size_t texCoordSet) {
    const std::vector<glm::vec2>& texCoords = mesh.texCoords[texCoordSet];
    const auto uvUp = [&](std::uint32_t vertex) {
        return texCoords.empty() ? glm::dvec2(0.0) : glm::dvec2(texCoords[vertex].x, -double(texCoords[vertex].y));
    };
    std::vector<Growth> growth(mesh.positionsOS.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const glm::dvec3 originOS(mesh.positionsOS[corner[0]]);
        const Growth share = growthOf(
            {glm::dvec3(mesh.positionsOS[corner[1]]) - originOS, glm::dvec3(mesh.positionsOS[corner[2]]) - originOS},
            {uvUp(corner[1]) - uvUp(corner[0]), uvUp(corner[2]) - uvUp(corner[0])});
        for (int k = 0; k < 3; ++k) {
            growth[corner[k]].u += share.u;
            growth[corner[k]].v += share.v;
        }
    }
    std::vector<glm::dvec4> tangents;
    tangents.reserve(growth.size());
    for (std::size_t i = 0; i < growth.size(); ++i)
        tangents.push_back(frameOf(glm::dvec3(mesh.normalsOS[i]), growth[i]));
    return tangents;
}

} // namespace tessera::reference
