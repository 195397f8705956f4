#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Finds where the picture shows the selected material, once it rests: by a frame of the view ids, which is drawn for
/// that alone.
class MaterialOutline {
public:
    /// Brings Facts::materialOutline up to date with the picture of a look. Whether it changed. `givesUp` ends the
    /// frame where input waits; then the next rest tries again. Throws as Renderer::draw does, and then does not try
    /// again.
    bool update(Facts& facts, const State& state, Screen& screen, const Look& look, bool isAtRest,
                const std::function<bool()>& givesUp);
    /// Something is to be found once all rests.
    bool awaitsRest() const { return awaitsRest_; }

private:
    /// What the outline follows from, but how materials cut holes.
    struct Sight {
        const OpenScene* open = nullptr;
        int material = scenes::kNone;
        glm::ivec2 sizePixels{0};
        scenes::Camera camera;
        std::uint64_t geometryRevision = 0;
        double timeSeconds = 0.0; ///< where a hook moves vertices
        bool operator==(const Sight&) const = default;
    };
    /// None where no panel shows the material, or there is no picture.
    static std::optional<Sight> sightOf(const State& state, const Screen& screen, const Look& look);
    void find(Facts& facts, Screen& screen, Look look, const Sight& sight, const std::function<bool()>& givesUp);

    std::optional<Sight> found_; ///< or failed
    std::uint64_t materialRevision_ = 0;
    bool awaitsRest_ = false;
};

} // namespace tessera::viewer
