#pragma once
#include <optional>
#include <vector>

#include "scenes/Scene.h"

/// Poses of a scene: active clips are evaluated in double precision and closed form, so that any time can be evaluated
/// directly, and the result is written into the scene. All renderers, including the reference, read the same vertices.
namespace tessera::scenes {

/// State of a rig at a time.
struct Pose {
    std::vector<glm::dmat4> parentFromNode;   ///< by Rig::nodes
    std::vector<std::vector<double>> weights; ///< by Rig::weights
    /// By Rig::numbers; none if no active clip changes the value.
    std::vector<std::optional<glm::dvec4>> numbers;
};

/// Evaluates the active clips at a finite time; everything else keeps its rest state.
Pose poseAt(const Rig& rig, double timeSeconds);

/// Writes a pose of the scene's rig into the scene: node transforms, deformed meshes, attached lights and cameras, and
/// values that active clips change. The scene then depends on this pose alone, not on earlier ones. Throws InputError
/// if anything is then too far away or not finite.
void applyPose(Scene& scene, const Pose& pose);

/// Whether a pose changes anything of the scene.
bool hasPoses(const Scene& scene);

/// Poses the scene if hasPoses().
void poseScene(Scene& scene, double timeSeconds);

} // namespace tessera::scenes
