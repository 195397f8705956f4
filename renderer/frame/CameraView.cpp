#include "renderer/frame/CameraView.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::frame {

namespace {

/// Image-plane parameters of the camera.
struct Lens {
    glm::dmat4 clipFromView{0.0}; ///< clip.z is left 0
    glm::dvec2 halfExtent{1.0}; ///< of the image plane at unit distance (perspective) or at any distance (orthographic)
    glm::dvec2 visibleExtent{1.0}; ///< the same, enlarged to cover the shifted image
    glm::dvec2 shift{0.0};         ///< of the image, in half widths and half heights
};

Lens makeLens(const scenes::Camera& camera, glm::ivec2 sizePixels, const glm::dvec2& offsetPixels) {
    Lens lens;
    const double aspect = double(sizePixels.x) / double(sizePixels.y);
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const double halfHeight = isPerspective ? std::tan(0.5 * camera.fovYRadians) : camera.halfHeightMetres;
    lens.halfExtent = lens.visibleExtent = {halfHeight * aspect, halfHeight};
    lens.clipFromView[0][0] = 1.0 / lens.halfExtent.x;
    lens.clipFromView[1][1] = 1.0 / lens.halfExtent.y;
    (isPerspective ? lens.clipFromView[2][3] : lens.clipFromView[3][3]) = isPerspective ? -1.0 : 1.0;
    // NDC offset, so a factor of clip.w. Applied below, once clip.w includes the origin of lighting space.
    lens.shift = 2.0 * offsetPixels / glm::dvec2(sizePixels);
    // The depth interval covers everything that the shifted image shows.
    lens.visibleExtent *= 1.0 + glm::abs(lens.shift);
    return lens;
}

/// Depth as a function of the distance s ahead of lighting space's origin: clip.z = slope s + offset.
/// ViewConstants::aheadFromDepth holds the coefficients of the inverse. Rounding errors shrink with the interval.
struct DepthCoding {
    double slope = 0.0, offset = 0.0;
    glm::dvec4 aheadFromDepth{0.0};
};

DepthCoding depthCoding(const DepthInterval& depths, bool isPerspective) {
    const double n = depths.nearMetres, f = depths.farMetres, origin = depths.originMetres;
    DepthCoding coding;
    if (isPerspective) {
        // depth = a (f - z) / z at view depth z, which is 1 at the near end and 0 at the far one.
        const double a = std::isinf(f) ? 0.0 : n / (f - n);
        coding.slope = -a;
        coding.offset = std::isinf(f) ? n : a * (f - origin);
        coding.aheadFromDepth = {coding.offset, -origin, a, 1.0};
    } else {
        coding.slope = -1.0 / (f - n);
        coding.offset = (f - origin) / (f - n);
        coding.aheadFromDepth = {f - origin, -(f - n), 1.0, 0.0};
    }
    return coding;
}

glm::dvec4 row(const glm::dmat4& m, int i) {
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

glm::dvec4 unitPlane(const glm::dvec4& plane) {
    return plane / glm::length(glm::dvec3(plane));
}

} // namespace

CameraView makeCameraView(const scenes::Camera& camera, glm::ivec2 sizePixels, LightingSpace space,
                          const glm::vec3& background, std::span<const SurfaceBounds> bounds, float snapPixels,
                          const glm::dvec2& offsetPixels) {
    const bool orthographic = camera.projection == scenes::Projection::Orthographic;
    const Lens lens = makeLens(camera, sizePixels, offsetPixels);
    const glm::dmat3 worldFromView(camera.worldFromCamera);
    const glm::dvec3 forwardWS = -worldFromView[2];

    CameraView view;
    view.eyeWS = glm::dvec3(camera.worldFromCamera[3]);
    view.depths = depthInterval(camera, lens.visibleExtent, bounds);
    const double origin = view.depths.originMetres;
    view.originWS = view.eyeWS + origin * forwardWS;
    view.lsFromWorld = space == LightingSpace::World ? glm::dmat3(1.0) : glm::transpose(worldFromView);
    view.lsFromView = view.lsFromWorld * worldFromView;
    const glm::dmat3& lsFromView = view.lsFromView;
    view.forwardLS = lsFromView * glm::dvec3(0.0, 0.0, -1.0);

    // View space moved to the origin of lighting space.
    const DepthCoding coding = depthCoding(view.depths, !orthographic);
    glm::dmat4 clipFromOrigin = lens.clipFromView;
    clipFromOrigin[2][2] = -coding.slope;
    clipFromOrigin[3][2] = coding.offset;
    if (!orthographic) clipFromOrigin[3][3] = origin;
    for (int column = 0; column < 4; ++column)
        for (int axis = 0; axis < 2; ++axis)
            clipFromOrigin[column][axis] += lens.shift[axis] * clipFromOrigin[column][3];
    view.clipFromLS = clipFromOrigin * glm::dmat4(glm::transpose(lsFromView));
    const glm::dvec4 x = row(view.clipFromLS, 0), y = row(view.clipFromLS, 1), w = row(view.clipFromLS, 3);
    view.frustumPlanesLS = {unitPlane(w + x), unitPlane(w - x), unitPlane(w + y), unitPlane(w - y),
                            glm::dvec4(view.forwardLS, origin - camera.nearMetres)};

    const glm::dvec2 pixelStep = 2.0 * lens.halfExtent / glm::dvec2(sizePixels);
    shared::ViewConstants& c = view.constants;
    c.clipFromLS = glm::mat4(view.clipFromLS);
    c.clipFromRWS = glm::mat4(clipFromOrigin * glm::dmat4(glm::transpose(worldFromView)));
    c.worldFromLS = glm::mat4(glm::dmat4(glm::transpose(view.lsFromWorld)));
    c.eyeLS = glm::vec4(glm::vec3(-origin * view.forwardLS), float(origin));
    c.rayDxLS = glm::vec4(lsFromView * glm::dvec3(pixelStep.x, 0.0, 0.0), 0.0f);
    c.rayDyLS = glm::vec4(lsFromView * glm::dvec3(0.0, pixelStep.y, 0.0), 0.0f);
    c.forwardLS = glm::vec4(view.forwardLS, orthographic ? 1.0f : 0.0f);
    c.aheadFromDepth = glm::vec4(coding.aheadFromDepth);
    c.background = glm::vec4(background, 0.0f);
    c.rayFromPixel = glm::vec4(pixelStep, 0.5 * glm::dvec2(sizePixels) + offsetPixels);
    c.sizePixels = glm::uvec4(sizePixels, 0u, 0u);
    // Perspective depth is a (f - z) / z; the bias a makes the depth key's sum a f / z.
    const double span = view.depths.isEven ? view.depths.farMetres - view.depths.nearMetres : 0.0;
    c.depthKey = glm::vec4(view.depths.isEven ? 1.0f : c.aheadFromDepth.z, float(span),
                           float(snapPixels * std::max(pixelStep.x, pixelStep.y)), snapPixels);
    return view;
}

bool isOutside(const scenes::Box3& boxWS, double marginMetres, const CameraView& view) {
    if (boxWS.empty()) return false;
    const glm::dvec3 low = boxWS.min - view.originWS, high = boxWS.max - view.originWS;
    return std::ranges::any_of(view.frustumPlanesLS, [&](const glm::dvec4& plane) {
        const glm::dvec3 normal = glm::dvec3(plane) * view.lsFromWorld; // by the transpose, into world axes
        const glm::dvec3 innermost(normal.x > 0.0 ? high.x : low.x, normal.y > 0.0 ? high.y : low.y,
                                   normal.z > 0.0 ? high.z : low.z);
        const double insideMetres = glm::dot(normal, innermost) + plane.w;
        return insideMetres < -marginMetres;
    });
}

} // namespace tessera::frame
