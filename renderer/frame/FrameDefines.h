#pragma once
#include "renderer/frame/FrameSpec.h"

namespace tessera::frame {

/// Defines for the number and positions of a pixel's samples.
Defines sampleDefines(const FrameSpec& spec);

/// Defines of every geometry and lighting shader of the frame.
Defines frameDefines(const FrameSpec& spec);

} // namespace tessera::frame
