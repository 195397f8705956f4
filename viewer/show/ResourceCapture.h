#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "renderer/gpu/Texture.h"
#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Reads the resource of the render graph that the window is to show, once the picture rests: by a frame that is drawn
/// for that alone.
class ResourceCapture {
public:
    /// Brings Facts::resource up to date with the active side of the pictures. Whether it changed. `givesUp` ends the
    /// frame where input waits; then the next rest tries again. Throws as Renderer::draw does, and then does not try
    /// again.
    bool update(Facts& facts, const State& state, Screen& screen, const Screen::Wanted& wanted, bool isAtRest,
                const std::function<bool()>& givesUp);
    /// Something is to be read once all rests.
    bool awaitsRest() const { return awaitsRest_; }
    /// Shaders have changed: it is to be read anew.
    void forget() { read_.reset(); }

private:
    /// What the contents follow from.
    struct Source {
        std::string name;
        int level = 0, layer = 0, side = 0;
        Screen::Wanted wanted;
        bool operator==(const Source&) const = default;
    };
    /// How they are shown.
    struct Shown {
        ResourceView::Channels channels;
        bool fitsRange;
        float least, most;
        bool isCurved;
        bool operator==(const Shown&) const = default;
    };
    /// Whether it was not given up.
    bool read(Screen& screen, const Source& source, const std::function<bool()>& givesUp);
    void show(Facts& facts, const ResourceView& view);

    std::optional<Source> read_; ///< or failed
    std::optional<Shown> shown_; ///< of what was read
    std::shared_ptr<ResourceContents> contents_;
    std::unique_ptr<gpu::Texture> picture_;
    std::unique_ptr<gpu::Texture> retired_; ///< that the interface of this frame, laid out already, still shows
    bool awaitsRest_ = false;
};

} // namespace tessera::viewer
