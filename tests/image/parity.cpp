#include <iterator>
#include <set>

#include <fmt/ranges.h>

#include "tests/image/ImageTest.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

class Parity : public ImageTest {
protected:
    /// A renderer compiles its programs once for all sizes.
    validation::CompareRecord compare(engine::Renderer& renderer, const frame::FrameSettings& settings,
                                      std::vector<Technique> techniques = {}) {
        validation::CompareRequest request;
        request.techniques = std::move(techniques);
        if (request.techniques.empty()) {
            for (const engine::TechniqueInfo& info : engine::techniqueTable())
                if (info.technique != Technique::Forward) request.techniques.push_back(info.technique);
        }
        request.settings = settings;
        return validation::compareTechniques(renderer, context().capabilities(), request).record;
    }

    void expectAgreement(engine::Renderer& renderer, const frame::FrameSettings& settings,
                         std::vector<Technique> techniques = {}) {
        const validation::CompareRecord record = compare(renderer, settings, std::move(techniques));
        EXPECT_TRUE(record.ok()) << validation::compareTable(record);
        for (const validation::ComparePair& pair : record.pairs) {
            EXPECT_EQ(pair.figures.bad.sum() + pair.figures.badOutside.sum(), 0u);
            EXPECT_GE(pair.figures.litShare, 0.1);
        }
    }
};

bool usesGBuffer(const std::string& technique) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (info.name == technique) return info.usesGBuffer();
    return false;
}

/// One that tiles evenly and one that is odd in both dimensions.
constexpr glm::ivec2 kSizes[] = {{640, 360}, {641, 359}};
constexpr glm::ivec2 kOptionSizes[] = {{320, 180}, {321, 179}};
constexpr glm::ivec2 kSmallSizes[] = {{128, 72}, {129, 71}}; ///< for short sweeps

TEST_SWEEP(Parity, everyBuiltinSceneIsExactlyTheSameWithEveryTechnique) {
    std::size_t turn = 0;
    for (const scenes::BuiltinScene& builtin : builtinsForSweep()) {
        const scenes::Scene scene = builtinForSweep(builtin);
        engine::Renderer renderer(context(), scene);
        for (const glm::ivec2 size : inTurn(isWholeSweep() ? kSizes : kSmallSizes, turn)) {
            SCOPED_TRACE(fmt::format("{} {}x{}", builtin.name, size.x, size.y));
            frame::FrameSettings settings = withDiffusion(ofSize(size));
            expectAgreement(renderer, settings, techniquesInTurn(turn));
        }
        ++turn;
    }
}

TEST_F(Parity, picturesPackedAlikeAreHeldToEveryBitAndOthersToThePromise) {
    const scenes::Scene scene = scenes::loadScene("models");
    engine::Renderer renderer(context(), scene);
    validation::CompareRequest request;
    request.techniques = {Technique::TiledDeferred, Technique::Forward};
    request.layouts = {{Technique::TiledDeferred, &frame::layoutTable()[2]}};
    request.against = Technique::Deferred;
    request.settings.sizePixels = {160, 90};
    request.settings.layout = frame::layoutTable()[1].layout;
    const std::vector<validation::ComparePair> pairs =
        validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
    ASSERT_EQ(pairs.size(), 3u);
    EXPECT_EQ(pairs[0].tolerance.maxRel, context().capabilities().isSoftware ? 0.0 : 1e-5)
        << "both from the same G-buffer";
    EXPECT_EQ(pairs[1].tolerance.relMse, frame::layoutTable()[1].promise.relMse) << "the truth alone is packed";
    EXPECT_EQ(pairs[2].tolerance.relMse, frame::layoutTable()[2].promise.relMse) << "the coarser of both";
    for (const validation::ComparePair& pair : pairs) {
        EXPECT_TRUE(pair.verdict.ok) << pair.a << ": " << fmt::format("{}", fmt::join(pair.verdict.missed, "; "));
        EXPECT_TRUE(pair.channels.empty()) << pair.a;
    }
}

/// Scenes of a short sweep: one of gloss and metal, and one of texture maps.
/// picturesPackedAlikeAreHeldToEveryBitAndOthersToThePromise covers every material model and layer.
constexpr std::pair<std::string_view, std::string_view> kScenesOfLayouts[] = {{"spheres", "slim"},
                                                                              {"head_marble", "packed"}};

/// Every layout with every technique. In a short sweep two scenes in one layout each with `deferred`, whose G-buffer
/// the other techniques share.
TEST_SWEEP_AS(Parity, everyCoarseLayoutKeepsItsPromiseAndAttributesItsError, ParitySlow,
              everyCoarseLayoutAlwaysKeepsItsPromiseWithEveryTechnique) {
    std::set<std::string_view> kept;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        std::optional<scenes::Scene> scene;
        std::optional<engine::Renderer> renderer;
        for (const frame::LayoutInfo& layout : frame::layoutTable().subspan(1)) {
            const std::pair sceneAndLayout(builtin.name, layout.name);
            if (!isWholeSweep() && std::ranges::find(kScenesOfLayouts, sceneAndLayout) == std::end(kScenesOfLayouts))
                continue;
            kept.insert(layout.name);
            if (!renderer) renderer.emplace(context(), scene.emplace(builtinForSweep(builtin)));
            SCOPED_TRACE(fmt::format("{} {}", builtin.name, layout.name));
            frame::FrameSettings settings;
            settings.sizePixels = isWholeSweep() ? kSizes[1] : glm::ivec2(321, 179);
            settings.diffusion = coarseDiffusion();
            settings.layout = layout.layout;
            const validation::CompareRecord record = compare(
                *renderer, settings, isWholeSweep() ? std::vector<Technique>{} : std::vector{Technique::Deferred});
            EXPECT_TRUE(record.ok()) << validation::compareTable(record);
            for (const validation::ComparePair& pair : record.pairs) {
                if (!usesGBuffer(pair.a)) continue;
                EXPECT_LE(pair.figures.relMse, layout.promise.relMse);
                EXPECT_LE(pair.figures.p999Rel, layout.promise.p999Rel);
                EXPECT_LE(std::abs(pair.figures.bias), layout.promise.bias);
                EXPECT_LT(pair.figures.bitEqual, 1.0) << "a packed G-buffer that costs nothing was not used";
                ASSERT_FALSE(pair.channels.empty());
                // Errors of channels are nearly independent, so that their parts sum to the whole.
                double sum = 0.0;
                for (const validation::ChannelShare& share : pair.channels) sum += share.share;
                EXPECT_NEAR(sum, pair.figures.relMse, 0.3 * pair.figures.relMse);
            }
            fmt::print("{}", validation::compareTable(record));
        }
    }
    EXPECT_EQ(kept.size() + 1, frame::layoutTable().size()) << "a coarse layout was not used";
}

/// A scene of everything, with options added one by one. A short sweep takes the first and the last of those with
/// pruned programs (Invariance has the others), with one technique and one small size in turn.
TEST_SWEEP(Parity, aSceneOfEveryFeatureIsExactlyTheSameWithEveryTechniqueAndOption) {
    using Settings = frame::FrameSettings;
    constexpr void (*kAddOption[])(Settings&) = {
        [](Settings&) {}, [](Settings& settings) { settings.filter = frame::TextureFilter::Exact; },
        [](Settings& settings) { settings.space = frame::LightingSpace::View; },
        [](Settings& settings) { settings.specular = false; }, [](Settings& settings) { settings.prune = false; }};
    const scenes::Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene);
    constexpr std::size_t kLastPruned = std::size(kAddOption) - 2;
    Settings settings;
    std::size_t turn = 0;
    for (std::size_t i = 0; i < std::size(kAddOption); ++i) {
        kAddOption[i](settings);
        if (!isWholeSweep() && i != 0 && i != kLastPruned) continue;
        for (const glm::ivec2 size : inTurn(isWholeSweep() ? kOptionSizes : kSmallSizes, turn)) {
            SCOPED_TRACE(fmt::format("{} options, {}x{}", i, size.x, size.y));
            settings.sizePixels = size;
            expectAgreement(renderer, settings, techniquesInTurn(turn));
        }
        ++turn;
    }
}

/// A scene of everything. In a short sweep only for every sixth view with a key, which show lobe terms; its metal for
/// the others of these and for every sixth of the rest.
TEST_SWEEP(Parity, everyViewIsExactlyTheSameInForwardAndDeferred) {
    const scenes::Scene everything = everythingScene(), metal = metalScene();
    engine::Renderer renderer(context(), everything), rendererOfMetal(context(), metal);
    std::size_t turn = 0, lobes = 0;
    for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
        SCOPED_TRACE(view.name);
        if (view.ofTechnique) continue; // differs by technique
        const bool showsLobes = view.key != 0;
        const bool isInTurn = (showsLobes ? lobes : turn)++ % 6 == 0;
        if (!isWholeSweep() && !showsLobes && !isInTurn) continue;
        engine::Renderer& shown = isWholeSweep() || (showsLobes && isInTurn) ? renderer : rendererOfMetal;
        frame::FrameSettings settings = withView(ofSize(161, 90), view.view);
        const std::vector<float> forward = shown.render(Technique::Forward, settings).radiance;
        const std::vector<float> deferred = shown.render(Technique::Deferred, settings).radiance;
        EXPECT_EQ(forward, deferred);
        EXPECT_GT(*std::max_element(forward.begin(), forward.end()), 0.0f);
    }
}

TEST_SWEEP(Parity, anOrthographicCameraIsExactlyTheSameWithEveryTechnique) {
    scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    makeOrthographic(scene.cameras[0], 2.5);
    frame::FrameSettings settings = ofSize(321, 179);
    engine::Renderer endless(context(), scene);
    expectAgreement(endless, settings, techniquesInTurn(0));
    scenes::Scene ending = scene;
    ending.cameras[0].farMetres = 20.0;
    engine::Renderer ended(context(), ending);
    expectAgreement(ended, settings, techniquesInTurn(1));
}

TEST_F(Parity, aFarPlaneDoesNotChangeNearerSurfaces) {
    scenes::Scene scene = everythingScene();
    frame::FrameSettings settings = ofSize(161, 90);
    const Picture endless = [&] {
        const engine::RenderedFrame frame = frameOf(scene, settings);
        return Picture{frame.width, frame.height, frame.radiance, std::vector<std::uint8_t>(161 * 90, 1)};
    }();
    scene.cameras[0].farMetres = 60.0;
    const engine::RenderedFrame frame = frameOf(scene, settings);
    const Picture bounded{frame.width, frame.height, frame.radiance, std::vector<std::uint8_t>(161 * 90, 1)};
    // Depth is stored on another scale, so positions and highlights move by its rounding: 1e-7 of the distance.
    EXPECT_LE(validation::errorFigures(bounded, endless).relMse, 1e-8);
}

} // namespace
} // namespace tessera
