#pragma once
#include "engine/Techniques.h"
#include "renderer/frame/FrameSpec.h"

/// Which technique can show which view.
namespace tessera::engine {

bool takesView(const TechniqueInfo& info, frame::DebugView view);

/// Whether the frame stores the channel that the view shows, if it shows one.
bool storesShown(const frame::FrameSpec& spec);

/// Throws InputError naming the channels that there are where the view shows one that the frame does not store.
void requireStoredChannel(const frame::FrameSpec& spec);

} // namespace tessera::engine
