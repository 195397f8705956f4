#pragma once
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Writes the window's contents to files. Throws exceptions of drawing and writing.
class Saver {
public:
    Saver(State& state, Screen& screen, const EventLog& log) : state_(state), screen_(screen), log_(log) {}

    /// A name of the current folder that is free (freePath), after the open scene.
    std::string freeName(const char* ending) const;
    /// The picture at full resolution, as `tessera render` writes it; by the name's end as a display shows it, of a
    /// comparison both sides beside each other, or the active side's radiance.
    void picture(glm::ivec2 sizePixels, const std::string& path);
    /// saveOpenScene().
    void scene(const std::string& path);
    /// The command line that renders the active side's picture, of a scene without edits that are not saved.
    std::string command(glm::ivec2 sizePixels);
    /// The latest frames' timings, for chrome://tracing or Perfetto, under a free name.
    void trace();

private:
    engine::RenderedFrame rendered(Look& look, glm::ivec2 sizePixels, bool display);
    void tell(const std::string& path);

    State& state_;
    Screen& screen_;
    const EventLog& log_;
};

} // namespace tessera::viewer
