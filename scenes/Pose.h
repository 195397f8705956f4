#pragma once
#include <optional>
#include <vector>

#include "scenes/Scene.h"

/// A scene at a time: the clips that play are evaluated in double precision and closed form, so any time can be asked
/// for directly, and what they move is written into the scene. Everything that draws the scene, the reference too,
/// reads the same vertices.
namespace tessera::scenes {

/// Where a rig's parts are at a time.
struct Pose {
    std::vector<glm::dmat4> parentFromNode;   ///< by Rig::nodes
    std::vector<std::vector<double>> weights; ///< by Rig::weights
    /// By Rig::numbers; none where no clip that plays changes the number.
    std::vector<std::optional<glm::dvec4>> numbers;
};

/// What the clips that play say of a finite time; what they do not change is as it is by itself.
Pose poseAt(const Rig& rig, double timeSeconds);

/// Writes a pose of the scene's rig into the scene: transforms of nodes, deformed meshes, lights and cameras that nodes
/// carry, and numbers that a clip which plays changes. The scene then depends on this pose alone, not on earlier ones.
/// Throws InputError where something then lies too far away or nowhere.
void applyPose(Scene& scene, const Pose& pose);

/// Whether a pose changes anything of the scene.
bool hasPoses(const Scene& scene);

/// Poses a scene that hasPoses(), and leaves others alone.
void poseScene(Scene& scene, double timeSeconds);

} // namespace tessera::scenes
