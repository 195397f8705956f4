#pragma once
#include <string>

#include "apps/Options.h"

namespace tessera::app {

/// The options that were given, as they would be typed: " --size 640x360 --time 2". Empty where none was.
std::string frameOptionText(const FrameOptions& options);

/// A word as a shell takes it: quoted where it must be.
std::string shellWord(const std::string& word);

} // namespace tessera::app
