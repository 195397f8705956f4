#include "scenes/ClosedBodies.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scenes/InUse.h"

namespace tessera::scenes {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Seams = ClosedMeshes::Seams;

/// Finds the edges that are traversed in one direction only.
Seams seamsOf(const std::vector<Edge>& passed) {
    // Sorts the two directions of an edge next to each other.
    const auto sorted = [](Edge edge) {
        const auto [low, high] = std::minmax(edge.first, edge.second);
        return std::tuple(low, high, edge.first > edge.second);
    };
    std::vector<std::tuple<std::uint32_t, std::uint32_t, bool>> ways(passed.size());
    std::ranges::transform(passed, ways.begin(), sorted);
    std::ranges::sort(ways);
    Seams seams;
    seams.isManifold = std::ranges::adjacent_find(ways) == ways.end();
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const auto [low, high, isBack] = ways[i];
        const bool isBoth = i + 1 < ways.size() && low == std::get<0>(ways[i + 1]) && high == std::get<1>(ways[i + 1]);
        if (isBoth)
            ++i;
        else
            seams.edges.push_back(isBack ? Edge{high, low} : Edge{low, high});
    }
    return seams;
}

Seams seamsOf(const Mesh& mesh) {
    std::vector<Edge> passed;
    passed.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* const corners = &mesh.indices[i];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        for (int c = 0; c < 3; ++c) passed.emplace_back(corners[c], corners[(c + 1) % 3]);
    }
    return seamsOf(passed);
}

/// Welding tolerance: positions on the two sides of a seam differ by rounding.
float weldedMetres(const Mesh& mesh) {
    if (mesh.positionsOS.empty()) return 0.0f;
    glm::vec3 low = mesh.positionsOS[0], high = low;
    for (const glm::vec3& position : mesh.positionsOS) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::vec3 size = high - low, extent = glm::max(glm::abs(low), glm::abs(high));
    return std::max(
        {1e-6f * std::max({size.x, size.y, size.z}), 4e-7f * std::max({extent.x, extent.y, extent.z}), 1e-30f});
}

/// Replaces each vertex of the edges by the first one at its position.
void weld(std::vector<Edge>& edges, const Mesh& mesh) {
    const auto position = [&](std::uint32_t vertex) { return glm::dvec3(mesh.positionsOS[vertex]); };
    std::vector<std::uint32_t> vertices;
    for (const auto& [from, to] : edges) vertices.insert(vertices.end(), {from, to});
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    // Sorted along a generic direction, not perpendicular to rows of vertices, coincident vertices are neighbours.
    const glm::dvec3 direction(0.726, 0.548, 0.4137);
    const auto along = [&](std::uint32_t vertex) { return glm::dot(direction, position(vertex)); };
    std::vector<std::uint32_t> sorted = vertices;
    std::ranges::stable_sort(sorted, {}, along);
    const double most = weldedMetres(mesh);
    std::vector<std::uint32_t> first(mesh.positionsOS.size());
    for (const std::uint32_t vertex : vertices) first[vertex] = vertex;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t k = i; k-- > 0 && along(sorted[i]) - along(sorted[k]) <= most;) {
            if (glm::distance(position(sorted[i]), position(sorted[k])) > most) continue;
            first[sorted[i]] = first[sorted[k]];
            break;
        }
    for (auto& [from, to] : edges) std::tie(from, to) = std::tuple(first[from], first[to]);
    std::erase_if(edges, [](const Edge& edge) { return edge.first == edge.second; });
}

bool enclosesVolume(const Mesh& mesh) {
    double volume = 0.0, area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 origin(mesh.positionsOS[mesh.indices[0]]);
        glm::dvec3 corners[3];
        for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(mesh.positionsOS[mesh.indices[i + c]]) - origin;
        volume += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
        area += 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    }
    // The volume of a sphere is 0.09 area^(3/2); that of a two-sided sheet is rounding alone.
    return volume > 1e-6 * area * std::sqrt(area);
}

bool closes(const Mesh& mesh, const Seams& seams) {
    if (!seams.isManifold || !enclosesVolume(mesh)) return false;
    std::vector<Edge> edges = seams.edges;
    weld(edges, mesh);
    const Seams left = seamsOf(edges);
    return left.isManifold && left.edges.empty();
}

} // namespace

bool isClosed(const Mesh& mesh) {
    return closes(mesh, seamsOf(mesh));
}

bool ClosedMeshes::isClosed(const Scene& scene, std::size_t mesh) {
    known_.resize(std::max(known_.size(), scene.meshes.size()));
    Known& known = known_[mesh];
    if (!known.seams) known.seams = seamsOf(scene.meshes[mesh]);
    if (!known.isClosed) known.isClosed = closes(scene.meshes[mesh], *known.seams);
    return *known.isClosed;
}

void ClosedMeshes::verticesMoved() {
    for (Known& known : known_) known.isClosed.reset();
}

std::vector<bool> closedBodies(const Scene& scene, ClosedMeshes& meshes) {
    std::vector<bool> used(scene.materials.size()), open(used.size());
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) {
            if (!isDrawn(scene, instance)) continue;
            const auto material = std::size_t(instance.material);
            if (!hasBody(scene.materials[material])) continue;
            used[material] = true;
            if (!meshes.isClosed(scene, std::size_t(instance.mesh))) open[material] = true;
        }
    for (std::size_t i = 0; i < used.size(); ++i) used[i] = used[i] && !open[i];
    return used;
}

bool hasClosedBodies(const Scene& scene, ClosedMeshes& meshes) {
    const std::vector<bool> closed = closedBodies(scene, meshes);
    return std::ranges::find(closed, true) != closed.end();
}

} // namespace tessera::scenes
