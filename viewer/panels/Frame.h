#pragma once
#include <string>

#include "viewer/panels/Panels.h"
#include "viewer/session/Controls.h"

namespace tessera::viewer {

/// The viewport in a window of this size, in screen coordinates; of size 0 if there is no room.
PictureArea pictureArea(const State& state, glm::vec2 windowSize, float scale);

/// The window size that leaves an image of this size beside panels of a width, 0 if hidden.
glm::ivec2 windowSizeFor(glm::ivec2 pictureSize, float panelWidth);

/// Drawing time of an image for the status line: "54 ms", and from 10 s on "176 s".
std::string pictureTimeText(double ms);

/// Draws all panels, the status line and the overlays.
void drawInterface(State& state, const Facts& facts, const PictureArea& area, float scale);

/// Whether a dialog still darkens the window, which takes a few frames.
bool isDimming();

} // namespace tessera::viewer
