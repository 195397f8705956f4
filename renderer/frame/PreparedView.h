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

/// A view's data on the CPU, before any upload to a GPU.
struct PreparedView {
    CameraView camera;
    PackedLights lights;
    shared::LightingConstants lighting{};
    shared::EnvironmentConstants environment{}; ///< if the spec has an environment
    shared::HookConstants hook{};               ///< if the spec has a hook
    std::vector<shared::SeenLightTexels> seenLights;
    FrameSpec spec;
    ShadowMaps shadowMaps;                             ///< empty where the view has none
    std::vector<shared::ShadowFaceTexels> shadowFaces; ///< of the shadow maps
    std::vector<shared::CullLight> cullLights;         ///< parallel to lights.texels; empty without light lists

    /// By cell of the view's DiffusionAtlas: the diffusing objects, and the views that render their irradiance.
    std::vector<DiffusionObject> diffusionObjects;
    std::vector<PreparedView> diffusionViews;

    culling::FrameConstants constants() const { return {camera.constants, lighting}; }
};

/// Hash of all inputs of an object's diffused light that can change.
std::uint64_t diffusionKey(const scenes::Scene& scene, const DiffusionObject& object, const PreparedView& prepared,
                           std::uint64_t casterRevision);

} // namespace tessera::frame
