#pragma once
#include <optional>
#include <string>

#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

struct ImDrawList;

namespace tessera::viewer {

/// A box in a corner of the picture that says what takes long, how far it is, and that Esc cancels it: beside the
/// picture's middle, and clear of another box. It covers what it drew before.
void drawProgress(const Progress& progress, const PictureArea& area, const std::optional<Box>& other, float scale,
                  ImDrawList& list);

/// "Filtering sky: 45 %", or "Loading sky ..." where nobody knows the share, on one line of a width (shortened()); what
/// is left of a name does not depend on the share.
std::string progressText(const Progress& progress, float widthPixels);

/// "spreading light: 1 of 3 objects, 45 %"
std::string spreadText(const engine::SpreadProgress& progress);

} // namespace tessera::viewer
