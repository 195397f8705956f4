// Light lists and images are the same with every builder.
#include <gmock/gmock.h>

#include "engine/ChooseSamples.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using culling::Builder;
using engine::Technique;
using namespace test;

/// GPU invocations that build a tile's lists together.
constexpr int kLanes[] = {64, 1};

class LightLists : public ImageTest {
protected:
    static Technique techniqueOf(const frame::FrameSettings& settings) {
        const bool tiled = *settings.culling.method == culling::Method::TileMinmax ||
                           *settings.culling.method == culling::Method::Tile25d;
        if (settings.samples > 1) return tiled ? Technique::ForwardPlus : Technique::ClusteredForward;
        return tiled ? Technique::TiledDeferred : Technique::ClusteredDeferred;
    }

    static frame::FrameSettings with(frame::FrameSettings settings, int lanes) {
        settings.culling.builder = Builder::Compute;
        settings.culling.lanes = lanes;
        return settings;
    }

    culling::LightLists lists(engine::Renderer& renderer, const frame::FrameSettings& settings) {
        renderer.draw(techniqueOf(settings), settings);
        engine::DrawnLists drawn = renderer.downloadLists();
        EXPECT_EQ(drawn.culling.method, *settings.culling.method);
        return std::move(drawn.lists);
    }

    /// C++ and Mesa do the same arithmetic step by step with the same rounding: no tolerance.
    static void expectEqual(const culling::LightLists& built, const culling::LightLists& truth) {
        ASSERT_EQ(built.tiles.size(), truth.tiles.size());
        for (std::size_t i = 0; i < truth.tiles.size(); ++i)
            ASSERT_EQ(built.tiles[i].words, truth.tiles[i].words) << "tile " << i;
        ASSERT_EQ(built.cells, truth.cells);
        ASSERT_EQ(built.entries, truth.entries);
    }

    /// All of kLanes, or one of them in turn.
    static std::span<const int> lanesOf(bool all, std::size_t turn) {
        return all ? std::span(kLanes) : std::span(kLanes).subspan(turn % std::size(kLanes), 1);
    }

    /// Compares lists with every method and tile size; with all of kLanes, or one in turn.
    void expectSameLists(const scenes::Scene& scene, frame::FrameSettings settings, std::span<const int> tiles,
                         bool allLanes = true, std::size_t turn = 0) {
        engine::Renderer renderer(context(), scene);
        for (const culling::MethodInfo& method : culling::methodTable()) {
            if (method.method == culling::Method::None) continue;
            settings.culling.method = method.method;
            for (const int tile : tiles) {
                settings.culling.tilePixels = tile;
                settings.culling.builder = Builder::Cpu;
                settings.culling.normals = culling::NormalTest::Off;
                const culling::LightLists truth = lists(renderer, settings);
                // The lattice's first light is out of view; a tile's box, wider than its frustum, may still touch it.
                EXPECT_TRUE(scene.lights.size() == 1 || !truth.entries.empty());
                for (const int lanes : lanesOf(allLanes, turn++)) {
                    SCOPED_TRACE(fmt::format("{}, tile {}, {} lanes", method.name, tile, lanes));
                    expectEqual(lists(renderer, with(settings, lanes)), truth);
                }
            }
        }
    }

    /// Compares with forward every technique, with every method and all of kLanes, or with one method and one of kLanes
    /// in turn. Forward is pruned, which changes no bit.
    void expectForwardsPicture(const scenes::Scene& scene, frame::FrameSettings settings, bool allLanes) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings pruned = settings;
        pruned.prune = true;
        const std::vector<float> truth = renderer.render(Technique::Forward, pruned).radiance;
        std::size_t turn = 0;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            if (!engine::supportsSamples(technique, settings.samples)) continue;
            std::vector<culling::Method> methods(technique.methods.begin(), technique.methods.end());
            std::erase(methods, culling::Method::None);
            if (methods.empty()) continue;
            if (!allLanes) methods = {methods[turn / 2 % methods.size()]};
            for (const culling::Method method : methods) {
                settings.culling.method = method;
                for (const int lanes : lanesOf(allLanes, turn++)) {
                    SCOPED_TRACE(fmt::format("{} {}, {} lanes", technique.name, int(method), lanes));
                    EXPECT_TRUE(renderer.render(technique.technique, with(settings, lanes)).radiance == truth);
                }
            }
        }
    }
};

scenes::Scene sceneOfLists() {
    return isWholeSweep() ? everythingScene() : lambertScene();
}

TEST_SWEEP(LightLists, listsBuiltOnTheGpuAreExactlyThoseBuiltOnTheCpu) {
    frame::FrameSettings settings = ofSize(321, 179);
    expectSameLists(latticeOf(256), settings, culling::kTileSides, isWholeSweep());
}

TEST_SWEEP(LightLists, listsOfEveryLightTypeAndTransparentSurfacesAreExactlyTheSameOnTheGpu) {
    const scenes::Scene scene = sceneOfLists();
    frame::FrameSettings settings = ofSize(320, 180);
    expectSameLists(scene, settings, culling::kTileSides, isWholeSweep());
    settings.sizePixels = {37, 1};
    expectSameLists(scene, settings, std::array{16}, isWholeSweep(), 1);
    if (!isWholeSweep()) return;
    settings.sizePixels = {161, 90};
    settings.prune = false;
    expectSameLists(scene, settings, std::array{8});
}

TEST_SWEEP(LightLists, listsOfAnOrthographicCameraAreExactlyTheSameOnTheGpu) {
    scenes::Scene scene = sceneOfLists();
    makeOrthographic(scene.cameras[0], 2.5);
    frame::FrameSettings settings = ofSize(161, 91);
    expectSameLists(scene, settings, std::array{8, 32});
}

TEST_F(LightLists, listsOfSurfacesFarBeyondTheNearPlaneAreExactlyTheSameOnTheGpu) {
    scenes::Scene scene = latticeOf(64);
    scene.cameras[0].nearMetres *= 1e-3; // every depth is below a hundredth
    frame::FrameSettings settings = ofSize(161, 91);
    expectSameLists(scene, settings, std::array{16});
}

TEST_SWEEP(LightLists, picturesLitFromListsOfTheGpuAreThoseOfForward) {
    frame::FrameSettings settings = ofSize(161, 91);
    expectForwardsPicture(sceneOfLists(), settings, isWholeSweep());
    if (!isWholeSweep()) return;
    settings.prune = false;
    expectForwardsPicture(sceneOfLists(), settings, isWholeSweep());
}

TEST_SWEEP(LightLists, listsOfMultisampledPicturesAreExactlyTheSameOnTheGpuAndLightThemAsForwardDoes) {
    int tried = 0;
    constexpr int kSamples[] = {2, 4};
    for (const int samples : inTurn(kSamples, 1)) {
        SCOPED_TRACE(samples);
        frame::FrameSettings settings = withSamples(ofSize(161, 91), samples);
        settings = engine::settingsOn(context().capabilities(), settings);
        if (settings.samples == tried) continue; // the driver has the same for both
        tried = settings.samples;
        expectSameLists(sceneOfLists(), settings, std::array{8, 64}, isWholeSweep());
        expectForwardsPicture(sceneOfLists(), settings, isWholeSweep());
    }
}

TEST_SWEEP(LightLists, anyCountOfLightsGivesTheSameLists) {
    frame::FrameSettings settings = ofSize(65, 49);
    settings.prune = !isWholeSweep();
    std::size_t turn = 0;
    for (const int count : {1, 31, 32, 33, 4097}) {
        if (count == 1 && settings.prune) continue; // the lattice's first light is out of view and would be pruned
        SCOPED_TRACE(count);
        expectSameLists(latticeOf(count), settings, std::array{16}, isWholeSweep(), turn++);
    }
}

TEST_F(LightLists, manyLightsGiveThePictureOfForward) {
    frame::FrameSettings settings = ofSize(65, 49);
    expectForwardsPicture(latticeOf(4097), settings, true);
}

TEST_SWEEP(LightLists, theMostLightsOfASceneAreNotTooManyForTheGpu) {
    frame::FrameSettings settings = ofSize(33, 17);
    const scenes::Scene scene = latticeOf(65536);
    expectSameLists(scene, settings, std::array{64}, isWholeSweep());
    engine::Renderer renderer(context(), scene);
    const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
    for (const int lanes : lanesOf(isWholeSweep(), 0)) {
        SCOPED_TRACE(lanes);
        EXPECT_TRUE(renderer.render(Technique::ForwardPlus, with(settings, lanes)).radiance == truth);
        EXPECT_TRUE(renderer.render(Technique::ClusteredDeferred, with(settings, lanes)).radiance == truth);
    }
}

} // namespace
} // namespace tessera
