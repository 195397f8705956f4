#pragma once
#include <string>

#include "apps/Request.h"
#include "viewer/save/OptionText.h"

namespace tessera::app {

/// The options that were given, as they would be typed: " --size 640x360 --time 2". Empty where none was.
std::string frameOptionText(const FrameOptions& options);

using viewer::shellWord;

} // namespace tessera::app
