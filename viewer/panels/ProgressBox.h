#pragma once
#include <optional>
#include <string>

#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

struct ImDrawList;

namespace tessera::viewer {

/// Draws a box in a corner of the image with the long operation, its progress, and a hint that Esc cancels it; clear of
/// the image centre and of another box. It covers its previous contents.
void drawProgress(const Progress& progress, const PictureArea& area, const std::optional<Box>& other, float scale,
                  ImDrawList& list);

/// "Filtering sky: 45 %", or "Loading sky ..." if the fraction is unknown, shortened to one line of a width; the name
/// is shortened independently of the fraction.
std::string progressText(const Progress& progress, float widthPixels);

/// "diffusing light: 1 of 3 objects, 45 %"
std::string diffusionText(const engine::DiffusionProgress& progress);

} // namespace tessera::viewer
