#pragma once
#include "renderer/frame/GBufferLayout.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// The layout with those packed channels made exact whose fields, roots of 0 to 1, cannot hold a colour of the scene:
/// albedo where base colour times texture and vertex colour may exceed 1, specular where k_s may. Pictures of floats
/// count as brighter than 1.
GBufferLayout holdingColors(GBufferLayout layout, const scenes::Scene& scene);

} // namespace tessera::frame
