#pragma once
#include "passes/recipes/Techniques.h"
#include "renderer/frame/FrameSettings.h"

namespace tessera::viewer {

/// How a scene is looked at: the technique and all that a command line can ask of a frame.
struct Look {
    recipes::Technique technique = recipes::Technique::Deferred;
    frame::FrameSettings settings;
    bool operator==(const Look&) const = default;
};

/// The look without what its technique cannot do: options that it does not take are left open, a view that it cannot
/// show becomes the lit picture. A look that is possible stays as it is.
Look possible(Look look);

/// What was changed between `before` and `now`, made to `base`: choices of the user outlive a scene that wishes
/// otherwise.
Look rebased(const Look& now, const Look& before, const Look& base);

} // namespace tessera::viewer
