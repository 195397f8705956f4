#pragma once
#include <array>
#include <string>
#include <vector>

#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

/// What is drawn of what the user chose, and how it is called.
namespace tessera::viewer {

/// The view shows a term of the lighting of one light: D, G or F.
bool showsTermOfOne(frame::DebugView view);

/// The picture shows how many there are of something, in heat colours.
bool showsCounts(const Look& look);

/// Where the heat colours of a side's picture that shows this view end, as a power of two: at the largest count where
/// it is known and they are to fit it, as in the files of `tessera render`, else where that view always can.
float countColorsLog2(const State& state, const Facts& facts, int side, frame::DebugView view);

/// The look of a side as it is drawn: views of D, G and F show the selected light, else the brightest at what the
/// scene's camera looks at, unless one shines alone.
Look drawnLook(const State& state, int side);

/// The view of a look, large in the picture: "geometry of lamp 3".
std::string viewName(const Look& look, const std::vector<scenes::Light>* lights = nullptr);

/// Meaning of the view's colours, in a line; `isLit` where a light is on, whose terms some views show.
std::string viewMeaning(frame::DebugView view, bool isLit = true);

/// "forward / final"; "forward / geometry of lamp 3", where the lights are given.
std::string lookName(const Look& look, const std::vector<scenes::Light>* lights = nullptr);

/// Names of two pictures side by side: the technique, the view where it differs or nothing else does, and the other
/// settings that differ.
std::array<std::string, 2> sideNames(const Look& left, const Look& right,
                                     const std::vector<scenes::Light>* lights = nullptr);

} // namespace tessera::viewer
