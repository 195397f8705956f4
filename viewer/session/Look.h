#pragma once
#include <functional>
#include <map>
#include <string>

#include "engine/Settings.h"
#include "scenes/Environment.h"

namespace tessera::viewer {

/// How a scene is looked at: the technique and all that a command line can ask of a frame.
struct Look : engine::ViewRequest {
    /// Requested values that the technique does not take, kept for another one that does: texts, by the settings' keys.
    std::map<std::string, std::string, std::less<>> aside;
    bool operator==(const Look&) const = default;
};

/// The look as its technique can do it: settings that it does not take are put aside and get their defaults, those put
/// aside that it takes come back, and a view that it cannot show becomes the lit picture. A look that is possible stays
/// as it is.
Look possible(Look look);

/// The look as requested, with values that its technique does not take.
Look asked(Look look);

/// How a look turns and brightens the scene's environment, which is an edit of the scene: OpenScene::environmentView().
scenes::EnvironmentView environmentSeenBy(const Look& look);
void setEnvironmentSeenBy(Look& look, const scenes::EnvironmentView& view);

/// What was changed between `before` and `now`, made to `base`: choices of the user outlive a scene that wishes
/// otherwise.
Look rebased(const Look& now, const Look& before, const Look& base);

} // namespace tessera::viewer
