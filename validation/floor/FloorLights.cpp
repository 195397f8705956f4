#include "validation/floor/FloorLights.h"

#include <algorithm>
#include <cmath>

namespace tessera::validation {

namespace {

/// Far beyond the surface's farthest corner, 6 metres ahead in a picture of any sensible shape.
constexpr double kRangeMetres = 64.0;

/// Successive points on a disc by this angle never line up. Source: Vogel 1979, "A better way to construct the
/// sunflower head".
const double kGoldenAngleRadians = 3.14159265358979 * (3.0 - std::sqrt(5.0));

shared::LightTexels floorLight(int kind, int index, int count) {
    const double radius = std::sqrt((index + 0.5) / count);
    const double angle = kGoldenAngleRadians * index;
    const glm::dvec3 position(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    shared::LightTexels light{};
    light.position = glm::vec4(glm::vec3(position), float(1.0 / (kRangeMetres * kRangeMetres)));
    // The eye looks along -z.
    if (kind == LIGHT_DIRECTIONAL)
        light.position = glm::vec4(glm::vec3(glm::normalize(position + glm::dvec3(0.0, 0.0, 5.0))), 0.0f);
    light.color = glm::vec4(1.0f, 0.8f, 0.6f, float(kind));
    return light;
}

/// A cone of full intensity everywhere ahead (cos inner 0, cos outer -1), and a mild falloff.
shared::LightShapeTexels floorLightShape() {
    shared::LightShapeTexels shape{};
    shape.axis = glm::vec4(0.0f, 0.0f, 1.0f, -0.5f);
    shape.attenuation = glm::vec4(1.0f, 0.1f, 0.01f, 0.0f);
    return shape;
}

} // namespace

frame::PackedLights floorLights(const frame::PackedLights& like, int count) {
    frame::PackedLights lights;
    lights.features = like.features;
    const std::size_t known = like.texels.size();
    if (known == 0) lights.features.add(frame::Feature::PointLights);
    for (int i = 0; i < count; ++i) {
        // When there are fewer than `count`, the same ones in turn; else evenly spaced ones.
        const std::size_t chosen = known < std::size_t(count) ? std::size_t(i) % std::max<std::size_t>(known, 1)
                                                              : std::size_t(i) * known / std::size_t(count);
        const int kind = known == 0 ? LIGHT_POINT : int(like.texels[chosen].color.w) & ~LIGHT_BROAD;
        lights.texels.push_back(floorLight(kind, i, count));
        lights.shapes.push_back(floorLightShape());
    }
    return lights;
}

} // namespace tessera::validation
