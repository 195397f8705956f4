#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scenes/Scene.h"

/// Which clips of a scene play, and what of it they move.
namespace tessera::scenes {

inline constexpr std::string_view kNoClip = "none";

/// The clips of a name, else the one of that number from 0, or none (kNoClip). Throws InputError that lists the names.
std::vector<int> clipsCalled(const Rig& rig, const std::string& nameOrNumber);

/// Lets the clips play that are called so, and puts numbers that others changed to rest. Throws as clipsCalled().
void playClip(Scene& scene, const std::string& nameOrNumber);

/// "clip 0 'Walk' (of 0 to 2), 1.04 s", numbered as playClip() takes it; empty where the scene has no clips.
std::string clipText(const Scene& scene);

/// Whether any clip is chosen.
bool isPlaying(const Scene& scene);

/// When the last key of the clips that play is; they stand still from then on. 0 where none plays.
double playingSeconds(const Rig& rig);

/// What the clips that play change of what a renderer keeps from picture to picture. Lights and cameras it does not.
struct MovingParts {
    bool geometry = false;  ///< transforms of nodes that show meshes, joints or weights of morph targets
    bool materials = false; ///< numbers of materials or of their textures' places
};
MovingParts movingParts(const Scene& scene);

/// Whether a clip that plays moves a camera.
bool movesCamera(const Scene& scene, int camera);

} // namespace tessera::scenes
