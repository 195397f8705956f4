#pragma once
#include <array>
#include <string>
#include <vector>

#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

/// The look that is drawn for the user's settings, and names for it.
namespace tessera::viewer {

/// Whether the view shows a lighting term of a single light: D, G or F.
bool showsTermOfOne(frame::DebugView view);

/// Whether the image shows counts in heat colours.
bool showsCounts(const Look& look);

/// End of the heat-colour scale of a side's image of this view, as a power of two: the largest count if it is known and
/// State::fitsCountColors, as in the files of `tessera render`, else the fixed end of that view.
float countColorsLog2(const State& state, const Facts& facts, int side, frame::DebugView view);

/// The look of a side as it is drawn: views of D, G and F show the selected light, else the brightest at the focus of
/// the scene's camera, unless a light is solo.
Look drawnLook(const State& state, int side);

/// Name of a look's view for the large title: "geometry of lamp 3".
std::string viewName(const Look& look, const std::vector<scenes::Light>* lights = nullptr);

/// Meaning of the view's colours, in one line. `isLit`: some light is on, whose terms D, G or F can be shown.
std::string viewMeaning(frame::DebugView view, bool isLit = true);

/// "forward / final"; with the lights given, "forward / geometry of lamp 3".
std::string lookName(const Look& look, const std::vector<scenes::Light>* lights = nullptr);

/// Names of the two sides of a comparison: the technique, the view if it differs or nothing else does, and the other
/// settings that differ.
std::array<std::string, 2> sideNames(const Look& left, const Look& right,
                                     const std::vector<scenes::Light>* lights = nullptr);

} // namespace tessera::viewer
