#include "scenes/ClosedBodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "scenes/InUse.h"

namespace tessera::scenes {
namespace {

/// Of each vertex the first at the same place, up to rounding: the ends of a turn differ by some.
std::vector<std::uint32_t> weldedByPlace(const Mesh& mesh) {
    Box3 box;
    for (const glm::vec3& position : mesh.positionsOS) box.extend(glm::dvec3(position));
    if (box.empty()) return {};
    const glm::dvec3 size = box.max - box.min, reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double near =
        std::max({1e-6 * std::max({size.x, size.y, size.z}), 4e-7 * std::max({reach.x, reach.y, reach.z}), 1e-30});
    using Cell = std::array<std::int64_t, 3>;
    const auto hash = [](const Cell& cell) {
        std::size_t mixed = 0;
        for (const std::int64_t part : cell) mixed = (mixed ^ std::size_t(part)) * 0x9e3779b97f4a7c15u;
        return mixed ^ (mixed >> 32);
    };
    const double cellSize = 4.0 * near;
    const auto cellOf = [&](const glm::dvec3& place) {
        const glm::dvec3 cell = glm::floor((place - box.min) / cellSize);
        return Cell{std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z)};
    };
    std::unordered_map<Cell, std::vector<std::uint32_t>, decltype(hash)> cells(mesh.positionsOS.size(), hash);
    std::vector<std::uint32_t> welded;
    welded.reserve(mesh.positionsOS.size());
    for (std::uint32_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::dvec3 place(mesh.positionsOS[i]);
        const Cell low = cellOf(place - near), high = cellOf(place + near);
        std::optional<std::uint32_t> same;
        for (std::int64_t x = low[0]; x <= high[0] && !same; ++x)
            for (std::int64_t y = low[1]; y <= high[1] && !same; ++y)
                for (std::int64_t z = low[2]; z <= high[2] && !same; ++z) {
                    const auto found = cells.find({x, y, z});
                    if (found == cells.end()) continue;
                    for (const std::uint32_t other : found->second)
                        if (glm::distance(glm::dvec3(mesh.positionsOS[other]), place) <= near) same = other;
                }
        if (!same) cells[cellOf(place)].push_back(i);
        welded.push_back(same.value_or(i));
    }
    return welded;
}

} // namespace

bool isClosed(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weldedByPlace(mesh);
    std::vector<std::uint64_t> edges, turned;
    double volume = 0.0, area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t corners[] = {welded[mesh.indices[i]], welded[mesh.indices[i + 1]],
                                         welded[mesh.indices[i + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        const glm::dvec3 origin(mesh.positionsOS[mesh.indices[0]]);
        glm::dvec3 places[3];
        for (int c = 0; c < 3; ++c) {
            places[c] = glm::dvec3(mesh.positionsOS[corners[c]]) - origin;
            const std::uint64_t from = corners[c], to = corners[(c + 1) % 3];
            edges.push_back(from << 32 | to);
            turned.push_back(to << 32 | from);
        }
        volume += glm::dot(places[0], glm::cross(places[1], places[2])) / 6.0;
        area += 0.5 * glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
    }
    // Of spheres the volume is 0.09 of the area to the power of 3/2; of a sheet with two sides rounding is left.
    if (!(volume > 1e-6 * area * std::sqrt(area))) return false;
    std::ranges::sort(edges);
    std::ranges::sort(turned);
    return std::ranges::adjacent_find(edges) == edges.end() && edges == turned;
}

std::vector<bool> closedBodies(const Scene& scene, std::vector<std::optional<bool>>& known) {
    known.resize(scene.meshes.size());
    std::vector<bool> used(scene.materials.size()), open(used.size());
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) {
            if (!isDrawn(scene, instance)) continue;
            const auto mesh = std::size_t(instance.mesh), material = std::size_t(instance.material);
            if (!hasBody(scene.materials[material])) continue;
            if (!known[mesh]) known[mesh] = isClosed(scene.meshes[mesh]);
            used[material] = true;
            if (!*known[mesh]) open[material] = true;
        }
    for (std::size_t i = 0; i < used.size(); ++i) used[i] = used[i] && !open[i];
    return used;
}

std::vector<bool> closedBodies(const Scene& scene) {
    std::vector<std::optional<bool>> known;
    return closedBodies(scene, known);
}

bool hasClosedBodies(const Scene& scene, std::vector<std::optional<bool>>& known) {
    const std::vector<bool> closed = closedBodies(scene, known);
    return std::ranges::find(closed, true) != closed.end();
}

} // namespace tessera::scenes
