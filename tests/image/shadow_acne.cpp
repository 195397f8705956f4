#include <tuple>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using namespace test;

/// Mapped shadows on surfaces that nothing hides, where a bias could be too small.
class ShadowAcne : public ShadowTest {};

TEST_SWEEP(ShadowAcne, isNotOnASphereAndAPlaneUnderAnySun) {
    scenes::Scene scene = ballUnderSun();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(64, 36), ShadowFilter::Hard);
    settings.shadowMaps.resolutionTexels = 512;
    settings.shadowMaps.cascades = 1;
    const int suns = isWholeSweep() ? 1000 : 250;
    const WrongPixels count = wrongUnderSuns(renderer, scene, settings, suns);
    fmt::print("{} suns: {}\n", suns, count.text());
    EXPECT_EQ(count.dark, 0u);
    // Measured: 0.064 %.
    EXPECT_LE(double(count.wrong), 0.0009 * double(count.covered));
}

// At 512 texels, each a third of a pixel, more are wrong, since no penumbra is narrower than a texel.
TEST_SWEEP(ShadowAcne, isNotOnASphereAndAPlaneUnderASunWithASize) {
    scenes::Scene scene = ballUnderSun();
    scenes::Light& sun = scene.lights[0];
    sun.angularRadiusRadians = float(glm::radians(0.25));
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(64, 36));
    settings.shadowMaps.resolutionTexels = 2048;
    settings.shadowMaps.cascades = 1;
    const int directions = isWholeSweep() ? 100 : 25;
    WrongPixels count;
    for (int i = 0; i < directions; ++i) {
        sun.directionWS = sunDirection(i, directions);
        settings.shadowFilter = ShadowFilter::Traced; // whose noise the reference allows for
        const ShadowReference truth = shadowReference(scene, settings);
        settings.shadowFilter = ShadowFilter::Pcss;
        count += wrongPixels(renderer, settings, truth);
    }
    fmt::print("{} suns, pcss: {}\n", directions, count.text());
    EXPECT_EQ(count.dark, 0u);
    // Measured: 0.040 %; with a quarter of the suns within three standard deviations of so few independent events.
    const double bound = 0.0005 * double(count.covered);
    EXPECT_LE(double(count.wrong), isWholeSweep() ? bound : bound + 3.0 * std::sqrt(bound));
}

// Taps of wide filters follow the triangle's plane. This floor's stored normal is off by 1.03e-3, nearly all of
// FACET_ERROR_RADIANS; on a floor much larger than its first cascade pcss taps a thousand texels along it.
TEST_SWEEP(ShadowAcne, isNotOnAPlaneWithAnyFilter) {
    scenes::Scene scene = ballUnderSun();
    scene.nodes[0].instances = {{1, 0}};
    scenes::Light& sun = scene.lights[0];
    sun.angularRadiusRadians = float(glm::radians(3.0));
    frame::FrameSettings settings = withShadows(ofSize(64, 36));
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
        for (const ShadowFilter filter : mapFilters()) {
            settings.shadowFilter = filter;
            std::size_t dark = 0;
            // Half of the suns stand lower than 7.6 degrees above the floor, none lower than 1.
            const int suns = isWholeSweep() ? 60 : 15;
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

// Where two sides of a groove meet, a texel's centre may lie on the other side, which the bias compensates. Neither
// side hides a sun that is in front of both. Casters are moved away by the width of a texel at most, which is half of
// the slope's components as long as those are 2 together: for sides that a sun meets within 54.7 degrees. A steeper one
// may darken pixels within a texel and the one beside it.
TEST_F(ShadowAcne, isNotInAGrooveButBesideItsSteepSides) {
    scenes::Material material = lambert();
    scenes::Scene scene = quadScene(material);
    scene.nodes.push_back(scene.nodes[0]);
    scenes::Camera& camera = scene.cameras[0];
    makeOrthographic(camera, 0.2);
    scene.lights = {pointLight({}, 3.0f)};
    scenes::Light& sun = scene.lights[0];
    sun.type = scenes::LightType::Directional;
    frame::FrameSettings settings = withView(withShadows(ofSize(96, 54), ShadowFilter::Hard), frame::DebugView::Shadow);
    settings.shadowMaps.cascades = 1;
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
            // The bounding sphere of the sides has a radius of at most 1.68 m, also in the size steps of cascades.
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

struct MapFault {
    const char* fault;
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
};
constexpr MapFault kMapFaults[] = {
    {"no bias", "lib/shadow/shadow_map.glsl", "point.bias = rounding;",
     "point.bias = 0.0; point.slope = point.doubt = steepest = vec2(0.0);"},
    {"cascades swapped", "lib/shadow/shadow_map.glsl", "SHADOW_FACE_TEXELS * i;", "SHADOW_FACE_TEXELS * (3 - i);"},
    {"another face of the cube", "lib/shadow/shadow_map.glsl", "2 * axis + (fromLight[axis] < 0.0 ? 1 : 0)",
     "2 * axis + (fromLight[axis] < 0.0 ? 0 : 1)"},
    {"the comparison the other way round", "lib/shadow/shadow_map.glsl", "return isHidden ? 0.0 : 1.0;",
     "return isHidden ? 1.0 : 0.0;"},
    {"y upside down in the atlas", "lib/shadow/shadow_map.glsl",
     "point.texel = place.xy + (place.z * perMetre) * position.xy;",
     "point.texel = place.xy + (place.z * perMetre) * position.xy * vec2(1.0, -1.0);"},
    {"lights behind a surface", "lib/shadow/shadow_map.glsl", "isBehind ? 0.0 :", "false ? 0.0 :"},
    {"another plane of the receiver", "passes/geometry.vert", "facetNormalLS = turnedFacet;",
     "facetNormalLS = turnedFacet.yzx;"},
};

class ShadowFaults : public ShadowTest {
protected:
    /// Wrong pixels in an image of point lights and a sun.
    std::size_t wrongIn(const shader::SourceTree& shaders) {
        engine::Renderer renderer(context(), scene, shaders);
        return wrongPixels(renderer, settings, *truth).wrong;
    }
    void SetUp() override {
        scenes::LoadOptions options;
        options.lights = 6;
        scene = scenes::loadScene("lattice", options);
        scenes::Light sun = scene.lights[0];
        sun.type = scenes::LightType::Directional;
        sun.directionWS = glm::normalize(glm::dvec3(-0.5, -1.0, -0.3));
        sun.intensity = 1.0f;
        scene.lights.push_back(sun);
        settings.sizePixels = {200, 112};
        // Softened terminators would not treat a surface as facing away by its triangle alone.
        settings.shadowTerminator = frame::ShadowTerminator::Exact;
        settings.shadows = kAllLightsCast;
        settings.filter = frame::TextureFilter::Exact;
        truth.emplace(shadowReference(scene, settings));
        settings.shadowFilter = ShadowFilter::Hard;
        settings.shadowMaps.resolutionTexels = 1024;
        settings.shadowMaps.budgetMiB = 1024.0;
    }

    scenes::Scene scene;
    frame::FrameSettings settings;
    std::optional<ShadowReference> truth;
};

// Against the traced visibility of a lamp before a plate: caster counts for which pcss must not take a mean depth.
TEST_F(ShadowFaults, meansOfNoCasterOrOfCastersEverywhereAreDetected) {
    const scenes::Scene plate = scenes::loadScene("shadow_truth");
    frame::FrameSettings shares = withView(ofSize(160, 90), frame::DebugView::Shadow);
    shares.soloLight = 0;
    shares.shadowSamples = 16;
    shares.shadowMaps.resolutionTexels = 512;
    const auto sharesOf = [&](ShadowFilter filter, const shader::SourceTree& shaders) {
        shares.shadowFilter = filter;
        return drawn(plate, shares, Technique::Deferred, shaders);
    };
    const std::vector<float> traced = sharesOf(ShadowFilter::Traced, ShaderMutant().tree());
    const auto wrongShares = [&](const shader::SourceTree& shaders) {
        const std::vector<float> looked = sharesOf(ShadowFilter::Pcss, shaders);
        std::size_t wrong = 0;
        // A quarter is five standard deviations of 16 samples.
        for (std::size_t i = 0; i < looked.size(); i += 4) wrong += !(std::abs(looked[i] - traced[i]) < 0.25f);
        return wrong;
    };
    const std::size_t right = wrongShares(ShaderMutant().tree());
    fmt::print("without a fault {} shares wrong\n", right);
    const char* const kNone = "if (hidden == 0.0) return 1.0;";
    const char* const kAll = "if (hidden == float(SHADOW_SAMPLES)) return 0.0;";
    const std::tuple<const char*, const char*, const char*> faults[] = {
        {"no caster hides the light", kNone, "if (hidden == 0.0) return 0.0;"},
        {"a mean of no casters", kNone, "if (hidden == 0.0) return depths / hidden;"},
        {"casters everywhere hide nothing", kAll, "if (hidden == float(SHADOW_SAMPLES)) return 1.0;"},
        {"a mean of one caster too few", "depths / hidden", "depths / (hidden - 1.0)"},
    };
    for (const auto& [fault, from, to] : faults) {
        const ShaderMutant shaders("lib/shadow/shadow_map.glsl", from, to);
        const std::size_t wrong = wrongShares(shaders.tree());
        fmt::print("{:<45} {} shares wrong\n", fault, wrong);
        EXPECT_GT(wrong, 2 * right + 15) << fault;
    }
}

TEST_SWEEP(ShadowFaults, eachIsDetectedByTheReference) {
    const std::size_t right = wrongIn(ShaderMutant().tree());
    fmt::print("without a fault {} pixels wrong\n", right);
    for (const MapFault& fault : kMapFaults) {
        if (!isWholeSweep() && (&fault - kMapFaults) % 3 != 0) continue;
        const ShaderMutant shaders(fault.file, fault.from, fault.to);
        const std::size_t wrong = wrongIn(shaders.tree());
        fmt::print("{:<45} {} pixels wrong\n", fault.fault, wrong);
        EXPECT_GT(wrong, right + 15) << fault.fault;
    }
}

} // namespace
} // namespace tessera
