#pragma once
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Writes the window's contents to files. Throws exceptions of drawing and writing.
class Saver {
public:
    Saver(State& state, Screen& screen, const EventLog& log) : state_(state), screen_(screen), log_(log) {}

    /// A free name in the current folder (freePath), based on the open scene's.
    std::string freeName(const char* ending) const;
    /// Saves the image at full resolution, as `tessera render` does. The extension selects the display colours, with
    /// both sides of a comparison beside each other, or the radiance of the active side.
    void picture(glm::ivec2 sizePixels, const std::string& path);
    /// saveOpenScene().
    void scene(const std::string& path);
    /// The command line that renders the active side's image. Requires a scene without unsaved edits.
    std::string command(glm::ivec2 sizePixels);
    /// Saves the timings of the latest frames for chrome://tracing or Perfetto, under a free name.
    void trace();

private:
    engine::RenderedFrame rendered(Look& look, glm::ivec2 sizePixels, bool display);
    void report(const std::string& path);

    State& state_;
    Screen& screen_;
    const EventLog& log_;
};

} // namespace tessera::viewer
