#pragma once
#include <string>

#include "viewer/session/State.h"

/// What the user points at in the picture, or has selected, of a scene that is open. Places are shares of the picture's
/// size from its upper left.
namespace tessera::viewer {

/// Selects the material of the surface at a place; its name, or "nothing".
std::string selectMaterialAt(State& state, const glm::vec2& place, glm::ivec2 sizePixels);

/// Slides the orbit so that it turns about the surface at a place. Whether there is one.
bool turnAboutPlace(State& state, const glm::vec2& place, glm::ivec2 sizePixels);

/// Brings what was selected last into view, a light or all that has a material; without a selection, and for lights
/// without a place, all of the scene.
void frameSelection(State& state);

} // namespace tessera::viewer
