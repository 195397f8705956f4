#pragma once
#include "renderer/frame/CameraView.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/frame/PackedLights.h"

namespace tessera::recipes {

/// What is known of a frame before any of it is on a GPU.
struct PreparedFrame {
    frame::CameraView view;
    frame::PackedLights lights;
    frame::FrameSpec spec;
};

/// Throws InputError when the settings name a camera or light that the scene lacks, or a size that no picture has.
PreparedFrame prepareFrame(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::recipes
