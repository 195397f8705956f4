#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Finds where the picture shows the selected material, once it rests: by a frame of the view ids, which is drawn for
/// that alone.
class MaterialOutline {
public:
    /// What the outline follows from, but how materials cut holes, and the text of a hook.
    struct Sight {
        const OpenScene* open = nullptr;
        int material = scenes::kNone;
        glm::ivec2 sizePixels{0};
        scenes::Camera camera;
        std::uint64_t geometryRevision = 0;
        // Of a hook, which may move vertices by them.
        double timeSeconds = 0.0;
        std::vector<scenes::HookParameter> hookParameters = {};
        bool operator==(const Sight&) const = default;
    };
    /// None where no panel shows the material, or the look's picture is none of its surfaces.
    static std::optional<Sight> sightOf(const State& state, const Look& look);

    /// Brings Facts::materialOutline up to date with the picture of a look. Whether it changed. `givesUp` ends the
    /// frame where input waits; then the next rest tries again. Throws as Renderer::draw does, and then does not try
    /// again.
    bool update(Facts& facts, const State& state, Screen& screen, const Look& look, bool isAtRest,
                const std::function<bool()>& givesUp);
    /// Something is to be found once all rests.
    bool awaitsRest() const { return awaitsRest_; }
    /// Shaders have changed, the hook's among them: the outline is to be found anew.
    void forget() { found_.reset(); }

private:
    void find(Facts& facts, Screen& screen, Look look, const Sight& sight, const std::function<bool()>& givesUp);

    std::optional<Sight> found_; ///< or failed
    std::uint64_t materialRevision_ = 0;
    bool awaitsRest_ = false;
};

} // namespace tessera::viewer
