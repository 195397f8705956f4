#pragma once
#include <optional>

#include "scenes/Framing.h"

namespace tessera::scenes {

/// Places an eye inside a scene that is meant to be entered, such as a room, a hall or a courtyard: at a person's
/// height above the floor, near one end of the longest line across, looking along it. Such a scene has front faces on
/// nearly all rays from the middle of its bounds, downwards and to all sides; a roof may be missing. None for objects
/// viewed from outside, whose middle sees back faces or nothing, and for scenes smaller than a room. Uses the scene's
/// current pose.
std::optional<Framing> framingInside(const Scene& scene);

} // namespace tessera::scenes
