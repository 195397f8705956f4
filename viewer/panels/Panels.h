#pragma once
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

/// The viewer's panels, one function each. They show the state and change it; they request longer actions
/// (State::requests).
namespace tessera::viewer {

void scenePanel(State& state, const Facts& facts);
void framePanel(State& state);
void viewPanel(State& state);
void environmentPanel(State& state, const Facts& facts);
void shadowsPanel(State& state, const Facts& facts);
void skinPanel(State& state);
void cameraPanel(State& state);
void animationPanel(State& state);
void lightsPanel(State& state);
void materialsPanel(State& state);
void comparePanel(State& state, const Facts& facts);
void timingsPanel(State& state, const Facts& facts);
void cullingPanel(State& state, const Facts& facts);
void graphPanel(State& state, const Facts& facts);
void savePanel(State& state);

/// Shows State::question as a dialog above everything else; draws nothing without one.
void questionDialog(State& state, float scale);

/// Shows the file dialog State::files over the image and the panels; draws nothing without one.
void fileDialog(State& state, float scale);

/// Shows all keys over the image.
void helpOverlay(State& state, float scale);

} // namespace tessera::viewer
