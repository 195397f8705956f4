#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "python/Worker.h"

namespace tessera::python {

/// A scene in memory, and all that was derived from it. On the worker's thread.
struct LoadedScene {
    std::string asLoaded; ///< what of the options its load depended on
    app::Request request;
    std::unique_ptr<engine::Renderer> renderer; ///< of the request's scene; null until one is asked for
    bool hasFiltered = false;                   ///< the environment
    std::optional<double> posedAtSeconds;       ///< where a clip plays; none: anywhere

    engine::Renderer& rendererOn(gpu::Context& context);
    /// Shows a scene whose clip plays at the time of the request.
    void pose(const std::string& file);
};

/// A scene that is loaded once and drawn often: what a caller of Python holds. The memory is the worker's, which drops
/// it too.
class SceneObject {
public:
    explicit SceneObject(app::FrameOptions options);
    ~SceneObject();
    SceneObject(const SceneObject&) = delete;
    SceneObject& operator=(const SceneObject&) = delete;

    /// As they were said of the scene.
    const app::FrameOptions& options() const { return options_; }

    /// The request that options ask for, of this scene: it is loaded anew where they ask for another load. On the
    /// worker's thread. Throws InputError, and Stopped.
    LoadedScene& resolved(const app::FrameOptions& options, const Job& job);
    /// Drops what is loaded: after work that was given up half done.
    void drop();

private:
    struct Slot;
    app::FrameOptions options_;
    Slot* slot_;
};

/// What a loaded scene consists of, for people who look at it.
struct SceneFacts {
    std::string name;
    std::size_t triangles = 0, lights = 0, materials = 0;
    std::vector<std::string> cameras, notes, files;
};
SceneFacts factsOf(const app::Request& request);

} // namespace tessera::python
