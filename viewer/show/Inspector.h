#pragma once
#include <optional>
#include <vector>

#include "renderer/gpu/TexelReader.h"
#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Reads what the pictures in the window show at the pixel that the user points at. Values come a frame or two later,
/// without waiting for the GPU; the surface there is looked for once the picture is whole.
class Inspector {
public:
    /// Brings Facts::inspection up to date with the pictures, of which `picture` counts those that were drawn. Whether
    /// it changed. Throws std::runtime_error where the surface cannot be looked for, and then does not try again.
    bool update(Facts& facts, const State& state, const Screen& screen, std::uint64_t picture, bool isAtRest);
    /// Another frame is to ask for values that are on their way.
    bool isBusy() const { return isAsked_; }
    /// Something is to be looked for once all rests.
    bool awaitsRest() const { return awaitsRest_; }

private:
    struct Subject {
        glm::ivec2 pixel{0}, sizePixels{0};
        std::uint64_t picture = 0;
        std::vector<frame::DebugView> views; ///< by side
        bool operator==(const Subject&) const = default;
    };
    void ask(const Subject& subject, const Screen& screen);
    bool take(Facts& facts);
    void findSurface(Inspection& inspection, const State& state, const Screen& screen) const;

    std::optional<gpu::TexelReader> reader_; ///< made when it is needed first
    std::optional<Subject> subject_;         ///< was asked for last
    bool isAsked_ = false, awaitsRest_ = false;
};

} // namespace tessera::viewer
