#pragma once
#include "renderer/frame/FrameSpec.h"

namespace tessera::frame {

/// What every geometry and lighting shader of the frame is compiled with.
Defines frameDefines(const FrameSpec& spec);

} // namespace tessera::frame
