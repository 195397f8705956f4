#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/import/GltfModel.h"

/// What channels of animations point at: JSON pointers of KHR_animation_pointer, and paths of nodes as such.
namespace tessera::scenes::gltf {

inline constexpr std::string_view kNodesPointer = "/nodes/";
inline constexpr std::string_view kMaterialsPointer = "/materials/";
inline constexpr std::string_view kLightsPointer = "/extensions/KHR_lights_punctual/lights/";
inline constexpr std::string_view kCamerasPointer = "/cameras/";

/// Cuts "/nodes/" and a number from the begin of "/nodes/3/translation", and the slash after.
std::optional<std::size_t> cutIndex(std::string_view& pointer, std::string_view array);

/// A pointer to what a channel changes, the same for all channels that change the same thing of the document.
std::string changedBy(const tiny::AnimationChannel& channel);

/// The node whose weights a channel changes, by number of the document; none: it changes something else.
std::optional<std::size_t> nodeOfWeights(const tiny::AnimationChannel& channel);

/// A pointer without its numbers, which is the same for all things of a kind: "/cameras/*/orthographic/xmag".
std::string kindOf(std::string_view pointer);

} // namespace tessera::scenes::gltf
