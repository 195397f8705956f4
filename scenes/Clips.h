#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scenes/Scene.h"

/// Selection of a scene's active clips, and which parts of the scene they animate.
namespace tessera::scenes {

inline constexpr std::string_view kNoClip = "none";

/// The clips of a name, else the clip of that number from 0, or none (kNoClip). Throws InputError that lists the names.
std::vector<int> clipsCalled(const Rig& rig, const std::string& nameOrNumber);

/// Activates clips by name or number and restores what the previous ones changed. Throws as clipsCalled().
void playClip(Scene& scene, const std::string& nameOrNumber);

/// The active clips, "clip 0 'Walk' (of 0 to 2), 1.04 s", by number as in playClip(); empty if the scene has no clips.
std::string clipText(const Scene& scene);

/// Whether any clip is active.
bool isPlaying(const Scene& scene);

/// Time of the last key of the active clips, which stand still from then on; 0 without active clips.
double playingSeconds(const Rig& rig);

/// Which parts of the scene data that renderers cache are animated by active clips. Lights and cameras are not cached.
struct MovingParts {
    bool geometry = false;  ///< transforms of nodes with meshes, joints, or morph weights
    bool materials = false; ///< material factors or texture transforms
};
MovingParts movingParts(const Scene& scene);

/// Whether an active clip moves a camera.
bool movesCamera(const Scene& scene, int camera);

} // namespace tessera::scenes
