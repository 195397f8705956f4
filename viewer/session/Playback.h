#pragma once
#include <string>

#include "viewer/session/State.h"

/// How time goes on in a scene that moves: clips, lights and hooks all follow one time.
namespace tessera::viewer {

constexpr float kSlowest = 0.1f, kFastest = 4.0f; ///< of State::speed

/// Whether anything of the scene moves with the time.
bool canMove(const State& state);
/// Whether anything moves now, as time goes on.
bool plays(const State& state);
/// Whether the picture changes by itself: something plays, or the camera is on its way.
bool isMoving(const State& state);
/// Lets time go on, or stops it. A clip that is over begins again.
void togglePlaying(State& state);
/// So much of the clock's time is over. At its end a clip is repeated, with all else that moves, or comes to rest.
void passTime(State& state, double clockSeconds);
/// The options of a scene that is saved now: where something moves, it begins at the time that is shown.
scenes::SceneOptions optionsToSave(const State& state);
/// Plays a clip of the scene, as --clip takes it, from its beginning. Throws InputError where it moves something too
/// far away; the clip before then stays.
void chooseClip(State& state, const std::string& nameOrNumber);

} // namespace tessera::viewer
