#include "renderer/frame/Tangents.h"

#include <cmath>
#include <numeric>
#include <tuple>

#include <tbb/parallel_sort.h>

#include "renderer/frame/MikkTSpace.h"
#include "renderer/frame/PackedMaterial.h"

namespace tessera::frame {

namespace {

using scenes::TextureSlot;

bool hasAnisotropyMap(const scenes::Material& material) {
    return scenes::infoOf(material.model).anisotropy == scenes::Anisotropy::Strength &&
           material.texture(TextureSlot::Anisotropy).image != scenes::kNone;
}

/// Whether the slot's texture stores vectors; that of an alpha along the bitangent stores a scalar.
bool holdsVectors(const scenes::Material& material, TextureSlot slot) {
    return slot == TextureSlot::Anisotropy ? hasAnisotropyMap(material) : material.texture(slot).image != scenes::kNone;
}

/// The slot whose texture coordinates define the tangents.
std::optional<TextureSlot> followedSlot(const scenes::Material& material) {
    const bool normalMap = material.texture(TextureSlot::Normal).image != scenes::kNone;
    if (normalMap && material.normalMapSpace == scenes::NormalMapSpace::Tangent) return TextureSlot::Normal;
    if (scenes::isAnisotropic(material)) return TextureSlot::Anisotropy;
    const bool coatMap = material.texture(TextureSlot::ClearcoatNormal).image != scenes::kNone;
    if (scenes::infoOf(material.model).hasLayers && material.clearcoat > 0.0f && coatMap)
        return TextureSlot::ClearcoatNormal;
    return std::nullopt;
}

glm::dmat2 vectorTransform(const scenes::Material& material, TextureSlot slot) {
    return holdsVectors(material, slot) ? linearPart(material.texture(slot).transform) : glm::dmat2(1.0);
}

/// The axes of a texture, u and -v, as unit vectors in the mesh's tangent and bitangent, with v made perpendicular to
/// u. A degenerate transform gives the mesh's axes.
glm::dmat2 axesOf(const glm::dmat2& textureFromUv) {
    const double area = glm::determinant(textureFromUv);
    if (area == 0.0) return glm::dmat2(1.0);
    const double side = area < 0.0 ? -1.0 : 1.0;
    // The first column of the inverse up to a positive factor, with v turned upwards.
    const glm::dvec2 alongU = side * glm::dvec2(textureFromUv[1][1], textureFromUv[0][1]);
    const glm::dvec2 u = alongU / glm::length(alongU);
    return {u, side * glm::dvec2(-u.y, u.x)};
}

/// Lengyel 2001.
std::vector<glm::vec4> summedTangents(const scenes::Mesh& mesh, const TangentBasis& basis) {
    const std::vector<glm::vec2>& uv = mesh.texCoords[std::size_t(basis.texCoordSet)];
    // v points down in Scene's texture coordinates and up in tangent space.
    const glm::dmat2 upwards = glm::dmat2(1.0, 0.0, 0.0, -1.0) * basis.textureFromUv;
    std::vector<glm::dvec3> alongU(mesh.positionsOS.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> alongV(mesh.positionsOS.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size() && !uv.empty(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::dvec3 edge1 = glm::dvec3(mesh.positionsOS[b]) - glm::dvec3(mesh.positionsOS[a]);
        const glm::dvec3 edge2 = glm::dvec3(mesh.positionsOS[c]) - glm::dvec3(mesh.positionsOS[a]);
        const glm::dvec2 side1 = glm::dvec2(uv[b]) - glm::dvec2(uv[a]), side2 = glm::dvec2(uv[c]) - glm::dvec2(uv[a]);
        const glm::dvec2 d1 = upwards * side1, d2 = upwards * side2;
        const double area = glm::determinant(upwards) * glm::determinant(glm::dmat2(side1, side2));
        if (area == 0.0) continue;
        const glm::dvec3 u = (edge1 * d2.y - edge2 * d1.y) / area;
        const glm::dvec3 v = (edge2 * d1.x - edge1 * d2.x) / area;
        for (const std::uint32_t vertex : {a, b, c}) {
            alongU[vertex] += u;
            alongV[vertex] += v;
        }
    }
    std::vector<glm::vec4> tangents;
    tangents.reserve(alongU.size());
    for (std::size_t i = 0; i < alongU.size(); ++i) {
        const glm::dvec3 normal(mesh.normalsOS[i]);
        // Divides by the squared length: fp32 rounding of the normal matters where u is nearly parallel to it.
        const glm::dvec3 flat = alongU[i] - normal * (glm::dot(normal, alongU[i]) / glm::dot(normal, normal));
        const double length = glm::length(flat);
        // Below this fraction of its length the direction is rounding noise.
        const bool hasDirection = length > 1e-12 * glm::length(alongU[i]) && length > 0.0;
        const glm::dvec3 tangent = hasDirection ? flat / length : anyPerpendicular(normal);
        const bool mirrored = hasDirection && glm::dot(glm::cross(normal, tangent), alongV[i]) < 0.0;
        tangents.emplace_back(glm::vec3(tangent), mirrored ? -1.0f : 1.0f);
    }
    return tangents;
}

std::vector<glm::vec4> turnedTangents(const scenes::Mesh& mesh, const glm::dmat2& textureFromUv) {
    const glm::dmat2 axes = axesOf(textureFromUv);
    if (axes == glm::dmat2(1.0)) return mesh.tangentsOS;
    std::vector<glm::vec4> tangents;
    tangents.reserve(mesh.tangentsOS.size());
    for (std::size_t i = 0; i < mesh.tangentsOS.size(); ++i) {
        const glm::dvec3 tangent(mesh.tangentsOS[i]);
        const glm::dvec3 bitangent = glm::cross(glm::dvec3(mesh.normalsOS[i]), tangent) * double(mesh.tangentsOS[i].w);
        const glm::dvec3 turned = axes[0].x * tangent + axes[0].y * bitangent;
        const double length = glm::length(turned);
        tangents.emplace_back(glm::vec3(length > 0.0 ? turned / length : tangent),
                              mesh.tangentsOS[i].w * float(glm::sign(glm::determinant(axes))));
    }
    return tangents;
}

/// Gives each vertex the first of its corners' tangents, and adds a copy for each further tangent.
TangentMesh splitByTangent(const scenes::Mesh& mesh, const std::vector<glm::vec4>& cornerTangents) {
    std::vector<std::uint32_t> corners(cornerTangents.size()); // by vertex, then by tangent
    std::iota(corners.begin(), corners.end(), 0u);
    const auto keyOf = [&](std::uint32_t corner) {
        const glm::vec4& t = cornerTangents[corner];
        return std::tuple(mesh.indices[corner], t.x, t.y, t.z, t.w, corner);
    };
    tbb::parallel_sort(corners.begin(), corners.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return keyOf(a) < keyOf(b); });

    TangentMesh split;
    split.indices.resize(mesh.indices.size());
    split.tangentsOS.assign(mesh.positionsOS.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f)); // for unused vertices
    std::uint32_t vertex = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t corner = corners[i], own = mesh.indices[corner];
        if (i == 0 || own != mesh.indices[corners[i - 1]]) {
            vertex = own;
        } else if (cornerTangents[corner] != cornerTangents[corners[i - 1]]) {
            vertex = std::uint32_t(split.tangentsOS.size());
            split.tangentsOS.emplace_back();
            split.copiedOf.push_back(own);
        }
        split.tangentsOS[vertex] = cornerTangents[corner];
        split.indices[corner] = vertex;
    }
    return split;
}

} // namespace

std::optional<TangentBasis> tangentBasis(const scenes::Material& material) {
    const std::optional<TextureSlot> slot = followedSlot(material);
    if (!slot) return std::nullopt;
    return TangentBasis{material.tangents, material.texture(*slot).texCoordSet, vectorTransform(material, *slot)};
}

glm::dmat2 tangentsFromTexture(const scenes::Material& material, scenes::TextureSlot slot) {
    const std::optional<TextureSlot> followed = followedSlot(material);
    if (!followed || *followed == slot) return glm::dmat2(1.0);
    return glm::transpose(axesOf(vectorTransform(material, *followed))) * axesOf(vectorTransform(material, slot));
}

TangentMesh meshWithTangents(const scenes::Mesh& mesh, const TangentBasis& basis) {
    if (!mesh.tangentsOS.empty()) return {mesh.indices, {}, turnedTangents(mesh, basis.textureFromUv)};
    if (basis.method == scenes::TangentMethod::Lengyel) return {mesh.indices, {}, summedTangents(mesh, basis)};
    return splitByTangent(mesh, mikkTSpaceTangents(mesh, std::size_t(basis.texCoordSet), basis.textureFromUv));
}

} // namespace tessera::frame
