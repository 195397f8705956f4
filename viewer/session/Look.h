#pragma once
#include <functional>
#include <map>
#include <string>

#include "engine/Settings.h"
#include "scenes/Environment.h"

namespace tessera::viewer {

/// Settings of a view of a scene: the technique and all frame options of a command line.
struct Look : engine::ViewRequest {
    /// Requested values that the technique does not support, kept for one that does: texts, by setting key.
    std::map<std::string, std::string, std::less<>> aside;
    bool operator==(const Look&) const = default;
};

/// Adapts a look to its technique: unsupported settings are put aside and reset, those put aside are restored if
/// supported, and an unsupported view becomes the lit image. A look that is possible stays unchanged.
Look possible(Look look);

/// The look as requested, with values that its technique does not support.
Look requested(Look look);

/// How a look rotates and scales the scene's environment, which is an edit of the scene: OpenScene::environmentView().
scenes::EnvironmentView environmentSeenBy(const Look& look);
void setEnvironmentSeenBy(Look& look, const scenes::EnvironmentView& view);

/// Applies the changes between `before` and `now` to `base`: user choices take precedence over the options that a scene
/// requests.
Look rebased(const Look& now, const Look& before, const Look& base);

} // namespace tessera::viewer
