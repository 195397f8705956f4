#include "renderer/frame/CameraView.h"

#include <cmath>

namespace tessera::frame {

namespace {

/// Clip-from-view, and the depth mapping's inverse as the coefficients of FrameConstants::depthToViewDepth.
struct Lens {
    glm::dmat4 clipFromView{0.0};
    glm::dvec4 depthToViewDepth{0.0};
    glm::dvec2 halfExtent{1.0}; ///< of the image plane: at unit distance (perspective) or anywhere (orthographic)
};

Lens makeLens(const scenes::Camera& camera, double aspect) {
    Lens lens;
    const double n = camera.nearMetres;
    const bool endless = std::isinf(camera.farMetres);
    if (camera.projection == scenes::Projection::Perspective) {
        const double halfHeight = std::tan(0.5 * camera.fovYRadians);
        lens.halfExtent = {halfHeight * aspect, halfHeight};
        // depth = b / viewDepth - a, which is 1 at the near plane and 0 at the far one.
        const double a = endless ? 0.0 : n / (camera.farMetres - n);
        const double b = endless ? n : a * camera.farMetres;
        lens.clipFromView[2][2] = a;
        lens.clipFromView[2][3] = -1.0;
        lens.clipFromView[3][2] = b;
        lens.depthToViewDepth = {b, 0.0, a, 1.0};
    } else {
        // An orthographic depth buffer cannot reach infinity; a thousand picture heights stand in for it.
        const double f = endless ? n + 2000.0 * camera.halfHeightMetres : camera.farMetres;
        lens.halfExtent = {camera.halfHeightMetres * aspect, camera.halfHeightMetres};
        lens.clipFromView[2][2] = 1.0 / (f - n);
        lens.clipFromView[3][2] = f / (f - n);
        lens.clipFromView[3][3] = 1.0;
        lens.depthToViewDepth = {f, -(f - n), 1.0, 0.0};
    }
    lens.clipFromView[0][0] = 1.0 / lens.halfExtent.x;
    lens.clipFromView[1][1] = 1.0 / lens.halfExtent.y;
    return lens;
}

glm::dvec4 row(const glm::dmat4& m, int i) {
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

glm::dvec4 unitPlane(const glm::dvec4& plane) {
    return plane / glm::length(glm::dvec3(plane));
}

} // namespace

CameraView makeCameraView(const scenes::Camera& camera, glm::ivec2 sizePixels, LightingSpace space,
                          const glm::vec3& background) {
    const bool orthographic = camera.projection == scenes::Projection::Orthographic;
    const Lens lens = makeLens(camera, double(sizePixels.x) / double(sizePixels.y));
    const glm::dmat3 worldFromView(camera.worldFromCamera);

    CameraView view;
    view.eyeWS = glm::dvec3(camera.worldFromCamera[3]);
    view.lsFromWorld = space == LightingSpace::World ? glm::dmat3(1.0) : glm::transpose(worldFromView);
    view.lsFromView = view.lsFromWorld * worldFromView;
    const glm::dmat3& lsFromView = view.lsFromView;
    view.clipFromLS = lens.clipFromView * glm::dmat4(glm::transpose(lsFromView));
    view.forwardLS = lsFromView * glm::dvec3(0.0, 0.0, -1.0);

    const glm::dvec4 x = row(view.clipFromLS, 0), y = row(view.clipFromLS, 1), w = row(view.clipFromLS, 3);
    view.frustumPlanesLS = {unitPlane(w + x), unitPlane(w - x), unitPlane(w + y), unitPlane(w - y),
                            glm::dvec4(view.forwardLS, -camera.nearMetres)};

    // Pixel p lies at (2 p / size - 1) of the image plane's half extent, one unit ahead for a perspective camera.
    const glm::dvec2 pixelStep = 2.0 * lens.halfExtent / glm::dvec2(sizePixels);
    shared::FrameConstants& c = view.constants;
    c.clipFromLS = glm::mat4(view.clipFromLS);
    c.clipFromES = glm::mat4(lens.clipFromView * glm::dmat4(glm::transpose(worldFromView)));
    c.worldFromLS = glm::mat4(glm::dmat4(glm::transpose(view.lsFromWorld)));
    c.rayOriginLS = glm::vec4(lsFromView * glm::dvec3(-lens.halfExtent, orthographic ? 0.0 : -1.0), 0.0f);
    c.rayDxLS = glm::vec4(lsFromView * glm::dvec3(pixelStep.x, 0.0, 0.0), 0.0f);
    c.rayDyLS = glm::vec4(lsFromView * glm::dvec3(0.0, pixelStep.y, 0.0), 0.0f);
    c.forwardLS = glm::vec4(view.forwardLS, orthographic ? 1.0f : 0.0f);
    c.depthToViewDepth = glm::vec4(lens.depthToViewDepth);
    c.background = glm::vec4(background, 0.0f);
    c.lights = glm::uvec4(0u);
    c.lensVS = glm::vec4(-lens.halfExtent.x, pixelStep.x, -lens.halfExtent.y, pixelStep.y);
    c.tileGrid = glm::uvec4(0u);
    c.sizePixels = glm::uvec4(sizePixels, 0u, 0u);
    // b/distance - a is the depth of a perspective camera; what is added back makes the key's sum b/distance.
    c.depthKey = glm::vec4(orthographic ? 1.0f : c.depthToViewDepth.z, 0.0f, 0.0f, 0.0f);
    return view;
}

} // namespace tessera::frame
