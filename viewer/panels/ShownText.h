#pragma once
#include <functional>
#include <string_view>

#include "viewer/session/State.h"

namespace tessera::viewer {

using TextVisitor = std::function<void(std::string_view)>;

/// Calls a visitor with the texts that come from files and folders and that the interface may show: of the scene what
/// its file has given names, of the rest what is shown now.
void visitSceneText(const OpenScene& open, const TextVisitor& visit);
void visitShownText(const State& state, const TextVisitor& visit);

} // namespace tessera::viewer
