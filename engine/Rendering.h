#pragma once
#include "base/Picture.h"
#include "engine/Renderer.h"

namespace tessera::engine {

/// Converts rendered frames to images for comparison, files and display.
Picture toPicture(const RenderedFrame& frame);
DisplayImage toDisplayImage(const RenderedFrame& frame);

/// Applies exposure and tone map of the settings to linear radiance as the display pass does, for images that no pass
/// drew, such as the reference's. NaN becomes black.
DisplayImage toDisplayImage(const Picture& picture, const frame::FrameSettings& settings);

} // namespace tessera::engine
