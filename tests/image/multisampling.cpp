#include <iterator>
#include <span>

#include "engine/ChooseSamples.h"
#include "renderer/gpu/Framebuffer.h"
#include "renderer/graph/Plan.h"
#include "tests/image/FlatTest.h"
#include "tests/image/MultisamplingTest.h"
#include "tests/support/CullingScenes.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Scene;
using namespace test;

class Multisampling : public MultisamplingTest {
protected:
    /// A renderer compiles its programs once for all sizes. `turn` selects one technique (Sweep.h).
    void expectAgreement(engine::Renderer& renderer, const frame::FrameSettings& settings,
                         std::optional<std::size_t> turn = {}) {
        validation::CompareRequest request;
        std::vector<validation::LeftOutTechnique> leftOut;
        request.techniques = validation::techniquesSupporting(settings, leftOut);
        std::erase(request.techniques, Technique::Forward);
        if (turn) request.techniques = techniquesInTurn(*turn, settings.samples);
        request.settings = settings;
        const validation::CompareRecord record =
            validation::compareTechniques(renderer, context().capabilities(), request).record;
        EXPECT_TRUE(record.ok()) << validation::compareTable(record);
        EXPECT_GE(record.samples, settings.samples);
        for (const validation::ComparePair& pair : record.pairs)
            EXPECT_EQ(pair.figures.bad.sum() + pair.figures.badOutside.sum(), 0u);
    }
};
using MultisamplingSlow = Multisampling;

TEST_F(MultisamplingSlow, hallIsExactlyTheSameInTheForwardFamily) {
    const Scene scene = scenes::loadScene("hall");
    engine::Renderer renderer(context(), scene);
    for (const glm::ivec2 size : {glm::ivec2(208, 116), glm::ivec2(209, 117)}) expectAgreement(renderer, sampled(size));
}

/// A scene of everything, with options added one by one. A short sweep takes the first and the last of those with
/// pruned programs (pruningAndRunningAgainNeverChangeABit has the others), with one technique and size in turn.
TEST_SWEEP(Multisampling, aSceneOfEveryFeatureIsExactlyTheSameInTheForwardFamily) {
    using Settings = frame::FrameSettings;
    constexpr void (*kAddOption[])(Settings&) = {
        [](Settings&) {}, [](Settings& settings) { settings.filter = frame::TextureFilter::Exact; },
        [](Settings& settings) { settings.space = frame::LightingSpace::View; },
        [](Settings& settings) { settings.prune = false; }};
    constexpr glm::ivec2 kAllSizes[] = {{320, 180}, {321, 179}}, kSizesInTurn[] = {{160, 90}, {161, 89}};
    const Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene);
    constexpr std::size_t kLastPruned = std::size(kAddOption) - 2;
    Settings settings = sampled({});
    std::size_t turn = 0;
    for (std::size_t i = 0; i < std::size(kAddOption); ++i) {
        kAddOption[i](settings);
        if (!isWholeSweep() && i != 0 && i != kLastPruned) continue;
        for (const glm::ivec2 size : inTurn(isWholeSweep() ? kAllSizes : kSizesInTurn, turn)) {
            SCOPED_TRACE(fmt::format("{} options, {}x{}", i, size.x, size.y));
            settings.sizePixels = size;
            expectAgreement(renderer, settings, turn);
        }
        ++turn;
    }
    Scene flat = isWholeSweep() ? scene : metalScene();
    makeOrthographic(flat.cameras[0], 2.5);
    flat.cameras[0].farMetres = 20.0;
    engine::Renderer flatRenderer(context(), flat);
    expectAgreement(flatRenderer, sampled(isWholeSweep() ? kAllSizes[1] : kSizesInTurn[1]), turn);
}

/// Random scenes with every technique, culling method and tile size; a short sweep takes every ninth of these in turn.
/// The subject is which lights a pixel has, so the scene of everything is then one in Lambert materials.
TEST_SWEEP(Multisampling, everyCullingMethodAndTileGivesExactlyForwardsPicture) {
    constexpr std::size_t kTurns = 9; // odd, so that turns go through all four tile sizes
    std::vector<Scene> lit{isWholeSweep() ? everythingScene() : lambertScene(), columnsBeforeWall(200)};
    for (std::uint64_t seed = 1; seed <= (isWholeSweep() ? 24 : 3); ++seed) {
        const Scene scene = randomLitScene(seed);
        lit.push_back(isWholeSweep() ? scene : withEveryKindOfLight(scene));
    }
    struct Case {
        Technique technique;
        culling::Method method;
        int tilePixels;
    };
    for (std::size_t i = 0; i < lit.size(); ++i) {
        engine::Renderer renderer(context(), lit[i]);
        frame::FrameSettings settings = sampled(i < 2 ? glm::ivec2(201, 115) : glm::ivec2(97, 61), i % 2 == 0 ? 4 : 2);
        settings = engine::settingsOn(context().capabilities(), settings);
        // Without pruning all scenes share their programs, though these are large. With every kind of light they share
        // pruned ones too.
        settings.prune = !isWholeSweep() || i % 4 == 0;
        std::vector<Case> cases;
        for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
            if (!engine::supportsSamples(info, settings.samples)) continue;
            for (const culling::Method method : info.methods) {
                const std::span<const int> tiles(culling::kTileSides);
                for (const int tile : method == culling::Method::None ? tiles.first(1) : tiles)
                    cases.push_back({info.technique, method, tile});
            }
        }
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        for (std::size_t j = 0; j < cases.size(); ++j) {
            const auto& [technique, method, tile] = cases[j];
            if (!isWholeSweep() && j % kTurns != i % kTurns) continue;
            SCOPED_TRACE(fmt::format("scene {}, {} {} {}", i, infoOf(technique).name, int(method), tile));
            settings.culling.method = method;
            settings.culling.tilePixels = tile;
            EXPECT_TRUE(renderer.render(technique, settings).radiance == truth);
        }
    }
}

/// A floor up to the horizon, which crosses the middle of the image, and lights whose ranges end far beyond it.
Scene endlessFloor(scenes::AlphaMode alphaMode) {
    scenes::Material paint = lambert();
    paint.alphaMode = alphaMode;
    paint.baseColor = {0.5f, 0.25f, 1.0f, 0.5f};
    Scene scene = quadScene(paint);
    scene.meshes[0].colors.clear();
    // The quad's x and y become the floor's x and -z.
    scene.nodes[0].parentFromNode = glm::dmat4(glm::dvec4(1e7, 0, 0, 0), glm::dvec4(0, 0, -1e7, 0),
                                               glm::dvec4(0, 1, 0, 0), glm::dvec4(0, -1, 0, 1));
    scene.cameras[0].worldFromCamera = glm::dmat4(1.0);
    for (int i = 0; i < 8; ++i) {
        scenes::Light light = pointLight({-3.5 + i, 2e4, -1e4}, 1e9f);
        light.rangeMetres = 1e8f;
        scene.lights.push_back(light);
    }
    return scene;
}

TEST_F(Multisampling, aSurfaceWhosePixelCentreLiesBeyondTheHorizonHasItsLights) {
    for (const scenes::AlphaMode mode : {scenes::AlphaMode::Opaque, scenes::AlphaMode::Blend}) {
        Scene scene = endlessFloor(mode);
        for (const double pitch : {0.0, 0.01, -0.02}) {
            scene.cameras[0].worldFromCamera[1] = {0, std::cos(pitch), -std::sin(pitch), 0};
            scene.cameras[0].worldFromCamera[2] = {0, std::sin(pitch), std::cos(pitch), 0};
            // A tile of one row of pixels, on the horizon, lists lights only for these.
            for (const glm::ivec2 size : {glm::ivec2(65, 17), glm::ivec2(65, 1)}) {
                engine::Renderer renderer(context(), scene);
                frame::FrameSettings settings = engine::settingsOn(context().capabilities(), sampled(size));
                const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
                EXPECT_GT(*std::max_element(truth.begin(), truth.end()), 0.0f);
                for (const culling::Method method : {culling::Method::TileMinmax, culling::Method::Tile25d,
                                                     culling::Method::Cluster, culling::Method::Zbin}) {
                    SCOPED_TRACE(fmt::format("{} pitch {} rows {} method {}", int(mode), pitch, size.y, int(method)));
                    settings.culling.method = method;
                    settings.culling.tilePixels = 8;
                    const bool tiled = method == culling::Method::TileMinmax || method == culling::Method::Tile25d;
                    const Technique technique = tiled ? Technique::ForwardPlus : Technique::ClusteredForward;
                    EXPECT_TRUE(renderer.render(technique, settings).radiance == truth);
                }
            }
        }
    }
}

/// The ray through such a pixel's centre is parallel to the floor and never meets it. The texture coordinates of a
/// corner are used instead, which do not change from pixel to pixel (lib/surface/triangle.glsl).
TEST_F(Multisampling, aPixelWhoseCentreLiesOnTheHorizonTakesOneTexelOfACornerWithTheExactFilter) {
    Scene scene = endlessFloor(scenes::AlphaMode::Opaque);
    scene.lights.clear();
    scene.materials[0] = unlit();
    // Columns of red and green: no texel has both, and any blend does.
    scene = texturedScene(scene, scenes::TextureSlot::BaseColor, image8([](int x, int) {
                              return std::array<int, 4>{x % 2 == 0 ? 255 : 0, x % 2 == 0 ? 0 : 255, 0, 255};
                          }));
    scene.materials[0].texture(scenes::TextureSlot::BaseColor).sampler.minification = scenes::Filter::Linear;
    frame::FrameSettings settings = sampled({65, 17});
    settings.filter = frame::TextureFilter::Exact;
    const Picture shown = picture(scene, settings);
    for (int x = 0; x < 65; ++x) {
        const float* pixel = shown.pixel(std::size_t(8 * 65 + x));
        EXPECT_GT(pixel[0] + pixel[1], 0.0f) << "no sample of column " << x << " lies below the horizon";
        EXPECT_EQ(std::min(pixel[0], pixel[1]), 0.0f) << "column " << x;
    }
}

TEST_SWEEP(Multisampling, everyViewIsExactlyTheSameInTheForwardFamily) {
    const Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    engine::Renderer renderer(context(), scene);
    constexpr Technique kOthers[] = {Technique::ForwardPrepass, Technique::ForwardPlus};
    std::size_t turn = 0;
    for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
        SCOPED_TRACE(view.name);
        frame::FrameSettings settings = sampled({161, 90});
        settings.view = view.view;
        if (view.ofTechnique) continue; // differs by technique
        if (!isWholeSweep() && turn++ % 4 != 0) continue;
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        for (const Technique technique : inTurn(kOthers, turn / 4))
            EXPECT_TRUE(renderer.render(technique, settings).radiance == truth);
    }
}

/// Each scene with every technique, or the metal of everything with the culling technique.
TEST_SWEEP_AS(Multisampling, pruningAndRunningAgainNeverChangeABit, MultisamplingSlow,
              pruningAndRunningAgainNeverChangeABitWithAnyTechnique) {
    std::vector<Scene> tried{metalScene()};
    if (isWholeSweep()) tried = {scenes::loadScene("hall"), scenes::loadScene("room"), everythingScene()};
    for (const Scene& scene : tried)
        for (const Technique technique : {Technique::ClusteredForward, Technique::ForwardPrepass, Technique::Forward}) {
            if (!isWholeSweep() && technique != Technique::ClusteredForward) continue;
            SCOPED_TRACE(fmt::format("{} {}", scene.name, infoOf(technique).name));
            frame::FrameSettings settings = sampled(isWholeSweep() ? glm::ivec2(161, 90) : glm::ivec2(97, 55));
            const Picture first = picture(scene, settings, technique);
            EXPECT_EQ(picture(scene, settings, technique).rgba, first.rgba);
            settings.prune = false;
            EXPECT_EQ(picture(scene, settings, technique).rgba, first.rgba);
        }
}

/// With every technique, or the culling one.
TEST_SWEEP_AS(Multisampling, aPixelIsNotNaNInfiniteOrNegative, MultisamplingSlow,
              aPixelIsNotNaNInfiniteOrNegativeWithAnyTechnique) {
    // A floor up to the horizon, at distances whose squares overflow fp32, under a light without range: pixel centres
    // lie above the horizon where samples do not. Slivers with steep colours: pixel centres lie outside most of them.
    Scene scene = everythingScene();
    scene.nodes[0].parentFromNode = glm::dmat4(1e7) * scene.nodes[0].parentFromNode;
    scene.nodes[0].parentFromNode[3] = {0, -1, 0, 1};
    scenes::Mesh slivers;
    slivers.name = "slivers";
    for (int i = 0; i < 400; ++i) {
        const float x = -2.0f + 0.01f * float(i), colour = i % 2 == 0 ? 0.0f : 1.0f;
        for (const glm::vec3& corner : {glm::vec3(x, -1, 0), glm::vec3(x + 0.004f, -1, 0), glm::vec3(x, 1, 2)}) {
            slivers.indices.push_back(std::uint32_t(slivers.positionsOS.size()));
            slivers.positionsOS.push_back(corner);
            slivers.normalsOS.push_back({0, 0, 1});
            slivers.colors.push_back(corner.x > x ? glm::vec4(1.0f - colour) : glm::vec4(colour));
            slivers.texCoords[0].push_back({corner.x, corner.y});
            slivers.texCoords[1].push_back({corner.x, corner.y});
        }
    }
    scene.nodes[1].instances = {{int(scene.meshes.size()), 1}};
    scene.nodes[1].parentFromNode = glm::dmat4(1.0);
    scene.meshes.push_back(slivers);
    constexpr Technique kForwardFamily[] = {Technique::Forward, Technique::ForwardPrepass, Technique::ClusteredForward};
    for (double pitch : {0.0, 0.01, 0.05}) {
        scene.cameras[0].worldFromCamera = glm::dmat4(1.0);
        scene.cameras[0].worldFromCamera[1] = {0, std::cos(pitch), -std::sin(pitch), 0};
        scene.cameras[0].worldFromCamera[2] = {0, std::sin(pitch), std::cos(pitch), 0};
        scene.cameras[0].worldFromCamera[3] = {0, 0.5, 6, 1};
        for (const Technique technique : inTurn(kForwardFamily, 2)) {
            const Picture shown = picture(scene, sampled({321, 179}), technique);
            const validation::ErrorFigures figures = validation::errorFigures(shown, shown);
            EXPECT_EQ(figures.bad.nan + figures.badOutside.nan, 0u) << pitch;
            EXPECT_EQ(figures.bad.infinite + figures.badOutside.infinite, 0u) << pitch;
            EXPECT_EQ(figures.bad.negative + figures.badOutside.negative, 0u) << pitch;
            EXPECT_GT(figures.litShare, 0.1);
        }
    }
}

TEST_F(Multisampling, oneSampleIsDrawnAsWithoutThem) {
    const Scene scene = scenes::loadScene("room");
    const graph::Plan plan = engine::planFrame(scene, Technique::ForwardPrepass, sampled({64, 36}, 1));
    for (const graph::Plan::Pass& pass : plan.passes) EXPECT_NE(pass.name, "resolve");
    for (const graph::Plan::Resource& resource : plan.resources) EXPECT_EQ(resource.samples, 1) << resource.name;
    for (const graph::Plan::Choice& choice : plan.choices) EXPECT_NE(choice.what, "samples");
    Scene opaque = everythingScene();
    opaque.nodes.resize(6); // without the two panes of glass
    EXPECT_EQ(alphasOf(picture(opaque, sampled({161, 90}, 1))), (std::set<float>{0.0f, 1.0f}));
}

TEST_F(Multisampling, verticesBrighterThanOneAreNotHeldToIt) {
    scenes::Material paint = unlit();
    Scene scene = quadScene(paint);
    makeOrthographic(scene.cameras[0], 1.0);
    scene.meshes[0].colors.assign(4, {4.0f, 2.0f, 0.5f, 1.0f});
    const Picture shown = picture(scene, sampled({8, 8}));
    for (std::size_t i = 0; i < shown.pixelCount(); ++i) {
        const float wanted[] = {4.0f, 2.0f, 0.5f};
        // Interpolating equal values rounds three times.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.pixel(i)[c], wanted[c], 1e-6f * wanted[c]) << "pixel " << i;
    }
}

} // namespace
} // namespace tessera
