#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::scenes::obj {

/// Cuts a polygon of n >= 3 corners into n - 2 triangles of its orientation by clipping ears, the one with the shortest
/// cut first, so that a convex quad gets its shorter diagonal. Where a polygon that crosses itself or has no area has
/// no ear left, a corner is clipped all the same. Raises `steps` by how often a corner is looked at; once they exceed
/// `mostSteps` the rest is a fan. Source: Meisters 1975, "Polygons have ears"; corners are found by a grid.
std::vector<std::array<std::size_t, 3>> cutPolygon(std::span<const glm::dvec3> corners, std::uint64_t& steps,
                                                   std::uint64_t mostSteps);

} // namespace tessera::scenes::obj
