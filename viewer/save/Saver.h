#pragma once
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Writes the window's contents to files of the current folder (freePath). Throws exceptions of drawing and writing.
class Saver {
public:
    Saver(State& state, Screen& screen, const EventLog& log) : state_(state), screen_(screen), log_(log) {}

    /// The active side's picture at full resolution, as `tessera render` writes it.
    void picture(glm::ivec2 sizePixels, const char* ending);
    /// The scene with its edits and current camera. From then on that file is the open scene, and the first of the
    /// recent ones.
    void scene();
    /// The command line that renders the active side's picture. A scene that was edited is saved first.
    std::string command(glm::ivec2 sizePixels);
    /// The latest frames' timings, for chrome://tracing or Perfetto.
    void trace();

private:
    void tell(const std::string& path);
    std::string stem() const;

    State& state_;
    Screen& screen_;
    const EventLog& log_;
};

} // namespace tessera::viewer
