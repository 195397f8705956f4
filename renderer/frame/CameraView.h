#pragma once
#include <array>
#include <span>

#include <glm/glm.hpp>

#include "renderer/frame/DepthInterval.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"
#include "shaders/shared/frame.h"

namespace tessera::frame {

/// A camera with an image size, in double precision. Lighting space (LS) has world or view axes. Its origin lies on the
/// view axis: at the eye, or amid the visible surfaces if all of them are far away. Clip space is reverse-Z, zero to
/// one: depth 1 at the near end of `depths`, 0 at the far end or at infinity.
struct CameraView {
    glm::dvec3 eyeWS{0.0};
    glm::dvec3 originWS{0.0}; ///< of lighting space
    DepthInterval depths;
    glm::dmat3 lsFromWorld{1.0}; ///< rotation
    glm::dmat3 lsFromView{1.0};  ///< rotation; view space looks along -z
    glm::dmat4 clipFromLS{1.0};
    glm::dvec3 forwardLS{0.0, 0.0, -1.0};
    std::array<glm::dvec4, 5> frustumPlanesLS; ///< n.p + d >= 0 inside: left, right, bottom, top, near
    shared::ViewConstants constants;

    glm::dvec3 positionLS(const glm::dvec3& positionWS) const { return lsFromWorld * (positionWS - originWS); }
};

/// Without `bounds` of the scene, depth spans the camera's near to far distance and lighting space starts at the eye.
/// `snapPixels` is gpu::Capabilities::snapPixels. `offsetPixels` shifts the image to the right and up.
CameraView makeCameraView(const scenes::Camera& camera, glm::ivec2 sizePixels, LightingSpace space,
                          const glm::vec3& background, std::span<const SurfaceBounds> bounds = {},
                          float snapPixels = 0.0f, const glm::dvec2& offsetPixels = glm::dvec2(0.0));

/// Whether the whole box lies outside one frustum plane by more than the margin.
bool isOutside(const scenes::Box3& boxWS, double marginMetres, const CameraView& view);

} // namespace tessera::frame
