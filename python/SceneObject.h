#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "python/Worker.h"

namespace tessera::python {

/// A loaded scene and all data derived from it. On the worker's thread.
struct LoadedScene {
    std::string asLoaded; ///< the options that the load depended on
    app::Request request;
    std::unique_ptr<engine::Renderer> renderer; ///< for request.scene; null until first used
    bool hasFiltered = false;                   ///< whether the environment is filtered
    std::optional<double> posedAtSeconds;       ///< time of the current pose of an active clip; none: undefined

    engine::Renderer& rendererOn(gpu::Context& context);
    /// Poses a scene with an active clip at the time of the request. Errors name `file`.
    void pose(const std::string& file);
};

/// A scene that is loaded once and drawn often, as held by a Python caller. The worker owns its memory and frees it
/// too.
class SceneObject {
public:
    explicit SceneObject(app::FrameOptions options);
    ~SceneObject();
    SceneObject(const SceneObject&) = delete;
    SceneObject& operator=(const SceneObject&) = delete;

    /// The options given for the scene.
    const app::FrameOptions& options() const { return options_; }

    /// Resolves options for this scene, and loads it again if they affect the load. On the worker's thread. Throws
    /// InputError and Stopped.
    LoadedScene& resolved(const app::FrameOptions& options, const Job& job);
    /// Unloads the scene, after work that failed half way.
    void drop();

private:
    struct Slot;
    app::FrameOptions options_;
    Slot* slot_;
};

/// Summary of a loaded scene for people.
struct SceneFacts {
    std::string name;
    std::size_t triangles = 0, lights = 0, materials = 0;
    std::vector<std::string> cameras, notes, files;
};
SceneFacts factsOf(const app::Request& request);

} // namespace tessera::python
