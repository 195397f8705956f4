#include "renderer/frame/CullLights.h"

#include "shaders/shared/light_pictures.h"
#include <algorithm>
#include <cmath>

namespace tessera::frame {

namespace {

struct Sphere {
    glm::dvec3 center;
    double radius;
};

/// The smallest sphere around a cone of `reach` metres with a spherical cap.
Sphere sphereAroundCone(const glm::dvec3& apex, const glm::dvec3& axis, double cosOuter, double reach) {
    if (cosOuter <= 0.0) return {apex, reach};
    const double sinOuter = std::sqrt(1.0 - cosOuter * cosOuter);
    // Narrow cones: through apex and rim. Wide ones: around the rim's circle.
    if (cosOuter > sinOuter) return {apex + axis * (0.5 * reach / cosOuter), 0.5 * reach / cosOuter};
    return {apex + axis * (reach * cosOuter), reach * sinOuter};
}

shared::CullLight cullLight(const shared::LightTexels& light, const shared::LightShapeTexels& shape,
                            const glm::dmat3& cameraFromLS, const CameraView& view) {
    shared::CullLight cull{};
    cull.axis.w = -2.0f;
    cull.sphere.w = -1.0f;
    const int kind = int(light.color.w);
    if (light.position.w == 0.0f) return cull; // unlimited range

    const glm::dvec3 position = cameraFromLS * glm::dvec3(light.position);
    const double reach = 1.0 / std::sqrt(double(light.position.w));
    const glm::vec4& depthKey = view.constants.depthKey;
    const double margin = double(shared::roundingMargin(float(reach + glm::length(position)), depthKey));
    Sphere sphere{position, reach};
    cull.apex.w = surfaceReachMetres(typeOf(light), shape);
    if (scenes::infoOf(typeOf(light)).reach == scenes::LightReach::Cone) {
        const double cosOuter = std::clamp(double(shared::coneCosOuter(kind, shape)) - CONE_COSINE_MARGIN, -1.0, 1.0);
        const glm::dvec3 axis = glm::normalize(cameraFromLS * glm::dvec3(shared::coneTravel(shape)));
        sphere = sphereAroundCone(position, axis, cosOuter, reach);
        // Moving the apex back by m / sin(outer) encloses all points within m of the cone. coneTouchesBox() adds the
        // error that is proportional to the distance.
        const double errorMetres = double(shared::roundingMargin(0.0f, depthKey));
        const double sinOuter = std::sqrt(1.0 - cosOuter * cosOuter);
        const glm::dvec3 apex = sinOuter > 0.0 ? position - axis * (errorMetres / sinOuter) : position;
        cull.apex = glm::vec4(glm::vec3(apex), float(sinOuter));
        cull.axis = glm::vec4(glm::vec3(axis), float(cosOuter));
    }
    if (scenes::infoOf(typeOf(light)).isFlat && !shared::shinesFromBothSides(shape.attenuation.w)) {
        const glm::dvec3 travel = glm::cross(glm::dvec3(shape.axis), glm::dvec3(shape.attenuation));
        if (const double length = glm::length(travel); length > 0.0) {
            const glm::dvec3 front = cameraFromLS * (travel / length);
            cull.apex = glm::vec4(glm::vec3(position - margin * front), cull.apex.w);
            cull.axis = glm::vec4(glm::vec3(front), -3.0f);
        }
    }
    cull.sphere = glm::vec4(glm::vec3(sphere.center), float(sphere.radius + margin));
    return cull;
}

} // namespace

std::vector<shared::CullLight> cullLights(const PackedLights& lights, const CameraView& view) {
    // Right, up and ahead: view space looks along -z.
    glm::dmat3 cameraFromLS = glm::transpose(view.lsFromView);
    for (int column = 0; column < 3; ++column) cameraFromLS[column][2] = -cameraFromLS[column][2];
    std::vector<shared::CullLight> culls;
    for (std::size_t i = 0; i < lights.texels.size(); ++i)
        culls.push_back(cullLight(lights.texels[i], lights.shapes[i], cameraFromLS, view));
    return culls;
}

} // namespace tessera::frame
