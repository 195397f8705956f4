// Integrals over area lights with images.
#include "tests/support/LightPictures.h"

#include <gtest/gtest.h>

#include "scenes/AreaLight.h"
#include "tests/support/AreaLights.h"
#include "tests/unit/validation/reference/ShiningAreas.h"
#include "validation/reference/AreaLights.h"
#include "validation/reference/LightSurface.h"

namespace tessera::reference {
namespace {

TEST(ReferenceLightPictures, anEvenPictureIsAFactorOfTheLight) {
    for (const LightType type : test::kFlatTypes) {
        ShiningLight plain = test::shiningArea(type, {0.2, 0.3, 0.8}, glm::normalize(glm::dvec3(0.1, 0.2, -1.0)));
        plain.light.alongWS = scenes::usualAlong(plain.light.directionWS);
        ShiningLight pictured = plain;
        pictured.light.texture = test::evenLightTexture(glm::vec3(0.375f));
        EXPECT_NEAR(test::factorOf(pictured), 0.375 * test::factorOf(plain),
                    2.0 * test::kCubature * test::factorOf(plain));
        EXPECT_NEAR(meanFactor(pictured.light).g, 0.375, 1e-12);
    }
}

TEST(ReferenceLightPictures, halfOfAPictureIsHalfOfTheRectangle) {
    // With many texels per side the edge between both halves is sharp: the ramp is a 256th of the width.
    const ShiningLight whole = test::rectangle({0.3, 0.0, 1.0}, {0, 0, -1}, {1, 0, 0}, 2.0f, 1.0f);
    ShiningLight pictured = whole;
    pictured.light.texture = test::lightTexture(256, 1, [](int x, int) { return glm::vec3(x < 128 ? 1.0f : 0.0f); });
    // The left half is on the side opposite to `along`.
    const ShiningLight left = test::rectangle({-0.2, 0.0, 1.0}, {0, 0, -1}, {1, 0, 0}, 1.0f, 1.0f);
    EXPECT_NEAR(test::factorOf(pictured), test::factorOf(left), 1e-4 * test::factorOf(whole));
    pictured.light.texture = test::lightTexture(1, 256, [](int, int y) { return glm::vec3(y < 128 ? 1.0f : 0.0f); });
    // Vertically: direction x along is -y, the direction of the image's top.
    const ShiningLight top = test::rectangle({0.3, -0.25, 1.0}, {0, 0, -1}, {1, 0, 0}, 2.0f, 0.5f);
    EXPECT_NEAR(test::factorOf(pictured), test::factorOf(top), 1e-4 * test::factorOf(whole));
    const LightSurface surface(pictured, pictured.positionRWS);
    EXPECT_EQ(surface.factorAt(glm::normalize(glm::dvec3(0.3, -0.4, 1.0))), glm::dvec3(1.0));
    EXPECT_EQ(surface.factorAt(glm::normalize(glm::dvec3(0.3, 0.4, 1.0))), glm::dvec3(0.0));
}

/// A triangle in its square; the image is bright outside of one side after the other.
TEST(ReferenceLightPictures, theMeanOfAPolygonsPictureIsOfItsInsideAlone) {
    constexpr int kTexels = 128;
    constexpr double kMargin = 4.0 / kTexels;
    scenes::Light light;
    light.type = LightType::Polygon;
    light.corners = test::cornersOf({{-0.8f, -0.6f}, {0.8f, -0.6f}, {0.0f, 1.0f}}); // 1 m from the middle at most
    const std::array<glm::dvec2, 3> corners{glm::dvec2(-0.8, -0.6), glm::dvec2(0.8, -0.6), glm::dvec2(0.0, 1.0)};
    for (std::size_t side = 0; side < 3; ++side) {
        const glm::dvec2 from = corners[side], along = glm::normalize(corners[(side + 1) % 3] - from);
        light.texture = test::lightTexture(kTexels, kTexels, [&](int x, int y) {
            const glm::dvec2 metres(2.0 * (x + 0.5) / kTexels - 1.0, 1.0 - 2.0 * (y + 0.5) / kTexels);
            const double inside = along.x * (metres.y - from.y) - along.y * (metres.x - from.x);
            return glm::vec3(inside < -kMargin ? 100.0f : 1.0f);
        });
        EXPECT_NEAR(meanFactor(light).g, 1.0, 1e-9) << "side " << side;
    }
}

} // namespace
} // namespace tessera::reference
