#pragma once
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Whether a mesh is closed: after welding its seams, each edge belongs to two triangles that traverse it in opposite
/// directions, and the faces enclose a volume, facing outwards.
bool isClosed(const Mesh& mesh);

/// Caches which meshes of a scene are closed. The topology is read once per mesh; after vertices move, only seams and
/// volume are checked again.
class ClosedMeshes {
public:
    bool isClosed(const Scene& scene, std::size_t mesh);
    /// Discards everything except the topology, which must stay the same.
    void verticesMoved();

    /// Edges of the index buffer that are traversed in one direction only, before coincident vertices are welded.
    struct Seams {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        bool isManifold = true; ///< no edge is traversed twice in the same direction
    };

private:
    struct Known {
        std::optional<Seams> seams;
        std::optional<bool> isClosed;
    };
    std::vector<Known> known_; ///< by mesh
};

/// By material: whether it is transmissive with a body (hasBody()) and all meshes drawn with it are closed.
std::vector<bool> closedBodies(const Scene& scene, ClosedMeshes& meshes);
bool hasClosedBodies(const Scene& scene, ClosedMeshes& meshes);

} // namespace tessera::scenes
