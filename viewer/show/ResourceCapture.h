#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "renderer/gpu/Texture.h"
#include "viewer/session/Facts.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Reads the resource of the render graph that the window displays, when the image is idle, by an extra frame. An image
/// of the scene needs no reading.
class ResourceCapture {
public:
    /// Updates Facts::resource for the active side. Returns whether it changed. `givesUp` aborts the frame for pending
    /// input; the next idle time retries. Throws as Renderer::draw does, and then does not retry.
    bool update(Facts& facts, const State& state, Screen& screen, const Screen::Wanted& wanted, bool isAtRest,
                const std::function<bool()>& givesUp);
    /// A resource is still to be read, when everything is idle.
    bool awaitsRest() const { return awaitsRest_; }
    /// Shaders have changed: it is to be read again.
    void forget() { read_.reset(); }

private:
    /// The inputs of the contents.
    struct Source {
        std::string name;
        int level = 0, layer = 0, side = 0;
        Screen::Wanted wanted;
        bool operator==(const Source&) const = default;
    };
    /// Display settings of the contents.
    struct Shown {
        ResourceView::Channels channels;
        bool fitsRange;
        float least, most;
        bool isCurved;
        bool operator==(const Shown&) const = default;
    };
    /// Returns false if aborted.
    bool read(Screen& screen, const Source& source, const std::function<bool()>& givesUp);
    void show(Facts& facts, const ResourceView& view);

    std::optional<Source> read_; ///< or failed
    std::optional<Shown> shown_; ///< settings of the displayed contents
    std::shared_ptr<const ResourceContents> contents_;
    std::unique_ptr<gpu::Texture> picture_;
    std::unique_ptr<gpu::Texture> retired_; ///< still used by the interface of this frame, which is already laid out
    bool awaitsRest_ = false;
};

} // namespace tessera::viewer
