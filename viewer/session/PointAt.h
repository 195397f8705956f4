#pragma once
#include <string>

#include "viewer/session/State.h"

/// Picking and framing in an open scene, by image position or by selection. Positions are fractions of the image size
/// from the upper left.
namespace tessera::viewer {

/// Selects the material of the surface at a position. Returns its name, or "nothing".
std::string selectMaterialAt(State& state, const glm::vec2& place, glm::ivec2 sizePixels);

/// Pans the orbit so that it turns about the surface at a position. Returns whether there is one.
bool turnAboutPlace(State& state, const glm::vec2& place, glm::ivec2 sizePixels);

/// Brings the last selection into view: a light, or everything that has a material; without a selection, and for lights
/// without a position, the whole scene.
void frameSelection(State& state);

} // namespace tessera::viewer
