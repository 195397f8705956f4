#pragma once
#include "engine/Techniques.h"
#include "renderer/frame/FrameSpec.h"

/// Support of debug views by techniques.
namespace tessera::engine {

bool supportsView(const TechniqueInfo& info, frame::DebugView view);

/// Whether the frame stores the channel that the view shows; true for views that show none.
bool storesShown(const frame::FrameSpec& spec);

/// Throws InputError naming the stored channels if the view shows one that the frame does not store.
void requireStoredChannel(const frame::FrameSpec& spec);

} // namespace tessera::engine
