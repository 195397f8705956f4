#pragma once
#include "passes/recipes/Techniques.h"
#include "renderer/frame/FrameSettings.h"

namespace tessera::viewer {

inline constexpr float kMostExposureEV = 120.0f; ///< either way: what --exposure takes

/// What was asked for and the technique cannot do, until another one can.
struct PutAside {
    std::optional<culling::Method> method;
    std::optional<int> tilePixels;
    std::optional<culling::Builder> builder;
    std::optional<frame::LightingStage> lightOn;
    std::optional<int> samples;
    bool operator==(const PutAside&) const = default;
};

/// How a scene is looked at: the technique and all that a command line can ask of a frame.
struct Look {
    recipes::Technique technique = recipes::Technique::Deferred;
    frame::FrameSettings settings;
    PutAside aside;
    bool operator==(const Look&) const = default;
};

/// The look as its technique can do it: options that it does not take are put aside and left open, those put aside
/// that it takes come back, and a view that it cannot show becomes the lit picture. A look that is possible stays as
/// it is.
Look possible(Look look);

/// The look with nothing put aside: what was asked for, whether its technique can do it or not.
Look asked(Look look);

/// What was changed between `before` and `now`, made to `base`: choices of the user outlive a scene that wishes
/// otherwise.
Look rebased(const Look& now, const Look& before, const Look& base);

} // namespace tessera::viewer
