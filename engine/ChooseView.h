#pragma once
#include "engine/Techniques.h"
#include "renderer/frame/FrameSpec.h"

/// Which technique can show which view.
namespace tessera::engine {

bool takesView(const TechniqueInfo& info, frame::DebugView view);

/// Throws InputError naming the channels that there are where the view shows one that the frame does not store.
void requireStoredChannel(const frame::FrameSpec& spec);

} // namespace tessera::engine
