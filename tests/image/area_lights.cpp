// Area lights: parity of techniques, pruning without them, and what compare judges.

#include <gmock/gmock.h>

#include "engine/PrepareView.h"
#include "renderer/graph/Plan.h"
#include "tests/image/AreaLightTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using namespace test;

class AreaLights : public ShadowTest {};
using AreaLightsSlow = AreaLights;

TEST_SWEEP(AreaLights, everyTechniqueGivesTheSamePictureToTheLastBit) {
    struct Case {
        scenes::Scene scene;
        int samples;
        scenes::ShadowRequest shadows;
        std::vector<Technique> techniques; ///< besides forward; empty: all
        frame::AreaLights how = frame::AreaLights::Ltc;
    };
    // Nearly all of the time is compilation, and programs of one matte material compile fastest.
    scenes::Scene few = withAreaLights(quadScene(twoSided(lambert())));
    few.nodes.push_back(few.nodes[0]); // in front of the first: at half a metre, a third as large, and turned
    few.nodes.back().parentFromNode = {glm::dvec4(0.3, 0.0, 0.1, 0.0), glm::dvec4(0.0, 0.3, 0.0, 0.0),
                                       glm::dvec4(-0.1, 0.0, 0.3, 0.0), glm::dvec4(0.2, 0.1, 0.5, 1.0)};
    constexpr frame::AreaLights kSampled = frame::AreaLights::Sampled;
    std::vector<Case> cases{{few, 1, {}, techniquesInTurn(0)},
                            {few, 1, {}, {Technique::ClusteredDeferred, Technique::DeferredVolumes}, kSampled},
                            {few, 1, kAllLightsCast, techniquesInTurn(1)},
                            {few, 4, {}, {Technique::ForwardPlus}},
                            {withAreaLights(evenScene()), 1, {}, {Technique::TiledDeferred}}};
    if (isWholeSweep()) {
        cases = {{withAreaLights(evenScene()), 1, {}, {}},
                 {withAreaLights(everythingScene()), 1, {}, {Technique::TiledDeferred, Technique::ClusteredForward}},
                 {withAreaLights(evenScene()), 1, kAllLightsCast, {Technique::DeferredVolumes, Technique::ForwardPlus}},
                 {withAreaLights(quadScene({})), 4, {}, {}},
                 {withAreaLights(evenScene()), 1, {}, {}, kSampled},
                 {withAreaLights(everythingScene()), 1, {}, {Technique::TiledDeferred}, kSampled},
                 {withAreaLights(quadScene({})), 1, kAllLightsCast, {}, kSampled},
                 {withAreaLights(quadScene({})), 4, {}, {}, kSampled}};
    }
    for (const Case& one : cases) {
        SCOPED_TRACE(fmt::format("{}, {} samples", one.scene.name, one.samples));
        engine::Renderer renderer(context(), one.scene);
        frame::FrameSettings settings = withDiffusion(withSamples(ofSize(96, 54), one.samples));
        settings.shadows = one.shadows;
        settings.area = {one.how, 4};
        expectParity(renderer, settings, one.techniques);
    }
}

/// Each type with a technique that has light lists, or with Deferred, whose programs other tests share.
TEST_SWEEP(AreaLights, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    const Technique technique = isWholeSweep() ? Technique::TiledDeferred : Technique::Deferred;
    scenes::Scene scene = quadScene({});
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        scene.lights = {areaLight(type, {0.3, 0.2, 1.5}, {0.0, 0.0, -1.0}, 3.0f)};
        frame::FrameSettings settings = ofSize(96, 54);
        // Unpruned programs with area samples take long to compile.
        settings.area = {
            isWholeSweep() && type != LightType::Disk ? frame::AreaLights::Sampled : frame::AreaLights::Ltc, 4};
        engine::Renderer renderer(context(), scene);
        expectPruningIsUnseen(renderer, settings, technique);
    }
}

TEST_F(AreaLights, aSceneWithoutThemHasNoTraceOfThem) {
    const scenes::Scene scene = scenes::loadScene("spheres");
    EXPECT_THAT(definedValues(scene, "HAS_AREA_LIGHTS"), testing::Each("0"));
    const graph::Plan plan = engine::planFrame(scene, Technique::Deferred, {});
    EXPECT_EQ(planText(plan).find("lobe_"), std::string::npos) << planText(plan);
}

/// A quarter of the pixels of 1280x720, where tiles are coarser relative to the image.
TEST_F(AreaLightsSlow, aThousandRectanglesTakeATenthOfTheTimeByTheirListsThatTheyTakeOverAll) {
    const scenes::Scene lamps = scenes::loadScene("lamps");
    engine::Renderer renderer(context(), lamps);
    renderer.backend().setProfiling(true);
    const auto msOf = [&](Technique technique, const std::vector<glm::ivec2>& sizes) {
        double least = 0.0;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            frame::FrameSettings settings;
            settings.sizePixels = sizes[i];
            renderer.render(technique, settings);
            double ms = 0.0;
            for (const gpu::PassTiming& timing : renderer.backend().passTimings())
                ms += timing.gpuMs.value_or(timing.cpuMs);
            if (i > 0) least = i > 1 ? std::min(least, ms) : ms; // the first frame compiles
        }
        return least;
    };
    constexpr glm::ivec2 kSmall(32, 18), kSize(640, 360);
    const double listsMs = msOf(Technique::ClusteredDeferred, {kSize, kSize, kSize, kSize});
    const double allMs = msOf(Technique::Forward, {kSmall, kSize});
    fmt::print("lamps: clustered_deferred {:.0f} ms, forward {:.0f} ms\n", listsMs, allMs);
    EXPECT_GE(allMs, 10.0 * listsMs);
}

/// An area light that is off, or excluded by soloLight, does not prevent judging.
TEST(AreaLightsJudged, areThoseThatShine) {
    scenes::Scene scene = quadScene(lambert());
    scene.lights = {areaLight(LightType::Disk, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 1.0f), scenes::Light()};
    frame::FrameSettings settings;
    const auto isJudged = [&] { return validation::referenceTolerance(scene, settings).relMse.has_value(); };
    EXPECT_FALSE(isJudged());
    settings.soloLight = 1;
    EXPECT_TRUE(isJudged());
    settings.soloLight = 0;
    EXPECT_FALSE(isJudged());
    settings.soloLight.reset();
    scene.lights[0].enabled = false;
    EXPECT_TRUE(isJudged());
}

} // namespace
} // namespace tessera
