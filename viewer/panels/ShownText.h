#pragma once
#include <functional>
#include <string_view>

#include "viewer/session/State.h"

namespace tessera::viewer {

using TextVisitor = std::function<void(std::string_view)>;

/// Call a visitor with texts that come from files and folders and that the interface may show: the names in the scene's
/// file, or all other texts that are currently displayed.
void visitSceneText(const OpenScene& open, const TextVisitor& visit);
void visitShownText(const State& state, const TextVisitor& visit);

} // namespace tessera::viewer
