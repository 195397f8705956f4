#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "scenes/Scene.h"

/// What a rig knows of lights and cameras, as they are edited, replaced and taken away.
namespace tessera::scenes {

/// Which lights clips change and nodes carry.
struct LightLinks {
    std::vector<Carried> carried; ///< Rig::lights
    std::vector<int> numbers;     ///< by Rig::numbers: the light, else kNone
};
LightLinks lightLinks(const Rig& rig);
void setLightLinks(Rig& rig, const LightLinks& links);
/// What is left of the links when lights from `first` on are edited. An edited place, direction or number is no longer
/// animated.
LightLinks linksAfterEdit(const Rig& rig, std::size_t first, std::span<const Light> before,
                          std::span<const Light> after);
/// The same when `put` lights have come in the place of `taken` ones from `first` on, which all are without links.
LightLinks linksAfterReplacing(const Rig& rig, std::size_t first, std::size_t taken, std::size_t put);
/// The same when lights were deleted; indices from the least on.
LightLinks linksAfterDeleting(const Rig& rig, std::span<const std::size_t> deleted);

/// Takes away lights from number `count` on, and what the rig knows of them.
void keepLights(Scene& scene, std::size_t count);
/// Takes away all cameras, and what the rig knows of them.
void dropCameras(Scene& scene);
/// Lets clips leave alone what of a camera is not as it was `before`: its place, or a number.
void ownCamera(Scene& scene, std::size_t camera, const Camera& before);
/// How many elements of that owner the scene has, which RestNumber::element indexes.
std::size_t elementCount(const Scene& scene, AnimatedOwner owner);

/// Lets lights and cameras stay as they are whatever clips play, as those of a scene file do.
void leaveLightsAndCameras(Scene& scene);

} // namespace tessera::scenes
