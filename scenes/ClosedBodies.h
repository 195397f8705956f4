#pragma once
#include <optional>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Whether a mesh has an inside: once vertices at one place are one, each edge belongs to two triangles that pass it in
/// opposite directions, and the faces enclose a volume that they face away from.
bool isClosed(const Mesh& mesh);

/// Which materials are bodies of what transmits, each of whose meshes that are drawn is closed. `known`, by mesh, keeps
/// what was found before of meshes that are still the same.
std::vector<bool> closedBodies(const Scene& scene, std::vector<std::optional<bool>>& known);
std::vector<bool> closedBodies(const Scene& scene);
bool hasClosedBodies(const Scene& scene, std::vector<std::optional<bool>>& known);

} // namespace tessera::scenes
