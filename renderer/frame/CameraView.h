#pragma once
#include <array>

#include <glm/glm.hpp>

#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"
#include "shaders/shared/frame.h"

namespace tessera::frame {

/// A camera at a picture size, in double precision. LS (lighting space) is world space moved to the eye, or view space.
/// Clip space is reverse-Z, zero to one: depth 1 at the near plane, 0 at the far plane or infinity.
struct CameraView {
    glm::dvec3 eyeWS{0.0};
    glm::dmat3 lsFromWorld{1.0}; ///< rotation
    glm::dmat3 lsFromView{1.0};  ///< rotation; view space looks along -z
    glm::dmat4 clipFromLS{1.0};
    glm::dvec3 forwardLS{0.0, 0.0, -1.0};
    std::array<glm::dvec4, 5> frustumPlanesLS; ///< n.p + d >= 0 inside: left, right, bottom, top, near
    shared::FrameConstants constants;          ///< lights and tileGrid are left 0

    glm::dvec3 positionLS(const glm::dvec3& positionWS) const { return lsFromWorld * (positionWS - eyeWS); }
};

CameraView makeCameraView(const scenes::Camera& camera, glm::ivec2 sizePixels, LightingSpace space,
                          const glm::vec3& background);

} // namespace tessera::frame
