#pragma once
#include <span>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/light.h"

namespace tessera::frame {

/// The volumes outside which packed lights are exactly 0, parallel to `lights`. Made from what the shaders read, so
/// that culling and lighting speak of the same light, and enlarged by what rounding can move.
std::vector<shared::CullLight> cullLights(std::span<const shared::LightTexels> lights, const CameraView& view);

} // namespace tessera::frame
