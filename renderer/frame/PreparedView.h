#pragma once
#include <vector>

#include "renderer/culling/TileGrid.h"
#include "renderer/frame/CameraView.h"
#include "renderer/frame/CullLights.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/frame/ShadowMaps.h"

namespace tessera::frame {

/// What is known of a view of a scene before any of it is on a GPU.
struct PreparedView {
    CameraView camera;
    PackedLights lights;
    shared::LightingConstants lighting{};
    FrameSpec spec;
    ShadowMaps shadowMaps;                             ///< empty where the view has none
    std::vector<shared::ShadowFaceTexels> shadowFaces; ///< of those
    std::vector<shared::CullLight> cullLights;         ///< parallel to lights.texels; empty where no lists are built

    culling::FrameConstants constants() const { return {camera.constants, lighting}; }
};

} // namespace tessera::frame
