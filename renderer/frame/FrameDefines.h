#pragma once
#include "renderer/frame/FrameSpec.h"

namespace tessera::frame {

/// How many samples a pixel has, and where.
Defines sampleDefines(const FrameSpec& spec);

/// What every geometry and lighting shader of the frame is compiled with.
Defines frameDefines(const FrameSpec& spec);

} // namespace tessera::frame
