#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

/// Lines and text over the image. They describe the displayed image, which may not have the chosen settings yet.
namespace tessera::viewer {

/// Draws the divider of a split comparison, with its handle.
void drawDivider(const State& state, const PictureArea& area, float scale);

/// Labels the image in its upper corners: the sides of a comparison, and the name of a view other than the lit image,
/// large, with its meaning. For a difference, the compared images, and a note if they are equal, because the difference
/// is then black.
void drawNames(const State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
