#pragma once
#include <string>

#include "viewer/session/State.h"

/// Playback: clips, lights and hooks share one scene time.
namespace tessera::viewer {

constexpr float kSlowest = 0.1f, kFastest = 4.0f; ///< range of State::speed

/// Whether anything in the scene moves over time.
bool canMove(const State& state);
/// Whether time advances and anything moves.
bool plays(const State& state);
/// Whether the image changes by itself: the scene plays, or the camera moves.
bool isMoving(const State& state);
/// Starts or pauses the scene time. A clip that has ended starts again.
void togglePlaying(State& state);
/// Advances the scene time by clock time. At its end a clip repeats, with everything else that moves, or stops.
void passTime(State& state, double clockSeconds);
/// The options for saving the scene: if anything moves, the file begins at the displayed time.
scenes::SceneOptions optionsToSave(const State& state);
/// Plays a clip of the scene from its beginning, named as for --clip. Throws InputError if it moves something too far
/// away; the previous clip then stays.
void chooseClip(State& state, const std::string& nameOrNumber);

} // namespace tessera::viewer
