// More lights than software rasterisers can visit in one loop: no technique loses any.

#include <gmock/gmock.h>

#include "base/Error.h"
#include "renderer/frame/LightRounds.h"
#include "scenes/Limits.h"
#include "tests/image/ImageTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using culling::Builder;
using culling::Method;
using engine::Technique;
using namespace test;

constexpr int kSidePixels = 8;

/// A wall that recedes to the left, so that its pixels lie in several depth bins. Its `count` lights form one run per
/// pixel, each above that pixel. Half of them reach only that pixel, so that bitmasks have empty words, the others all.
/// The last of a run is as bright as the rest of it, so that losing one light shows.
scenes::Scene wallOf(int count) {
    scenes::Material material = lambert();
    scenes::Scene scene = quadScene(material);
    scenes::Camera& camera = scene.cameras[0];
    makeOrthographic(camera, 0.5);
    camera.farMetres = 5.0;
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.nodes[0].parentFromNode[0].z = 0.5;
    constexpr int kPixels = kSidePixels * kSidePixels;
    for (int i = 0; i < count; ++i) {
        const auto runOf = [&](int light) { return int(std::int64_t(light) * kPixels / count); };
        const int pixel = runOf(i);
        const bool last = i + 1 == count || runOf(i + 1) != pixel;
        const double x = (pixel % kSidePixels + 0.5) / kSidePixels - 0.5,
                     y = 0.5 - (pixel / kSidePixels + 0.5) / kSidePixels;
        scenes::Light light = pointLight({x, y, 0.5 * x + 0.05}, last ? 1.0f : float(kPixels) / float(count));
        light.rangeMetres = i % 64 < 32 ? 0.09f : 4.0f;
        scene.lights.push_back(light);
    }
    return scene;
}

class LightRounds : public ImageTest {
protected:
    static frame::FrameSettings settings() {
        frame::FrameSettings result = ofSize(kSidePixels, kSidePixels);
        result.display = false;
        return result;
    }
    /// Compares forward with the reference, and every other technique and method with forward, bit by bit; or a third
    /// of them in turn.
    void expectEveryLight(int count, bool every, std::size_t turn = 0);
    /// Expects the same bits for every number of lights per round.
    void expectOnePicture(const scenes::Scene& scene);
};
using LightRoundsSlow = LightRounds;

void LightRounds::expectEveryLight(int count, bool every, std::size_t turn) {
    SCOPED_TRACE(fmt::format("{} lights, {} a round", count, frame::lightsPerRound(std::size_t(count))));
    const scenes::Scene scene = wallOf(count);
    engine::Renderer renderer(context(), scene);
    const engine::RenderedFrame forward = renderer.render(Technique::Forward, settings());
    const validation::ErrorFigures figures =
        validation::errorFigures(engine::toPicture(forward), validation::referencePicture(scene, settings()).picture);
    EXPECT_EQ(figures.compared, std::size_t(kSidePixels * kSidePixels));
    // An fp32 sum of N terms is off by at most N 2^-24 of itself. The last light of a run is a fifth of its pixel.
    EXPECT_LE(figures.maxRel, std::max(1e-4, count * 0x1p-24));
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        frame::FrameSettings requested = settings();
        for (const Method method : technique.methods) {
            if (!every && turn++ % 3 != 0) continue;
            requested.culling.method = method;
            EXPECT_TRUE(renderer.render(technique.technique, requested).radiance == forward.radiance)
                << technique.name << ", " << infoOf(method).name;
        }
    }
}

/// Counts around those at which the lights per round increase; in a short sweep counts beyond three of them.
TEST_SWEEP(LightRounds, everyLightReachesItsPixelInEveryTechnique) {
    std::vector<int> counts{32769, 65537, 200000};
    if (isWholeSweep()) counts = {32767, 32769, 65535, 65537, 131071, 200000};
    std::size_t turn = 0;
    for (const int count : counts) expectEveryLight(count, isWholeSweep(), turn++);
}

TEST_SWEEP(LightRounds, asManyLightsAsASceneCanHaveReachTheirPixelsInEveryTechnique) {
    expectEveryLight(scenes::kMostLights, isWholeSweep());
}

TEST_F(LightRounds, oneLightMoreThanASceneCanHaveIsRefused) {
    scenes::Scene scene = wallOf(64);
    scene.name = "wall";
    scene.lights.resize(std::size_t(scenes::kMostLights) + 1, scene.lights[0]);
    engine::Renderer renderer(context(), scene);
    EXPECT_THAT(
        [&] { renderer.draw(Technique::Forward, settings()); },
        testing::ThrowsMessage<InputError>("wall: has 262145 lights, and 262144 at most can be drawn; keep fewer "
                                           "of them, or load only the first"));
}

/// Shaders that build lists loop over lights too.
TEST_SWEEP(LightRounds, listsBuiltOnTheGpuNeverLackALight) {
    constexpr int kLanesATile[] = {64, 1};
    std::size_t turn = 0;
    const scenes::Scene scene = wallOf(scenes::kMostLights);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> forward = renderer.render(Technique::Forward, settings()).radiance;
    for (const Method method : {Method::TileMinmax, Method::Tile25d, Method::Cluster, Method::Zbin}) {
        const bool tiled = method == Method::TileMinmax || method == Method::Tile25d;
        for (const int lanes : inTurn(kLanesATile, turn++)) {
            SCOPED_TRACE(fmt::format("{}, {} lanes", infoOf(method).name, lanes));
            frame::FrameSettings requested = settings();
            requested.culling.method = method;
            requested.culling.builder = Builder::Compute;
            requested.culling.lanes = lanes;
            const Technique technique = tiled ? Technique::TiledDeferred : Technique::ClusteredDeferred;
            EXPECT_TRUE(renderer.render(technique, requested).radiance == forward);
        }
    }
}

void LightRounds::expectOnePicture(const scenes::Scene& scene) {
    frame::FrameSettings requested = settings();
    requested.sizePixels = {97, 61};
    std::vector<float> first;
    for (std::size_t perRound = 1; perRound <= frame::kMostLightsPerRound; perRound *= 2) {
        const ShaderMutant shaders;
        for (const char* file : {"lib/lighting/lighting.glsl", "lib/light/light_cursor.glsl"})
            shaders.replace(file, "LIGHTS_PER_ROUND", std::to_string(perRound));
        engine::Renderer renderer(context(), scene, shaders.tree());
        for (const auto& [technique, method] :
             {std::pair(Technique::Forward, Method::None), std::pair(Technique::ClusteredForward, Method::Cluster),
              std::pair(Technique::ClusteredDeferred, Method::Zbin)}) {
            SCOPED_TRACE(fmt::format("{}, {} lights a round", infoOf(technique).name, perRound));
            requested.culling = {};
            if (method != Method::None) requested.culling.method = method;
            const std::vector<float> picture = renderer.render(technique, requested).radiance;
            if (first.empty()) first = picture;
            EXPECT_TRUE(picture == first);
        }
    }
}

TEST_F(LightRounds, thePictureNeverDependsOnHowManyLightsARoundVisits) {
    scenes::LoadOptions options;
    options.lights = 257;
    expectOnePicture(scenes::loadScene("lattice", options));
}

TEST_F(LightRoundsSlow, aPictureOfEveryFeatureNeverDependsOnHowManyLightsARoundVisits) {
    expectOnePicture(everythingScene());
}

} // namespace
} // namespace tessera
