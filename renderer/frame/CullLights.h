#pragma once
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/PackedLights.h"
#include "shaders/shared/culling.h"

namespace tessera::frame {

/// Bounding volumes outside which packed lights are exactly 0, parallel to lights.texels. Computed from the data that
/// the shaders read, so that culling and lighting agree, and enlarged by the largest rounding error.
std::vector<shared::CullLight> cullLights(const PackedLights& lights, const CameraView& view);

} // namespace tessera::frame
