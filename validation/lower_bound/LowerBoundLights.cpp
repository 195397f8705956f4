#include "validation/lower_bound/LowerBoundLights.h"

#include <algorithm>
#include <cmath>

namespace tessera::validation {

namespace {

/// Far beyond the surface's farthest corner, 6 metres ahead, at any sensible aspect ratio.
constexpr double kRangeMetres = 64.0;

/// Points on a disc at successive multiples of this angle never line up. Source: Vogel 1979, "A better way to construct
/// the sunflower head".
const double kGoldenAngleRadians = 3.14159265358979 * (3.0 - std::sqrt(5.0));

shared::LightTexels lowerBoundLight(int kind, int index, int count) {
    const double radius = std::sqrt((index + 0.5) / count);
    const double angle = kGoldenAngleRadians * index;
    const glm::dvec3 position(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    shared::LightTexels light{};
    light.position = glm::vec4(glm::vec3(position), float(1.0 / (kRangeMetres * kRangeMetres)));
    light.color = glm::vec4(1.0f, 0.8f, 0.6f, float(kind));
    // The eye looks along -z.
    if (!scenes::infoOf(frame::typeOf(light)).hasPosition())
        light.position = glm::vec4(glm::vec3(glm::normalize(position + glm::dvec3(0.0, 0.0, 5.0))), 0.0f);
    return light;
}

/// The corners of a polygon light: a square.
shared::LightCornerTexels lowerBoundLightCorners() {
    const float half = std::sqrt(0.5f);
    shared::LightCornerTexels corners{};
    corners.outline = glm::vec4(0.0f, 0.0f, 4.0f, 0.0f);
    corners.corners[0] = glm::vec4(-half, -half, half, -half);
    corners.corners[1] = glm::vec4(half, half, -half, half);
    return corners;
}

/// Area lights: a surface half a metre wide that faces ahead. Others: a cone of full intensity everywhere ahead (cos
/// inner 0, cos outer -1) or parameters of 1 in that direction, and a mild falloff.
shared::LightShapeTexels lowerBoundLightShape(scenes::LightType type) {
    const scenes::LightTypeInfo& info = scenes::infoOf(type);
    const bool isCone = info.reach == scenes::LightReach::Cone;
    shared::LightShapeTexels shape{};
    if (info.isArea) {
        shape.axis =
            glm::vec4(type == scenes::LightType::Sphere ? 0.0f : 0.25f, 0.0f, 0.0f, info.isFlat ? 0.0f : 0.25f);
        if (info.isFlat) shape.attenuation = glm::vec4(0.0f, -0.25f, 0.0f, 0.0f);
        if (info.hasCorners()) shape.axis.w = 2.0f; // a square's area over the square of half its diagonal
        return shape;
    }
    shape.axis = isCone ? glm::vec4(0.0f, 0.0f, 1.0f, -0.5f) : glm::vec4(0.0f, 0.0f, -1.0f, 1.0f);
    shape.attenuation = glm::vec4(1.0f, 0.1f, 0.01f, isCone ? 0.0f : 1.0f);
    return shape;
}

} // namespace

frame::PackedLights lowerBoundLights(const frame::PackedLights& like, int count) {
    frame::PackedLights lights;
    lights.features = like.features;
    lights.features.has.reset(std::size_t(frame::Feature::LightPictures)); // lights without images cost no more
    const std::size_t known = like.texels.size();
    if (known == 0) lights.features.add(frame::featureOf(scenes::LightType::Point));
    for (int i = 0; i < count; ++i) {
        // Repeats the lights in turn if there are fewer than `count`, else takes evenly spaced ones.
        const std::size_t chosen = known < std::size_t(count) ? std::size_t(i) % std::max<std::size_t>(known, 1)
                                                              : std::size_t(i) * known / std::size_t(count);
        const int kind = known == 0
                             ? int(scenes::LightType::Point)
                             : int(like.texels[chosen].color.w) & ~(LIGHT_BROAD | LIGHT_SHADOWED | LIGHT_SIX_FACES);
        lights.texels.push_back(lowerBoundLight(kind, i, count));
        lights.shapes.push_back(lowerBoundLightShape(frame::typeOf(lights.texels.back())));
        lights.corners.push_back(lowerBoundLightCorners()); // read where lights are polygons
        lights.shadows.emplace_back();
    }
    return lights;
}

} // namespace tessera::validation
