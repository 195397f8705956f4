// The reference's integral over a sphere, compared with the closed form of the roughest lobe.
#include "tests/support/RoughestLobe.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "scenes/AreaLight.h"
#include "validation/reference/AreaLights.h"

namespace tessera::reference {
namespace {

TEST(ReferenceAreaLights, aSphereFillsOfTheRoughestLobeWhatItsClosedFormSays) {
    SurfacePoint metal;
    metal.model = scenes::MaterialModel::MetallicRoughness;
    metal.color = glm::dvec3(1.0);
    metal.metallic = 1.0;
    metal.normal = {0.0, 0.0, 1.0};
    ShiningLight sphere;
    sphere.light.type = scenes::LightType::Sphere;
    sphere.light.radiusMetres = 0.5f;
    sphere.color = glm::dvec3(1.0);
    sphere.rangeMetres = double(scenes::kInfinity);
    for (const double cosView : {1.0, 0.5, 0.1736, 0.01})
        for (const auto& [axis, halfAngle] :
             {std::pair(0.0, 0.1), {0.0, 0.6}, {0.0, 1.3}, {1.0, 0.01}, {1.0, 0.2}, {1.0, 0.5}})
            for (const double turn : {0.0, 2.0}) { // about the normal, which changes nothing
                sphere.positionRWS =
                    0.5 / std::sin(halfAngle) *
                    glm::dvec3(std::sin(axis) * std::cos(turn), std::sin(axis) * std::sin(turn), std::cos(axis));
                const glm::dvec3 toViewer(std::sqrt(1.0 - cosView * cosView), 0.0, cosView);
                const double shown =
                    reflectedOf(sphere, metal, glm::dvec3(0.0), toViewer, true, false, Settings()).light.g;
                // Rules that differ by Settings::areaTolerance are a few times 1e-6 wrong.
                EXPECT_NEAR(shown, test::roughestShareOfCap(cosView, axis, halfAngle), 1e-5)
                    << "viewer's cosine " << cosView << ", " << halfAngle << " around " << axis << ", turned by "
                    << turn;
            }
}

} // namespace
} // namespace tessera::reference
