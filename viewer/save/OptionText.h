#pragma once
#include <string>

#include "scenes/CameraChange.h"

/// Pieces of a command line as text to paste into a shell.
namespace tessera::viewer {

/// A word as a shell takes it: quoted where it must be.
std::string shellWord(const std::string& word);

/// The number with the fewest digits that the program reads as the same one, to the last bit.
std::string numberText(double value);
std::string numberText(float value);

/// A camera's change as options: " --eye 1,2,3 --target 0,1,0". Empty where nothing is changed.
std::string poseText(const scenes::CameraChange& change);

} // namespace tessera::viewer
