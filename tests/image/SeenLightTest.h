#pragma once
#include <cstddef>

#include <glm/glm.hpp>

#include "tests/image/ShadowTest.h"
#include "tests/support/AreaLights.h"

/// Visible area lights and images of them.
namespace tessera::test {

inline constexpr glm::vec3 kShown(5.0f, 2.5f, 1.25f); ///< radiance of seenLamp()

/// Area of the L of ellCorners(), a rectangle of 1 x 0.6 m without one corner.
inline constexpr double kEllSquareMetres = 0.52;
inline scenes::LightCorners ellCorners() {
    return cornersOf({{-0.5f, -0.3f}, {0.5f, -0.3f}, {0.5f, 0.1f}, {0.1f, 0.1f}, {0.1f, 0.3f}, {-0.5f, 0.3f}});
}

/// A lamp facing +z, 1 m wide and 0.6 m high or long, or of radius 0.4 m; a polygon is an L.
inline scenes::Light seenLamp(scenes::LightType type, const glm::dvec3& positionWS) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = {0.0, 0.0, 1.0};
    light.heightMetres = light.lengthMetres = 0.6f;
    light.radiusMetres = type == scenes::LightType::Rectangle ? 0.0f : 0.4f;
    light.corners = ellCorners();
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 5.0f;
    return light;
}

/// A lamp facing any direction; its width axis is an arbitrary perpendicular.
inline scenes::Light turnedLamp(scenes::LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS) {
    scenes::Light light = seenLamp(type, positionWS);
    light.directionWS = glm::normalize(directionWS);
    const glm::dvec3 aside = glm::normalize(glm::cross(light.directionWS, glm::dvec3(0.31, 0.83, 0.17)));
    light.alongWS = aside;
    return light;
}

/// Images with visible area lights.
class SeenLightTest : public ShadowTest {
protected:
    static std::size_t shownPixels(const engine::RenderedFrame& frame) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4)
            count += glm::vec3(frame.radiance[i], frame.radiance[i + 1], frame.radiance[i + 2]) == kShown;
        return count;
    }
};

} // namespace tessera::test
