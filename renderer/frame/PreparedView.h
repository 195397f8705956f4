#pragma once
#include <vector>

#include "renderer/culling/TileGrid.h"
#include "renderer/frame/CameraView.h"
#include "renderer/frame/CullLights.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/frame/SeenLights.h"
#include "renderer/frame/ShadowMaps.h"

namespace tessera::frame {

/// What is known of a view of a scene before any of it is on a GPU.
struct PreparedView {
    CameraView camera;
    PackedLights lights;
    shared::LightingConstants lighting{};
    shared::EnvironmentConstants environment{}; ///< where the spec has a map
    shared::HookConstants hook{};               ///< where the spec has one
    std::vector<shared::SeenLightTexels> seenLights;
    FrameSpec spec;
    ShadowMaps shadowMaps;                             ///< empty where the view has none
    std::vector<shared::ShadowFaceTexels> shadowFaces; ///< of those
    std::vector<shared::CullLight> cullLights;         ///< parallel to lights.texels; empty where no lists are built

    /// By cell of the view's SpreadLightAtlas: the objects that light spreads over, and the lights that reach them.
    std::vector<SpreadingObject> spreadingObjects;
    std::vector<PreparedView> spreadingViews;

    culling::FrameConstants constants() const { return {camera.constants, lighting}; }
};

/// Of all that the light spread over an object is computed from, but what never changes.
std::uint64_t diffusionKey(const scenes::Scene& scene, const SpreadingObject& object, const PreparedView& prepared,
                           std::uint64_t casterRevision);

} // namespace tessera::frame
