#pragma once
#include <cstdint>
#include <vector>

#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Scene.h"

namespace tessera::engine {

/// What is done about vertices that are moved nowhere, or farther than the hook may move them.
enum class Excess : std::uint8_t {
    Refuse,
    /// A vertex that goes nowhere, to NaN or beyond 1000 km, stays in place. Opacities of vertex colours are
    /// HOOK_MARK_TOO_FAR or HOOK_MARK_NOWHERE (shaders/shared/hook.h).
    Mark
};

/// A scene whose hook moves vertices, with the vertices as they are at a time. The hook runs in a compute shader, and
/// what it makes is read back: all passes, bounds, trees of casters and the reference take the same vertices.
class HookedScene {
public:
    /// The scene must outlive the object. Nothing is moved yet.
    explicit HookedScene(const scenes::Scene& scene);

    /// The scene with moved vertices; its hook no longer says that it moves any once update() has.
    const scenes::Scene& scene() const { return moved_; }

    struct Changed {
        bool vertices = false; ///< a position or a normal
        bool colors = false;   ///< of vertices: others are marked
    };
    /// Takes the scene's lights, cameras, materials and nodes as they are, and its vertices as the hook has them at
    /// that time. Throws InputError where the hook is faulty, and where a vertex is nowhere or farther from its place
    /// than the hook may move it, unless those are marked; then all is as it was.
    Changed update(double timeSeconds, Excess excess, shader::ProgramLibrary& programs);
    /// To be called after vertices of the scene itself were changed.
    void takeMeshes();
    /// To be called after the scene got another map of its environment.
    void takeEnvironment() { moved_.environment = scene_.environment; }

private:
    /// All of the scene that is neither moved nor large.
    void takeOthers();

    const scenes::Scene& scene_;
    scenes::Scene moved_;
    std::vector<std::size_t> meshes_; ///< that the hook moves
};

} // namespace tessera::engine
