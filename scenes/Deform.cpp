#include "scenes/Deform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "scenes/Direction.h"
#include "scenes/Transform.h"

namespace tessera::scenes {
namespace {

/// A morph target with a weight other than 0.
struct Morph {
    const MorphTarget* target;
    double weight;
};

template <typename Wide, typename Vector, typename Pick>
Wide morphed(const Vector& rest, const std::vector<Morph>& morphs, std::size_t vertex, const Pick& pick) {
    Wide sum(rest);
    for (const Morph& morph : morphs) {
        const auto& added = pick(*morph.target);
        if (!added.empty()) sum += morph.weight * Wide(added[vertex]);
    }
    return sum;
}

/// Weighted mean of a vertex's joint matrices; the weights need not sum to 1.
glm::dmat4x3 blended(const Shape& shape, const VertexMatrices& matrices, std::size_t vertex) {
    glm::dmat4x3 sum(0.0);
    double weights = 0.0;
    for (std::size_t i = vertex * shape.influences; i < (vertex + 1) * shape.influences; ++i) {
        const double weight = double(shape.weights[i]);
        if (weight == 0.0) continue;
        sum += matrices.fromBind[shape.joints[i]] * weight;
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : matrices.ofOwn;
}

/// Sign of the determinant: -1 for mirroring, 0 for singular matrices.
double sideOf(const glm::dmat4x3& matrix) {
    const double determinant = glm::determinant(glm::dmat3(matrix));
    return determinant < 0.0 ? -1.0 : determinant > 0.0 ? 1.0 : 0.0;
}

/// Whether the matrices mirror most vertices, weighted by joint influence.
bool isMirrored(const Shape& shape, const VertexMatrices& matrices) {
    const double ofOwn = sideOf(matrices.ofOwn);
    // Evaluated once per joint, unless the skin has more joints than the mesh has influences.
    std::vector<double> ofJoints;
    if (matrices.fromBind.size() <= shape.joints.size()) {
        ofJoints.reserve(matrices.fromBind.size());
        for (const glm::dmat4x3& fromBind : matrices.fromBind) ofJoints.push_back(sideOf(fromBind));
        if (ofOwn > 0.0 && std::ranges::all_of(ofJoints, [](double side) { return side > 0.0; })) return false;
    }
    const std::size_t vertices = shape.rest.positionsOS.size();
    double sum = 0.0;
    for (std::size_t v = 0; v < vertices; ++v) {
        double sides = 0.0, weights = 0.0;
        for (std::size_t i = v * shape.influences; i < (v + 1) * shape.influences; ++i) {
            const double weight = double(shape.weights[i]);
            if (weight == 0.0) continue;
            const std::uint32_t joint = shape.joints[i];
            sides += weight * (ofJoints.empty() ? sideOf(matrices.fromBind[joint]) : ofJoints[joint]);
            weights += weight;
        }
        sum += weights > 0.0 ? sides / weights : ofOwn;
    }
    return sum < 0.0;
}

void setFlatNormals(Mesh& mesh, const std::vector<glm::dvec3>& positionsOS) {
    for (std::size_t corner = 0; corner + 2 < mesh.indices.size(); corner += 3) {
        const std::array<std::uint32_t, 3> at{mesh.indices[corner], mesh.indices[corner + 1], mesh.indices[corner + 2]};
        const glm::vec3 normalOS(normalOfTriangle(positionsOS[at[0]], positionsOS[at[1]], positionsOS[at[2]]));
        for (const std::uint32_t vertex : at) mesh.normalsOS[vertex] = normalOS;
    }
}

} // namespace

glm::dmat4 deform(const Shape& shape, std::span<const double> weights, const VertexMatrices* matrices, Mesh& mesh) {
    const Mesh& rest = shape.rest;
    const std::size_t vertices = rest.positionsOS.size();
    std::vector<Morph> morphs;
    for (std::size_t i = 0; i < std::min(weights.size(), shape.targets.size()); ++i)
        if (weights[i] != 0.0) morphs.push_back({&shape.targets[i], weights[i]});
    const bool mirrors = matrices != nullptr && isMirrored(shape, *matrices);
    const glm::dvec3 mirror(mirrors ? -1.0 : 1.0, 1.0, 1.0);

    std::vector<glm::dvec3> positions(vertices);
    const auto deformVertex = [&](std::size_t v) {
        glm::dvec3 position = morphed<glm::dvec3>(
            rest.positionsOS[v], morphs, v, [](const MorphTarget& t) -> const auto& { return t.positionsOS; });
        glm::dvec3 normal(rest.normalsOS[v]), tangent(0.0);
        if (!shape.isFlat)
            normal = morphed<glm::dvec3>(
                rest.normalsOS[v], morphs, v, [](const MorphTarget& t) -> const auto& { return t.normalsOS; });
        if (!rest.tangentsOS.empty())
            tangent = morphed<glm::dvec3>(
                glm::vec3(rest.tangentsOS[v]), morphs, v,
                [](const MorphTarget& t) -> const auto& { return t.tangentsOS; });
        if (matrices != nullptr) {
            glm::dmat4x3 moved = blended(shape, *matrices, v);
            for (int column = 0; column < 4; ++column) moved[column] *= mirror;
            position = moved * glm::dvec4(position, 1.0);
            normal = cofactorOf(glm::dmat3(moved)) * normal;
            tangent = glm::dmat3(moved) * tangent;
        }
        positions[v] = position;
        // If a singular matrix or morph targets leave no direction, the rest direction is used.
        mesh.normalsOS[v] = directionOf(normal).value_or(glm::dvec3(rest.normalsOS[v]));
        if (!rest.tangentsOS.empty())
            mesh.tangentsOS[v] =
                glm::vec4(directionOf(tangent).value_or(glm::dvec3(rest.tangentsOS[v])), rest.tangentsOS[v].w);
    };
    constexpr std::size_t kVerticesOfATask = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices, kVerticesOfATask),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t v = range.begin(); v < range.end(); ++v) deformVertex(v);
                      });
    glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
    bool isFinite = true;
    for (const glm::dvec3& position : positions) {
        least = glm::min(least, position);
        most = glm::max(most, position);
        isFinite = isFinite && std::isfinite(position.x + position.y + position.z);
    }
    const glm::dvec3 middle = matrices != nullptr && vertices > 0 ? 0.5 * least + 0.5 * most : glm::dvec3(0.0);
    for (std::size_t v = 0; v < vertices; ++v) mesh.positionsOS[v] = glm::vec3(positions[v] - middle);
    if (shape.isFlat) setFlatNormals(mesh, positions);
    for (std::size_t set = 0; set < rest.texCoords.size(); ++set)
        for (std::size_t v = 0; v < rest.texCoords[set].size(); ++v)
            mesh.texCoords[set][v] = morphed<glm::dvec2>(
                rest.texCoords[set][v], morphs,
                v, [set](const MorphTarget& t) -> const auto& { return t.texCoords[set]; });
    // Source: glTF 2.0 specification, 3.7.2.2: colours are clamped after targets are added.
    for (std::size_t v = 0; v < rest.colors.size(); ++v)
        mesh.colors[v] =
            glm::clamp(morphed<glm::dvec4>(
                           rest.colors[v], morphs, v, [](const MorphTarget& t) -> const auto& { return t.colors; }),
                       0.0, 1.0);

    glm::dmat4 nodeFromMesh(1.0);
    nodeFromMesh[0][0] = mirror.x;
    // The middle was mirrored with the vertices, so it is mirrored back.
    nodeFromMesh[3] = glm::dvec4(mirror * middle, 1.0);
    if (!isFinite) nodeFromMesh[3] = glm::dvec4(glm::dvec3(std::numeric_limits<double>::quiet_NaN()), 1.0);
    return nodeFromMesh;
}

} // namespace tessera::scenes
