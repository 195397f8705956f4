#pragma once
#include <cstdint>
#include <vector>

#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Scene.h"

namespace tessera::engine {

/// Handling of vertices that a hook moves to a non-finite position or beyond its limit.
enum class Excess : std::uint8_t {
    Refuse,
    /// Flags vertices by colour opacities HOOK_MARK_TOO_FAR or HOOK_MARK_NOWHERE (shaders/shared/hook.h). Vertices
    /// moved to NaN or beyond 1000 km stay in place.
    Mark
};

/// A copy of a scene with its vertices displaced by its hook at a given time. The hook runs in a compute shader and the
/// result is read back, so that all passes, bounds, caster trees and the reference use the same vertices.
class HookedScene {
public:
    /// The scene must outlive the object. Vertices are not displaced yet.
    explicit HookedScene(const scenes::Scene& scene);

    /// The scene with displaced vertices. After update(), its hook has movesVertices == false.
    const scenes::Scene& scene() const { return moved_; }

    struct Changed {
        bool vertices = false; ///< a position or a normal
        bool colors = false;   ///< a vertex colour: other vertices are flagged
    };
    /// Copies the scene's lights, cameras, materials and nodes, and displaces its vertices by the hook at that time.
    /// Throws InputError if the hook is faulty or, with Excess::Refuse, if a position or normal is not finite or a
    /// vertex moves beyond the hook's limit. The object is then unchanged.
    Changed update(double timeSeconds, Excess excess, shader::ProgramLibrary& programs);
    /// Copies the meshes again. Call after vertices of the source scene were changed.
    void takeMeshes();
    /// Call after the scene's environment map was replaced.
    void takeEnvironment() { moved_.environment = scene_.environment; }

private:
    /// Copies everything that is neither displaced nor large.
    void takeOthers();

    const scenes::Scene& scene_;
    scenes::Scene moved_;
    std::vector<std::size_t> meshes_; ///< that the hook moves
};

} // namespace tessera::engine
