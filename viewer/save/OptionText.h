#pragma once
#include <span>
#include <string>

#include "scenes/CameraChange.h"
#include "scenes/Hook.h"
#include "scenes/ImportWishes.h"

/// Pieces of a command line as text to paste into a shell.
namespace tessera::viewer {

/// A word as a shell takes it: quoted where it must be.
std::string shellWord(const std::string& word);

/// A camera's change as options: " --eye 1,2,3 --target 0,1,0". Empty where nothing is changed.
std::string poseText(const scenes::CameraChange& change);
/// " --background R,G,B", or nothing.
std::string backgroundText(const std::optional<glm::dvec3>& radiance);

/// Values of a hook's parameters as options: " --hook wind=1.5". Empty where there is none.
std::string hookText(std::span<const scenes::HookValue> values);
/// How models are read as options: " --variant 'deep red' --strict". Empty where nothing is asked for.
std::string importText(const scenes::ImportWishes& wishes);

} // namespace tessera::viewer
