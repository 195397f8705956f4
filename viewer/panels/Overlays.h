#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

/// Lines and words over the picture. What they name is the picture that is shown, which may not be the one that is
/// chosen yet.
namespace tessera::viewer {

/// The line between two pictures side by side, with its handle.
void drawDivider(const State& state, const PictureArea& area, float scale);

/// What the picture shows, in its upper corners: which side is which, and the name of a view other than the lit
/// picture, large, with its meaning; of a difference which pictures differ, and where they do not that there is none,
/// for its picture is black.
void drawNames(const State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
