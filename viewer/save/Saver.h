#pragma once
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"
#include "viewer/show/Screen.h"

namespace tessera::viewer {

/// Writes what the window shows to files of the present folder (freePath). Throws what drawing and writing throw.
class Saver {
public:
    Saver(State& state, Screen& screen, const EventLog& log) : state_(state), screen_(screen), log_(log) {}

    /// The active side's picture, drawn whole: what `tessera render` writes.
    void picture(glm::ivec2 sizePixels, const char* ending);
    /// The scene with its edits and the camera where it is. From then on that file is what is open, and
    /// the first of the recent ones.
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
