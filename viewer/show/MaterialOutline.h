#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Finds the outline of the selected material in the idle image, by an extra frame of the ids view.
class MaterialOutline {
public:
    /// The inputs of the outline, except the alpha masks of materials and the hook's source.
    struct Sight {
        const OpenScene* open = nullptr;
        int material = scenes::kNone;
        glm::ivec2 sizePixels{0};
        scenes::Camera camera;
        std::uint64_t geometryRevision = 0;
        // Inputs of a hook, which may move vertices by them.
        double timeSeconds = 0.0;
        std::vector<scenes::HookParameter> hookParameters = {};
        bool operator==(const Sight&) const = default;
    };
    /// None if no panel shows the material, or the look's view shows no surfaces.
    static std::optional<Sight> sightOf(const State& state, const Look& look);

    /// Updates Facts::materialOutline for the image of a look. Returns whether it changed. `givesUp` aborts the frame
    /// for pending input; the next idle time retries. Throws as Renderer::draw does, and then does not retry.
    bool update(Facts& facts, const State& state, Screen& screen, const Look& look, bool isAtRest,
                const std::function<bool()>& givesUp);
    /// The outline is still to be found, when everything is idle.
    bool awaitsRest() const { return awaitsRest_; }
    /// Shaders have changed, possibly the hook's: the outline is to be found again.
    void forget() { found_.reset(); }

private:
    void find(Facts& facts, Screen& screen, Look look, const Sight& sight, const std::function<bool()>& givesUp);

    std::optional<Sight> found_; ///< or failed
    std::uint64_t materialRevision_ = 0;
    bool awaitsRest_ = false;
};

} // namespace tessera::viewer
