#pragma once
#include <string>

#include "apps/Request.h"
#include "viewer/save/OptionText.h"

namespace tessera::app {

/// The given options as command-line text: " --size 640x360 --time 2". Empty if there are none.
std::string frameOptionText(const FrameOptions& options);

using viewer::shellWord;

} // namespace tessera::app
