#pragma once
#include "passes/recipes/Techniques.h"
#include "renderer/frame/CameraView.h"
#include "renderer/frame/CullLights.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/frame/PackedLights.h"

namespace tessera::recipes {

/// What is known of a frame before any of it is on a GPU.
struct PreparedFrame {
    frame::CameraView view;
    frame::PackedLights lights;
    frame::FrameSpec spec;
    std::vector<shared::CullLight> cullLights; ///< parallel to lights.texels; empty where no lists are built
};

/// Throws InputError when the settings name a camera or light that the scene lacks, a size or number of samples that no
/// picture has, a range tolerance that is negative or not finite, or a setting that the technique cannot draw.
/// Whoever draws the frame hands over the scene's bounds.
PreparedFrame prepareFrame(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings,
                           std::span<const frame::SurfaceBounds> bounds = {});

/// The camera that the settings ask for, where they put it.
scenes::Camera frameCamera(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::recipes
