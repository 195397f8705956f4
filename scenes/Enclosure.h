#pragma once
#include <optional>

#include "scenes/Framing.h"

namespace tessera::scenes {

/// An eye within a scene that one is meant to stand in, such as a room, a hall or a courtyard: of a person's height
/// above the floor, near one end of the longest way across, and looking along it. None for things that are seen from
/// outside, whose middles see the backs of their surfaces or nothing, and for what is smaller than a room. Nearly all
/// rays from the middle of a room's bounds meet fronts of surfaces, downwards and to all sides; a roof may lack. It
/// looks at the scene as it is posed.
std::optional<Framing> framingInside(const Scene& scene);

} // namespace tessera::scenes
