#include "renderer/frame/Tangents.h"

#include <cmath>

namespace tessera::frame {

namespace {

/// A unit vector perpendicular to n that does not jump between neighbouring normals, except near n = -z.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::dvec3 anyPerpendicular(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

glm::vec4 tangentAt(const glm::dvec3& normal, const glm::dvec3& alongU, const glm::dvec3& alongV) {
    // The normal's length is off by its rounding to fp32, which matters where the texture runs nearly along it.
    const glm::dvec3 flat = alongU - normal * (glm::dot(normal, alongU) / glm::dot(normal, normal));
    const double length = glm::length(flat);
    // Below this share of its own length the direction is rounding noise.
    if (!(length > 1e-12 * glm::length(alongU)) || length == 0.0) return {glm::vec3(anyPerpendicular(normal)), 1.0f};
    const glm::dvec3 tangent = flat / length;
    const bool mirrored = glm::dot(glm::cross(normal, tangent), alongV) < 0.0;
    return {glm::vec3(tangent), mirrored ? -1.0f : 1.0f};
}

} // namespace

std::vector<glm::vec4> computeTangents(const scenes::Mesh& mesh, std::size_t texCoordSet) {
    const std::vector<glm::vec2>& uv = mesh.texCoords[texCoordSet];
    std::vector<glm::dvec3> alongU(mesh.positionsOS.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> alongV(mesh.positionsOS.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size() && !uv.empty(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::dvec3 edge1 = glm::dvec3(mesh.positionsOS[b]) - glm::dvec3(mesh.positionsOS[a]);
        const glm::dvec3 edge2 = glm::dvec3(mesh.positionsOS[c]) - glm::dvec3(mesh.positionsOS[a]);
        // v points down in Scene's texture coordinates and up in tangent space.
        const glm::dvec2 d1 = glm::dvec2(uv[b] - uv[a]) * glm::dvec2(1.0, -1.0);
        const glm::dvec2 d2 = glm::dvec2(uv[c] - uv[a]) * glm::dvec2(1.0, -1.0);
        const double area = d1.x * d2.y - d2.x * d1.y;
        if (area == 0.0) continue;
        const glm::dvec3 u = (edge1 * d2.y - edge2 * d1.y) / area;
        const glm::dvec3 v = (edge2 * d1.x - edge1 * d2.x) / area;
        for (std::uint32_t vertex : {a, b, c}) {
            alongU[vertex] += u;
            alongV[vertex] += v;
        }
    }
    std::vector<glm::vec4> tangents(mesh.positionsOS.size());
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        tangents[i] = tangentAt(glm::dvec3(mesh.normalsOS[i]), alongU[i], alongV[i]);
    }
    return tangents;
}

} // namespace tessera::frame
