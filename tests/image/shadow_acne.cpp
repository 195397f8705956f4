#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ShadowTest.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using test::kAllLightsCast, test::ShadowReference, test::shadowReference, test::WrongPixels, test::wrongPixels;

/// Shadows of maps where nothing hides a surface but its own bias could be too small.
class ShadowAcne : public test::ShadowTest {
protected:
    // Of 1000, 100 and 60 suns for each filter, or of a quarter as many.
    void expectNoneUnderSuns();
    void expectNoneUnderSunsWithASize();
    void expectNoneWithAnyFilter();
};
using ShadowAcneSlow = ShadowAcne;

void ShadowAcne::expectNoneUnderSuns() {
    scenes::Scene scene = test::ballUnderSun();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.shadows = kAllLightsCast;
    settings.shadowFilter = ShadowFilter::Hard;
    settings.shadowMaps.resolutionTexels = 512;
    settings.shadowMaps.cascades = 1;
    const int suns = test::isWholeSweep() ? 1000 : 250;
    const WrongPixels count = test::wrongUnderSuns(renderer, scene, settings, suns);
    fmt::print("{} suns: {} pixels wrong, {} of them dark beside no shadow, of {}\n", suns, count.wrong, count.dark,
               count.covered);
    EXPECT_EQ(count.dark, 0u);
    // Measured: 0.064 %.
    EXPECT_LE(double(count.wrong), 0.0009 * double(count.covered));
}
TEST_F(ShadowAcne, isNotOnASphereAndAPlaneUnderAnySun) {
    expectNoneUnderSuns();
}
TEST_F(ShadowAcneSlow, isNotOnASphereAndAPlaneUnderAnySun) {
    expectNoneUnderSuns();
}

// At 512 texels, of which one is a third of a pixel, more are wrong, since no penumbra is narrower than a texel.
void ShadowAcne::expectNoneUnderSunsWithASize() {
    scenes::Scene scene = test::ballUnderSun();
    scenes::Light& sun = scene.lights[0];
    sun.angularRadiusRadians = float(glm::radians(0.25));
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.shadows = kAllLightsCast;
    settings.shadowMaps.resolutionTexels = 2048;
    settings.shadowMaps.cascades = 1;
    const int directions = test::isWholeSweep() ? 100 : 25;
    WrongPixels count;
    for (int i = 0; i < directions; ++i) {
        sun.directionWS = test::sunDirection(i, directions);
        settings.shadowFilter = ShadowFilter::Traced; // of which the reference knows the noise
        const ShadowReference truth = shadowReference(scene, settings);
        settings.shadowFilter = ShadowFilter::Pcss;
        count += wrongPixels(renderer, settings, truth);
    }
    fmt::print("{} suns, pcss: {} pixels wrong, {} of them dark beside no shadow, of {}\n", directions, count.wrong,
               count.dark, count.covered);
    EXPECT_EQ(count.dark, 0u);
    // Measured: 0.040 %, of a quarter of the suns within three standard deviations of so few independent events.
    const double bound = 0.0005 * double(count.covered);
    EXPECT_LE(double(count.wrong), test::isWholeSweep() ? bound : bound + 3.0 * std::sqrt(bound));
}
TEST_F(ShadowAcne, isNotOnASphereAndAPlaneUnderASunWithASize) {
    expectNoneUnderSunsWithASize();
}
TEST_F(ShadowAcneSlow, isNotOnASphereAndAPlaneUnderASunWithASize) {
    expectNoneUnderSunsWithASize();
}

// Taps of wide filters follow the triangle's plane. The code of this floor's normal is off by 1.03e-3, nearly all of
// FACET_ERROR_RADIANS; on a floor much larger than its first cascade pcss taps a thousand texels along it.
void ShadowAcne::expectNoneWithAnyFilter() {
    scenes::Scene scene = test::ballUnderSun();
    scene.nodes[0].instances = {{1, 0}};
    scenes::Light& sun = scene.lights[0];
    sun.angularRadiusRadians = float(glm::radians(3.0));
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.shadows = kAllLightsCast;
    settings.shadowMaps.resolutionTexels = 2048;
    settings.shadowMaps.widthTexels = 7;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.57834, 0.57749, 0.57622));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(normal.z, 0.0, -normal.x)), across = glm::cross(normal, axis);
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), std::acos(normal.y), axis);
    for (const double scale : {1.0, 10.0}) {
        scene.nodes[0].parentFromNode = glm::scale(turned, glm::dvec3(scale));
        settings.shadowMaps.cascades = scale > 1.0 ? 4 : 1;
        engine::Renderer renderer(context(), scene);
        settings.view = frame::DebugView::Depth;
        const std::vector<float> covered = renderer.render(Technique::Deferred, settings).radiance;
        settings.view = frame::DebugView::Shadow;
        for (const ShadowFilter filter : test::mapFilters()) {
            settings.shadowFilter = filter;
            std::size_t dark = 0;
            // Half of them stand lower than 7.6 degrees above the floor, none lower than 1.
            const int suns = test::isWholeSweep() ? 60 : 15;
            for (int i = 0; i < suns; ++i) {
                const double tilt = std::acos(std::pow(0.0175, (i + 0.5) / suns)), turn = 2.399963229728653 * i;
                sun.directionWS =
                    -std::cos(tilt) * normal + std::sin(tilt) * (std::cos(turn) * axis + std::sin(turn) * across);
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                for (std::size_t k = 0; k < seen.size(); k += 4) dark += covered[k + 3] > 0.0f && !(seen[k] == 1.0f);
            }
            EXPECT_EQ(dark, 0u) << infoOf(filter).name << ", " << scale << " times as large";
        }
    }
}
TEST_F(ShadowAcne, isNotOnAPlaneWithAnyFilter) {
    expectNoneWithAnyFilter();
}
TEST_F(ShadowAcneSlow, isNotOnAPlaneWithAnyFilter) {
    expectNoneWithAnyFilter();
}

// Where two sides of a groove meet, a texel's middle may lie on the other side: that is what the bias is for. Neither
// side hides a sun that is in front of both. Casters are moved away by the width of a texel at most, which is half of
// the slope's components as long as those are 2 together: of sides that a sun meets within 54.7 degrees. A steeper one
// may darken pixels within a texel and the one beside it.
TEST_F(ShadowAcne, isNotInAGrooveButBesideItsSteepSides) {
    scenes::Material material;
    material.model = scenes::MaterialModel::Lambert;
    scenes::Scene scene = test::quadScene(material);
    scene.nodes.push_back(scene.nodes[0]);
    scenes::Camera& camera = scene.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 0.2;
    scene.lights = {test::pointLight({}, 3.0f)};
    scenes::Light& sun = scene.lights[0];
    sun.type = scenes::LightType::Directional;
    frame::FrameSettings settings;
    settings.sizePixels = {96, 54};
    settings.shadows = kAllLightsCast;
    settings.shadowFilter = ShadowFilter::Hard;
    settings.shadowMaps.cascades = 1;
    settings.view = frame::DebugView::Shadow;
    int facing = 0;
    std::size_t dark = 0, all = 0;
    for (const double degrees : {40.0, 65.0}) {
        const double rise = glm::radians(degrees), pixelMetres = 2.0 * camera.halfHeightMetres / 54.0;
        for (const int sign : {-1, 1}) {
            const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), -sign * rise, glm::dvec3(0.0, 1.0, 0.0));
            scene.nodes[sign < 0 ? 0 : 1].parentFromNode = glm::translate(turn, glm::dvec3(sign, 0.0, 0.0));
        }
        engine::Renderer renderer(context(), scene);
        for (const int resolution : {64, 256}) {
            settings.shadowMaps.resolutionTexels = resolution;
            // The ball around the sides has a radius of at most 1.68 m, also in the steps of cascades.
            const double texelMetres = 2.0 * 1.69 / double(resolution - 4);
            for (int i = 0; i < 200; ++i) {
                const double z = 1.0 - (i + 0.5) / 200.0, around = 2.399963229728653 * i,
                             aside = std::sqrt(1.0 - z * z);
                const glm::dvec3 toSun(aside * std::cos(around), aside * std::sin(around), z);
                const double up = toSun.z * std::cos(rise), across = std::abs(toSun.x) * std::sin(rise);
                if (up - across < 0.01) continue; // in front of both sides by 0.6 degrees
                const bool isFaced = up - across > std::sqrt(1.0 / 3.0);
                facing += isFaced;
                sun.directionWS = -toSun;
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                std::size_t wrong = 0, far = 0;
                for (int k = 0; k < 96 * 54; ++k, ++all) {
                    if (seen[4 * std::size_t(k)] == 1.0f) continue;
                    const double x = (k % 96 + 0.5 - 48.0) * pixelMetres;
                    const glm::dvec3 normal = glm::normalize(glm::cross(toSun, glm::dvec3(0.0, 1.0, 0.0)));
                    const double fromCrease = std::abs(glm::dot(normal, {x, 0.0, std::abs(x) * std::tan(rise)}));
                    ++wrong;
                    far += fromCrease > 2.0 * texelMetres;
                }
                EXPECT_EQ(far, 0u) << degrees << " degrees, " << resolution << " texels, sun " << i;
                if (isFaced) {
                    EXPECT_EQ(wrong, 0u) << degrees << " degrees, " << resolution << " texels, sun " << i;
                }
                dark += wrong;
            }
        }
    }
    fmt::print("grooves: {} of {} pixels dark; {} suns face both sides\n", dark, all, facing);
    EXPECT_GE(facing, 20);
    // Measured: 0.092 %.
    EXPECT_LE(double(dark), 0.0014 * double(all));
}

} // namespace
} // namespace tessera
