// Light culling: conservative, tight, and without an effect on the image.
#include <array>
#include <span>

#include "tests/image/ImageTest.h"
#include "tests/support/CullingScenes.h"
#include "tests/support/Random.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/culling/LightOracle.h"

namespace tessera {
namespace {

using culling::Method;
using engine::Technique;
using validation::LightOracleFigures;
using namespace test;

constexpr Method kMethods[] = {Method::TileMinmax, Method::Tile25d, Method::Cluster, Method::Zbin};

Technique deferredWith(Method method) {
    return method == Method::TileMinmax || method == Method::Tile25d ? Technique::TiledDeferred
                                                                     : Technique::ClusteredDeferred;
}
Technique forwardWith(Method method) {
    return method == Method::TileMinmax || method == Method::Tile25d ? Technique::ForwardPlus
                                                                     : Technique::ClusteredForward;
}

scenes::Scene lattice(int lights) {
    return latticeOf(lights);
}

class LightCulling : public ImageTest {
protected:
    static frame::FrameSettings settings(glm::ivec2 sizePixels, Method method = Method::None, int tilePixels = 16) {
        frame::FrameSettings result = ofSize(sizePixels);
        if (method == Method::None) return result;
        result.culling.method = method;
        result.culling.tilePixels = tilePixels;
        return result;
    }

    static void expectSound(const LightOracleFigures& figures) {
        EXPECT_EQ(figures.falseNegatives, 0u)
            << "first at pixel " << figures.firstMissing.value_or(LightOracleFigures::Pair{}).x << ", "
            << figures.firstMissing.value_or(LightOracleFigures::Pair{}).y << ", light "
            << figures.firstMissing.value_or(LightOracleFigures::Pair{}).light;
    }

    LightOracleFigures judge(engine::Renderer& renderer, Method method, int tilePixels, glm::ivec2 sizePixels) {
        frame::FrameSettings requested = settings(sizePixels, method, tilePixels);
        requested.culling.normals = culling::NormalTest::Off; // LightNormals judges lists by normals
        const LightOracleFigures figures = validation::judgeLights(renderer, deferredWith(method), requested);
        expectSound(figures);
        fmt::print("{:<22} {:<12} tile {:>2}: visited {:6.2f} p99 {:4} max {:4}, tightness {:.3f} (lit {:.3f}), {} "
                   "entries, {} cells, {:.2f} MB\n",
                   renderer.scene().name, infoOf(method).name, tilePixels,
                   figures.perPixel(figures.evaluated + figures.everywhere), figures.evaluatedP99, figures.evaluatedMax,
                   figures.tightness().value_or(0.0), figures.litTightness().value_or(0.0), figures.entries,
                   figures.cells, double(figures.listBytes) * 1e-6);
        return figures;
    }

    struct Seen {
        std::uint64_t needed = 0, evaluated = 0, covered = 0;
        void operator+=(const Seen& more) {
            needed += more.needed;
            evaluated += more.evaluated;
            covered += more.covered;
        }
    };
    /// Expects every method to miss no light, and to give the image of forward.
    Seen expectSoundScene(scenes::Scene scene, std::uint64_t seed);

    void expectForwardsPicture(const scenes::Scene& scene, glm::ivec2 sizePixels, std::span<const int> tiles);
};
using LightCullingSlow = LightCulling;

TEST_F(LightCulling, theOracleCountsTheLatticeExactlyAsAnIndependentAnalyticCountDoes) {
    const scenes::Scene scene = lattice(1024);
    engine::Renderer renderer(context(), scene);
    const LightOracleFigures figures = judge(renderer, Method::Cluster, 16, {1280, 720});
    // Half a percent: tessellated spheres have other silhouettes than true ones.
    EXPECT_NEAR(double(figures.covered) / (1280.0 * 720.0), 0.816, 0.005 * 0.816);
    EXPECT_NEAR(figures.perPixel(figures.needed), 38.92, 0.005 * 38.92);
    EXPECT_NEAR(figures.perPixel(figures.neededLit), 29.37, 0.005 * 29.37);
    EXPECT_LE(*figures.tightness(), 1.25);
}

TEST_F(LightCulling, listsAreTightOnTheLattice) {
    const scenes::Scene scene = lattice(1024);
    engine::Renderer renderer(context(), scene);
    EXPECT_LE(*judge(renderer, Method::TileMinmax, 16, {1280, 720}).tightness(), 1.40);
    EXPECT_LE(*judge(renderer, Method::Cluster, 8, {1280, 720}).tightness(), 1.15);
}

// LightTable covers every method in smaller images.
TEST_F(LightCullingSlow, everyMethodIsSoundInLargePictures) {
    const scenes::Scene scene = lattice(1024), hall = scenes::loadScene("hall");
    engine::Renderer renderer(context(), scene), hallRenderer(context(), hall);
    for (const Method method : kMethods) {
        judge(renderer, method, 16, {1280, 720});
        judge(hallRenderer, method, 16, {640, 360});
    }
}

TEST_F(LightCulling, depthSlicesPayWhereDepthHasDeepGaps) {
    const scenes::Scene scene = columnsBeforeWall(1500);
    engine::Renderer renderer(context(), scene);
    const auto evaluated = [&](Method method) { return double(judge(renderer, method, 16, {640, 360}).evaluated); };
    const double minmax = evaluated(Method::TileMinmax);
    EXPECT_GE(minmax / evaluated(Method::Tile25d), 1.5);
    EXPECT_GE(minmax / evaluated(Method::Cluster), 1.5);
}

TEST_F(LightCulling, theOracleNoticesALightThatAListLacksOrHasTooMuch) {
    const scenes::Scene scene = lattice(64);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings requested = settings({160, 90}, Method::TileMinmax);
    requested.culling.normals = culling::NormalTest::Off; // judged without normals
    renderer.draw(Technique::TiledDeferred, requested);
    engine::DrawnLists drawn = renderer.downloadLists();
    const std::vector<float> depth = renderer.downloadDepth();
    const auto judged = [&] { return validation::judgeLights({scene, requested, drawn, depth, {}}); };
    const LightOracleFigures good = judged();
    EXPECT_EQ(good.falseNegatives, 0u);
    ASSERT_GT(good.needed, 0u);
    // Removes one cell's lights one by one: a removed light that some pixel of the tile needs is missed.
    std::uint64_t missed = 0;
    glm::uvec2& cell = drawn.lists.cells.at(drawn.lists.cells.size() / 2);
    ASSERT_GT(cell.y, 0u);
    while (cell.y > 0) {
        --cell.y;
        missed = judged().falseNegatives;
    }
    EXPECT_GT(missed, 0u);
    EXPECT_LT(judged().evaluated, good.evaluated);
}

/// The scene for tests of its lists. A short sweep adds lights of every kind, so that all scenes share programs, which
/// are few and small where frames are pruned.
scenes::Scene asTriedInSweep(scenes::Scene scene) {
    return isWholeSweep() ? scene : withEveryKindOfLight(std::move(scene));
}

LightCulling::Seen LightCulling::expectSoundScene(scenes::Scene scene, std::uint64_t seed) {
    constexpr glm::ivec2 kSizes[] = {{97, 61}, {33, 17}, {1, 1}, {8, 3}, {64, 64}, {130, 5}};
    scene = asTriedInSweep(std::move(scene));
    Seen seen;
    Random random(seed + 1000);
    engine::Renderer renderer(context(), scene);
    const glm::ivec2 size = kSizes[random.index(int(std::size(kSizes)))];
    frame::FrameSettings truthSettings = settings(size);
    // Without pruning all scenes share their programs, though these are large.
    truthSettings.prune = !isWholeSweep() || seed % 4 == 0;
    const std::vector<float> truth = renderer.render(Technique::Forward, truthSettings).radiance;
    for (const Method method : kMethods) {
        const int tile = culling::kTileSides[random.index(4)];
        SCOPED_TRACE(fmt::format("seed {} {} tile {} {}x{}", seed, infoOf(method).name, tile, size.x, size.y));
        frame::FrameSettings requested = settings(size, method, tile);
        requested.prune = truthSettings.prune;
        requested.culling.normals = culling::NormalTest::Off; // LightNormals covers them
        requested.culling.builder = culling::builderTable()[std::size_t(random.index(3))].builder;
        const Technique technique = random.unit() < 0.5 ? deferredWith(method) : forwardWith(method);
        EXPECT_EQ(renderer.render(technique, requested).radiance, truth);
        const engine::DrawnLists drawn = renderer.downloadLists();
        const std::vector<float> depth = renderer.downloadDepth();
        const LightOracleFigures figures = validation::judgeLights({scene, requested, drawn, depth, {}});
        expectSound(figures);
        seen.needed += figures.needed;
        seen.evaluated += figures.evaluated;
        seen.covered += figures.covered;
    }
    return seen;
}

// A short sweep takes few of the scenes, with pruning.
TEST_SWEEP_AS(LightCulling, noLightIsEverMissingFromRandomScenesAndNoPixelDiffers, LightCullingSlow,
              noLightIsMissingFromTwoHundredRandomScenesAndNoPixelDiffers) {
    Seen all;
    const std::uint64_t scenes = isWholeSweep() ? 200 : 10;
    for (std::uint64_t seed = 1; seed <= scenes && !HasFailure(); ++seed)
        all += expectSoundScene(randomLitScene(seed), seed);
    fmt::print("{} scenes: {} covered pixels, {} pairs needed, {} visited\n", scenes, all.covered, all.needed,
               all.evaluated);
    EXPECT_GT(all.needed, 500u * scenes) << "scenes that need nothing prove nothing";
}

TEST_SWEEP(LightCulling, noLightIsMissingWhereAScenesEyeIsFarAwayAndNoPixelDiffers) {
    Seen all;
    const std::uint64_t scenes = isWholeSweep() ? 80 : 6;
    for (std::uint64_t seed = 1; seed <= scenes && !HasFailure(); ++seed) {
        scenes::Scene scene = randomLitScene(seed);
        const double times = std::pow(10.0, double(1 + seed % 6));
        scene.cameras[0] = seenFromAfar(scene.cameras[0], times);
        SCOPED_TRACE(fmt::format("from {:g} times as far", times));
        all += expectSoundScene(scene, seed);
    }
    fmt::print("{} scenes: {} covered pixels, {} pairs needed, {} visited\n", scenes, all.covered, all.needed,
               all.evaluated);
    EXPECT_GT(all.needed, 375u * scenes) << "scenes that need nothing prove nothing";
    // With a near eye the same kind of scene visits 1.9 times what it needs.
    EXPECT_LT(double(all.evaluated), 3.0 * double(all.needed)) << "margins that grow with the eye's distance";
}

/// Compares every method of every technique with forward, at every tile size of `tiles`.
void LightCulling::expectForwardsPicture(const scenes::Scene& scene, glm::ivec2 sizePixels,
                                         std::span<const int> tiles) {
    engine::Renderer renderer(context(), scene);
    const Picture truth = engine::toPicture(renderer.render(Technique::Forward, settings(sizePixels)));
    for (const engine::TechniqueInfo& technique : engine::techniqueTable())
        for (const Method method : technique.methods) {
            if (method == Method::None) continue;
            for (const int tile : tiles) {
                SCOPED_TRACE(fmt::format("{}, {} lights, {}, {} {}, {}x{}", scene.name, scene.lights.size(),
                                         technique.name, infoOf(method).name, tile, sizePixels.x, sizePixels.y));
                const Picture picture =
                    engine::toPicture(renderer.render(technique.technique, settings(sizePixels, method, tile)));
                const validation::ErrorFigures figures = validation::errorFigures(picture, truth);
                EXPECT_EQ(figures.bitEqual, 1.0);
                EXPECT_EQ(figures.bad.sum() + figures.badOutside.sum(), 0u);
                EXPECT_GT(figures.litShare, 0.0);
            }
        }
}

constexpr glm::ivec2 kEven{640, 360}, kOdd{641, 359};

/// Counts of lights that fill words and tiles evenly and not. A short sweep has a sixteenth of the pixels.
TEST_SWEEP(LightCulling, everyMethodGivesExactlyForwardsPictureAtEveryCountOfLights) {
    const glm::ivec2 even = isWholeSweep() ? kEven : glm::ivec2(160, 90);
    const glm::ivec2 odd = isWholeSweep() ? kOdd : glm::ivec2(161, 89);
    bool isOdd = false;
    for (const int count : everyNth(std::vector{1, 31, 32, 33, 255, 256, 257}, 2))
        expectForwardsPicture(lattice(count), (isOdd = !isOdd) ? odd : even, std::array{16});
    // Forward is slow; the odd size is the harder one.
    expectForwardsPicture(lattice(1024), odd, std::array{16});
    expectForwardsPicture(scenes::loadScene("hall"), odd, std::array{16});
}

TEST_SWEEP(LightCulling, everyTileGivesExactlyForwardsPicture) {
    expectForwardsPicture(lattice(257), isWholeSweep() ? kOdd : glm::ivec2(161, 89), culling::kTileSides);
}

/// Parameters: the number of lights of `lattice`, or 0 for `hall`, and the image size.
class LightCullingOfThousandsSlow : public LightCulling,
                                    public testing::WithParamInterface<std::tuple<int, glm::ivec2>> {};

TEST_P(LightCullingOfThousandsSlow, thousandsOfLightsGiveExactlyForwardsPictureWithEveryMethodAndTile) {
    const auto& [lights, size] = GetParam();
    expectForwardsPicture(lights > 0 ? lattice(lights) : scenes::loadScene("hall"), size, culling::kTileSides);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightCullingOfThousandsSlow,
                         testing::Combine(testing::Values(1024, 4097, 0), testing::Values(kEven, kOdd)));

/// The scene with all of its opaque instances and one transparent instance, made opaque; `which` counts from 0. None if
/// there are fewer transparent instances.
std::optional<scenes::Scene> withOneTransparentMadeOpaque(const scenes::Scene& scene, int which) {
    scenes::Scene twin = scene;
    const auto isTransparent = [&](const scenes::MeshInstance& instance) {
        return scene.materials[std::size_t(instance.material)].alphaMode == scenes::AlphaMode::Blend;
    };
    bool found = false;
    for (scenes::Node& node : twin.nodes) {
        std::vector<scenes::MeshInstance> kept;
        for (scenes::MeshInstance instance : node.instances) {
            if (isTransparent(instance)) {
                if (which-- != 0) continue;
                found = true;
                scenes::Material opaque = scene.materials[std::size_t(instance.material)];
                opaque.alphaMode = scenes::AlphaMode::Opaque;
                instance.material = int(twin.materials.size());
                twin.materials.push_back(opaque);
            }
            kept.push_back(instance);
        }
        node.instances = std::move(kept);
    }
    if (!found) return {};
    return twin;
}

TEST_SWEEP(LightCulling, noLightIsMissingFromTheListsOfTransparentSurfaces) {
    std::uint64_t needed = 0, transparent = 0;
    for (std::uint64_t seed = 1; seed <= (isWholeSweep() ? 60u : 10u); ++seed) {
        const scenes::Scene scene = asTriedInSweep(randomLitScene(seed));
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings plain = settings({97, 61});
        plain.prune = !isWholeSweep(); // unpruned, all scenes share their programs
        renderer.draw(Technique::Deferred, plain);
        const std::vector<float> opaque = renderer.downloadDepth();
        std::vector<std::vector<float>> depths; // of each transparent instance, where it is visible
        while (const auto twin = withOneTransparentMadeOpaque(scene, int(depths.size()))) {
            engine::Renderer twinRenderer(context(), *twin);
            twinRenderer.draw(Technique::Deferred, plain);
            depths.push_back(twinRenderer.downloadDepth());
            for (std::size_t i = 0; i < opaque.size(); ++i)
                if (!(depths.back()[i] > opaque[i])) depths.back()[i] = 0.0f;
        }
        for (const Method method : kMethods)
            for (std::size_t i = 0; i < std::size(culling::kTileSides); ++i) {
                if (!isWholeSweep() && i != (seed + std::uint64_t(method)) % std::size(culling::kTileSides)) continue;
                const int tile = culling::kTileSides[i];
                frame::FrameSettings requested = settings({97, 61}, method, tile);
                requested.prune = plain.prune;
                requested.culling.normals = culling::NormalTest::Off; // lists of transparent surfaces ignore normals
                renderer.draw(deferredWith(method), requested);
                const engine::DrawnLists drawn = renderer.downloadLists();
                for (const std::vector<float>& depth : depths) {
                    SCOPED_TRACE(fmt::format("seed {} {} tile {}", seed, infoOf(method).name, tile));
                    const LightOracleFigures figures = validation::judgeLights(
                        {scene, requested, drawn, depth, {}, validation::SurfaceLayer::Transparent});
                    expectSound(figures);
                    needed += figures.needed;
                    transparent += figures.covered;
                }
            }
        if (HasFailure()) break;
    }
    fmt::print("transparent surfaces: {} pixels judged, {} pairs needed\n", transparent, needed);
    EXPECT_GT(needed, isWholeSweep() ? 100000u : 3750u) << "scenes that need nothing prove nothing";
}

TEST_F(LightCulling, theCountOfLightsAddsUpOverLayersWhateverTheirOpacity) {
    scenes::Material glass;
    glass.alphaMode = scenes::AlphaMode::Blend;
    glass.baseColor.a = 0.25f;
    scenes::Scene scene = quadScene(glass);
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes[1].parentFromNode[3].z = 0.5;
    for (int i = 0; i < 5; ++i) scene.lights.push_back(pointLight({0.0, 0.0, 1.0}, 1.0f));
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings counted = settings({16, 16});
    counted.view = frame::DebugView::Lights;
    for (const Technique technique : {Technique::Forward, Technique::Deferred, Technique::ForwardPlus}) {
        const std::vector<float> shown = renderer.render(technique, counted).radiance;
        EXPECT_EQ(shown[4 * (8 * 16 + 8)], 10.0f);
    }
}

TEST_F(LightCulling, sixtyFiveThousandLightsInOneTileAreAllVisited) {
    scenes::Scene scene = quadScene({});
    for (int i = 0; i < 65536; ++i) {
        scenes::Light light = pointLight({0.0, 0.0, 0.5}, 1e-4f);
        light.rangeMetres = 5.0f;
        scene.lights.push_back(light);
    }
    engine::Renderer renderer(context(), scene);
    const std::vector<float> truth = renderer.render(Technique::Forward, settings({16, 16})).radiance;
    for (const Method method : kMethods) {
        SCOPED_TRACE(infoOf(method).name);
        EXPECT_EQ(renderer.render(deferredWith(method), settings({16, 16}, method, 64)).radiance, truth);
        EXPECT_EQ(renderer.render(forwardWith(method), settings({16, 16}, method, 8)).radiance, truth);
        frame::FrameSettings counted = settings({16, 16}, method, 64);
        counted.view = frame::DebugView::Lights;
        EXPECT_EQ(renderer.render(deferredWith(method), counted).radiance[0], 65536.0f);
    }
}

TEST_F(LightCulling, theOrderOfTheLightsNeverMattersBeyondRoundingOfTheSum) {
    scenes::Scene scene = lattice(256);
    const frame::FrameSettings requested = settings({320, 181}, Method::Cluster);
    const Picture ordered = engine::toPicture(frameOf(scene, requested, Technique::ClusteredDeferred));
    scenes::Scene turned = scene;
    std::reverse(turned.lights.begin(), turned.lights.end());
    const Picture reversed = engine::toPicture(frameOf(turned, requested, Technique::ClusteredDeferred));
    const validation::ErrorFigures figures = validation::errorFigures(reversed, ordered);
    // Terms are positive, so a sum of n terms in any order is off by at most (n - 1) 2^-24 of itself, twice here; no
    // pixel visits more than 64 of these lights.
    EXPECT_LE(figures.maxRel, 2.0 * 63.0 * 0x1p-24);
    EXPECT_LT(figures.bitEqual, 1.0) << "the order did not change, so nothing was tried";
}

TEST_F(LightCulling, lightsThatCannotChangeAPixelAreNotEvaluated) {
    scenes::Scene scene = lattice(64);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (i % 3 == 0) scene.lights[i].enabled = false;
        if (i % 3 == 1) scene.lights[i].intensity = 0.0f;
        if (i % 3 == 2) scene.lights[i].positionWS = {0.0, 0.0, 500.0}; // behind the camera, out of range
    }
    engine::Renderer renderer(context(), scene);
    const engine::RenderedFrame none = renderer.render(Technique::Forward, settings({64, 36}));
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        frame::FrameSettings requested = settings({64, 36});
        EXPECT_EQ(renderer.render(technique.technique, requested).radiance, none.radiance);
        const LightOracleFigures figures = validation::judgeLights(renderer, technique.technique, requested);
        EXPECT_EQ(figures.evaluated + figures.everywhere, 0u) << technique.name;
        EXPECT_EQ(figures.listBytes, 0u) << technique.name;
    }
}

} // namespace
} // namespace tessera
