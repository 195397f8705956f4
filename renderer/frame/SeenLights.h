#pragma once
#include <vector>

#include "renderer/frame/CameraView.h"
#include "shaders/shared/seen_lights.h"

namespace tessera::frame {

/// An area light whose surface may be seen in a view.
struct SeenLight {
    scenes::Light light; ///< as it is at the frame's time
    int picture = -1;    ///< its number among lightPictures(), or -1
    /// Around its surface, as DepthInterval.h takes it, so that its depths are those that depth values stand for.
    SurfaceBounds bounds;
    glm::dvec2 leastNdc{-1.0}, mostNdc{1.0}; ///< around its picture, in normalised device coordinates
};

/// Those of the scene that are on, shine and are to be seen (Light::isSeen), in document order, by the camera alone.
/// Left out are surfaces beside the picture or beyond the camera's near and far plane, flat ones that turn to the eye a
/// side that does not shine, and solids that the eye is in. Whatever the view shows, so that all have the same depths.
std::vector<SeenLight> seenLights(const scenes::Scene& scene, const scenes::Camera& camera,
                                  const FrameSettings& settings);

std::vector<shared::SeenLightTexels> packSeenLights(const std::vector<SeenLight>& lights, const CameraView& view);

/// Why there are none, where there are none.
std::string whyNoSeenLights(const scenes::Scene& scene, const FrameSettings& settings);

} // namespace tessera::frame
