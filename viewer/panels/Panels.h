#pragma once
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

/// The viewer's panels, a function each. They show the state and change it; they request longer actions
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

/// Asks what State::question says, over all else; draws nothing where that is none.
void questionDialog(State& state, float scale);

/// Asks for a file, over the picture and the panels, as State::files says; draws nothing where that is none.
void fileDialog(State& state, float scale);

/// Every key, over the picture.
void helpOverlay(State& state, float scale);

} // namespace tessera::viewer
