#pragma once
#include <optional>
#include <vector>

#include "renderer/gpu/TexelReader.h"
#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Reads the values of the pixel under the pointer. They arrive a frame or two later, without waiting for the GPU; the
/// surface there is found when the image has full resolution.
class Inspector {
public:
    /// Updates Facts::inspection for the displayed images; `picture` counts the drawn ones. Returns whether it changed.
    /// Throws std::runtime_error if finding the surface fails, and then does not retry.
    bool update(Facts& facts, const State& state, const Screen& screen, std::uint64_t picture, bool isAtRest);
    /// Another frame is needed to fetch requested values.
    bool isBusy() const { return isRequested_; }
    /// The surface is still to be found, when everything is idle.
    bool awaitsRest() const { return awaitsRest_; }

private:
    struct Subject {
        glm::ivec2 pixel{0}, sizePixels{0};
        std::uint64_t picture = 0;
        std::vector<frame::DebugView> views; ///< by side
        bool operator==(const Subject&) const = default;
    };
    void request(const Subject& subject, const Screen& screen);
    bool take(Facts& facts);
    void findSurface(Inspection& inspection, const State& state, const Screen& screen) const;

    std::optional<gpu::TexelReader> reader_; ///< created on first use
    std::optional<Subject> subject_;         ///< of the latest request
    bool isRequested_ = false, awaitsRest_ = false;
};

} // namespace tessera::viewer
