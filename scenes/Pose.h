#pragma once
#include <optional>
#include <span>
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

/// The value of a curve at a time, `width` numbers. A rotation is a unit quaternion.
void valueAt(const AnimationSampler& sampler, bool isRotation, double timeSeconds, std::span<double> value);

/// What the clips that play say of a finite time; what they do not change is as it is by itself.
Pose poseAt(const Rig& rig, double timeSeconds);

/// Writes a pose of the scene's rig into the scene: transforms of nodes, deformed meshes, lights and cameras that nodes
/// carry, and numbers that a clip which plays changes. It depends on the pose alone, not on
/// earlier ones. Throws InputError where something then lies too far away or nowhere.
void applyPose(Scene& scene, const Pose& pose);

/// Takes the numbers that clips may change as they are now for those at rest. To be called before a clip is posed: a
/// scene file may say other numbers than the model that its clips come from.
void takeRest(Scene& scene);

/// The scene's materials, with the numbers at rest that clips which play change.
std::vector<Material> restingMaterials(const Scene& scene);

/// Whether a pose changes anything of the scene.
bool hasPoses(const Scene& scene);
/// Whether the scene's picture changes with the time of its clips.
bool isPlaying(const Scene& scene);

/// Poses a scene that hasPoses(), and leaves others alone.
void poseScene(Scene& scene, double timeSeconds);

inline constexpr std::string_view kNoClip = "none";

/// Lets the clips of a name play, else the one of that number from 0, or none (kNoClip), and puts numbers that others
/// changed to rest. Throws InputError that lists the names.
void playClip(Scene& scene, const std::string& nameOrNumber);

/// "clip 0 'Walk' of 3, 1.04 s", numbered as playClip() takes it; empty where the scene has no clips.
std::string clipText(const Scene& scene);

/// Takes away lights from number `count` on, and what the rig knows of them.
void keepLights(Scene& scene, std::size_t count);
/// Takes away all cameras, and what the rig knows of them.
void dropCameras(Scene& scene);
/// Lets clips leave alone what of a camera is not as it was `before`: its place, or a number.
void ownCamera(Scene& scene, std::size_t camera, const Camera& before);
/// How many of those there are in a scene that RestNumber::element counts in.
std::size_t elementCount(const Scene& scene, AnimatedOwner owner);

/// Which lights clips change and nodes carry.
struct LightLinks {
    std::vector<Carried> carried; ///< Rig::lights
    std::vector<int> numbers;     ///< by Rig::numbers: the light, else kNone
};
LightLinks lightLinks(const Rig& rig);
void setLightLinks(Rig& rig, const LightLinks& links);
/// What is left of the links when a light is edited: who gives it another place, direction or number, owns that.
LightLinks linksAfterEdit(const Rig& rig, std::size_t light, const Light& before, const Light& after);
/// The same when `put` lights have come in the place of `taken` ones from `first` on, which all are without links.
LightLinks linksAfterReplacing(const Rig& rig, std::size_t first, std::size_t taken, std::size_t put);

/// The same when lights were deleted; indices from the least on.
LightLinks linksAfterDeleting(const Rig& rig, std::span<const std::size_t> deleted);

/// Puts all numbers of lights that clips may change to rest.
void restLights(Scene& scene);

/// Whether a clip that plays moves a camera.
bool movesCamera(const Scene& scene, int camera);

/// Lets lights and cameras stay as they are whatever clips play, as those of a scene file do.
void leaveLightsAndCameras(Scene& scene);

} // namespace tessera::scenes
