#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "scenes/Scene.h"

/// A rig's references to lights and cameras, while these are edited, replaced and removed.
namespace tessera::scenes {

/// References to lights: those attached to nodes, and those that clips change.
struct LightLinks {
    std::vector<Carried> carried; ///< Rig::lights
    std::vector<int> numbers;     ///< by Rig::numbers: index of the light, else kNone
};
LightLinks lightLinks(const Rig& rig);
void setLightLinks(Rig& rig, const LightLinks& links);
/// The remaining links after lights from `first` on were edited. An edited position, direction or value is no longer
/// animated.
LightLinks linksAfterEdit(const Rig& rig, std::size_t first, std::span<const Light> before,
                          std::span<const Light> after);
/// The same after `put` lights, which have no links, replaced `taken` lights from `first` on.
LightLinks linksAfterReplacing(const Rig& rig, std::size_t first, std::size_t taken, std::size_t put);
/// The same after lights were deleted; indices ascend.
LightLinks linksAfterDeleting(const Rig& rig, std::span<const std::size_t> deleted);

/// Removes the lights from index `count` on, and the rig's references to them.
void keepLights(Scene& scene, std::size_t count);
/// Removes all cameras, and the rig's references to them.
void dropCameras(Scene& scene);
/// Stops animating a camera's transform or values if they differ from `before`.
void ownCamera(Scene& scene, std::size_t camera, const Camera& before);
/// Number of the scene's elements of that owner, which RestNumber::element indexes.
std::size_t elementCount(const Scene& scene, AnimatedOwner owner);

/// Detaches all lights and cameras from the rig, since those of a scene file are not animated by clips.
void leaveLightsAndCameras(Scene& scene);

} // namespace tessera::scenes
