#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"
#include "tests/support/Sweep.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using test::kAllLightsCast, test::ShadowReference, test::shadowReference, test::wrongPixels;

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

class ShadowFaults : public test::ShadowTest {
protected:
    /// Pixels that are wrong in a picture of point lights and a sun.
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
        // Softened, no surface that faces away from a light by its triangle alone is behind it.
        settings.shadowTerminator = frame::ShadowTerminator::Exact;
        settings.shadows = kAllLightsCast;
        settings.filter = frame::TextureFilter::Exact;
        truth.emplace(shadowReference(scene, settings));
        settings.shadowFilter = ShadowFilter::Hard;
        settings.shadowMaps.resolutionTexels = 1024;
        settings.shadowMaps.budgetMiB = 1024.0;
    }
    /// Every fault, or every third.
    void expectDetected();

    scenes::Scene scene;
    frame::FrameSettings settings;
    std::optional<ShadowReference> truth;
};
using ShadowFaultsSlow = ShadowFaults;

// Held to the traced shares of a lamp before a plate: what no mean of casters' depths may be divided by.
TEST_F(ShadowFaults, meansOfNoCasterOrOfCastersEverywhereAreDetected) {
    const scenes::Scene plate = scenes::loadScene("shadow_truth");
    frame::FrameSettings shares;
    shares.sizePixels = {160, 90};
    shares.view = frame::DebugView::Shadow;
    shares.soloLight = 0;
    shares.shadowSamples = 16;
    shares.shadowMaps.resolutionTexels = 512;
    const auto sharesOf = [&](ShadowFilter filter, const shader::SourceTree& shaders) {
        engine::Renderer renderer(context(), plate, shaders);
        shares.shadowFilter = filter;
        return renderer.render(Technique::Deferred, shares).radiance;
    };
    const std::vector<float> traced = sharesOf(ShadowFilter::Traced, test::ShaderMutant().tree());
    const auto wrongShares = [&](const shader::SourceTree& shaders) {
        const std::vector<float> looked = sharesOf(ShadowFilter::Pcss, shaders);
        std::size_t wrong = 0;
        // A quarter is five deviations of 16 samples.
        for (std::size_t i = 0; i < looked.size(); i += 4) wrong += !(std::abs(looked[i] - traced[i]) < 0.25f);
        return wrong;
    };
    const std::size_t right = wrongShares(test::ShaderMutant().tree());
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
        const test::ShaderMutant shaders;
        shaders.replace("lib/shadow/shadow_map.glsl", from, to);
        const std::size_t wrong = wrongShares(shaders.tree());
        fmt::print("{:<45} {} shares wrong\n", fault, wrong);
        EXPECT_GT(wrong, 2 * right + 15) << fault;
    }
}

void ShadowFaults::expectDetected() {
    const std::size_t right = wrongIn(test::ShaderMutant().tree());
    fmt::print("without a fault {} pixels wrong\n", right);
    for (const MapFault& fault : kMapFaults) {
        if (!test::isWholeSweep() && (&fault - kMapFaults) % 3 != 0) continue;
        const test::ShaderMutant shaders;
        shaders.replace(fault.file, fault.from, fault.to);
        const std::size_t wrong = wrongIn(shaders.tree());
        fmt::print("{:<45} {} pixels wrong\n", fault.fault, wrong);
        EXPECT_GT(wrong, right + 15) << fault.fault;
    }
}
TEST_F(ShadowFaults, eachIsDetectedByTheReference) {
    expectDetected();
}
TEST_F(ShadowFaultsSlow, eachIsDetectedByTheReference) {
    expectDetected();
}

} // namespace
} // namespace tessera
