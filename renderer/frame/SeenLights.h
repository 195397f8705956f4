#pragma once
#include <vector>

#include "renderer/frame/CameraView.h"
#include "shaders/shared/seen_lights.h"

namespace tessera::frame {

/// An area light whose surface may be visible in a view.
struct SeenLight {
    scenes::Light light; ///< as it is at the frame's time
    int picture = -1;    ///< index of its texture in lightPictures(), or -1
    /// Bounds of its surface for the depth interval (DepthInterval.h), so that depth values cover it.
    SurfaceBounds bounds;
    glm::dvec2 leastNdc{-1.0}, mostNdc{1.0}; ///< bounds of its projection, in normalised device coordinates
};

/// Area lights that are on, emit light and have Light::isSeen, in document order, culled by the camera alone. Omits
/// surfaces outside the image or outside the near and far plane, flat ones whose dark side faces the eye, and solids
/// that contain the eye. Independent of the debug view, so that all views have the same depths.
std::vector<SeenLight> seenLights(const scenes::Scene& scene, const scenes::Camera& camera,
                                  const FrameSettings& settings);

std::vector<shared::SeenLightTexels> packSeenLights(const std::vector<SeenLight>& lights, const CameraView& view);

/// Why no light surface is visible.
std::string whyNoSeenLights(const scenes::Scene& scene, const FrameSettings& settings);

} // namespace tessera::frame
