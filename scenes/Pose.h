#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
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

/// Takes the scene's present numbers as those at rest, of all that clips may change. To be called before a clip is
/// posed: a scene file may say other numbers than the model that its clips come from.
void takeRest(Scene& scene);

/// The scene's materials, with the numbers at rest in place of those that clips which play change.
std::vector<Material> restingMaterials(const Scene& scene);

/// The same of one of them.
Material restingMaterial(const Scene& scene, std::size_t index);
/// What an edit of a posed material makes of it at rest: a number that a clip which plays changes stays at rest where
/// the edit leaves it alone.
Material editedAtRest(const Scene& scene, std::size_t index, Material edited);
/// Puts a material in the place of another, and takes its numbers as those at rest. The scene then holds it as the
/// clips that play pose it at that time.
void replaceMaterial(Scene& scene, std::size_t index, Material resting, double timeSeconds);

/// Whether a pose changes anything of the scene.
bool hasPoses(const Scene& scene);
/// Whether any clip is chosen.
bool isPlaying(const Scene& scene);

/// What the clips that play change of what a renderer keeps from picture to picture. Lights and cameras it does not.
struct MovingParts {
    bool geometry = false;  ///< transforms of nodes that show meshes, joints or weights of morph targets
    bool materials = false; ///< numbers of materials or of their textures' places
};
MovingParts movingParts(const Scene& scene);

/// Poses a scene that hasPoses(), and leaves others alone.
void poseScene(Scene& scene, double timeSeconds);

inline constexpr std::string_view kNoClip = "none";

/// Lets the clips of a name play, else the one of that number from 0, or none (kNoClip), and puts numbers that others
/// changed to rest. Throws InputError that lists the names.
void playClip(Scene& scene, const std::string& nameOrNumber);

/// "clip 0 'Walk' of 3, 1.04 s", numbered as playClip() takes it; empty where the scene has no clips.
std::string clipText(const Scene& scene);

/// Puts all numbers of lights that clips may change to rest.
void restLights(Scene& scene);

/// Whether a clip that plays moves a camera.
bool movesCamera(const Scene& scene, int camera);

} // namespace tessera::scenes
