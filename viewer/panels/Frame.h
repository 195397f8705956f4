#pragma once
#include <string>

#include "viewer/panels/Panels.h"
#include "viewer/session/Controls.h"

namespace tessera::viewer {

/// Where the picture is in a window of this size, screen coordinates; of no size where there is no room.
PictureArea pictureArea(const State& state, glm::vec2 windowSize, float scale);

/// The window that leaves a picture of this size beside panels of a width, 0 where they are hidden.
glm::ivec2 windowSizeFor(glm::ivec2 pictureSize, float panelWidth);

/// How long a picture took, as the line below it says: "54 ms", and from 10 s on "176 s".
std::string pictureTimeText(double ms);

/// All panels around the picture, the line below it, and its overlays.
void drawInterface(State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
