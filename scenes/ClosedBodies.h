#pragma once
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Whether a mesh has an inside: once the vertices of its seams are welded, each edge belongs to two triangles that
/// pass it in opposite directions, and the faces enclose a volume that they face away from.
bool isClosed(const Mesh& mesh);

/// Which meshes of a scene are closed. Triangles are read once per mesh; moved vertices cost their seams and the
/// volume.
class ClosedMeshes {
public:
    bool isClosed(const Scene& scene, std::size_t mesh);
    /// Forgets all but the triangles, which must stay as they are.
    void verticesMoved();

    /// Edges that triangles with these indices pass only one way, as if vertices at one position were different.
    struct Seams {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        bool isManifold = true; ///< no edge is passed twice the same way
    };

private:
    struct Known {
        std::optional<Seams> seams;
        std::optional<bool> isClosed;
    };
    std::vector<Known> known_; ///< by mesh
};

/// Finds the transmissive materials with a body whose drawn meshes are all closed.
std::vector<bool> closedBodies(const Scene& scene, ClosedMeshes& meshes);
bool hasClosedBodies(const Scene& scene, ClosedMeshes& meshes);

} // namespace tessera::scenes
