// The fraction of a pixel's samples that edges cover.

#include "engine/ChooseSamples.h"
#include "tests/image/FlatTest.h"
#include "tests/image/MultisamplingTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Scene;
using namespace test;

using MultisampledEdges = MultisamplingTest;

/// A unit square of one colour whose alpha is a ramp: 0 at its left edge, 1 at its right one.
Scene rampScene(float cutoff) {
    scenes::Material paint = unlit({0.5f, 0.25f, 1.0f, 1.0f});
    paint.alphaMode = scenes::AlphaMode::Mask;
    paint.alphaCutoff = cutoff;
    Scene scene = quadScene(paint);
    makeOrthographic(scene.cameras[0], 1.0);
    scene.meshes[0].colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}};
    return scene;
}

TEST_F(MultisampledEdges, aMaskedEdgeCoversAsManySamplesAsItsAlphaSays) {
    constexpr int kSide = 8, kEdge = 3; // the cutoff is crossed in this column
    if (context().capabilities().samplePlaces.back().size() == 1)
        GTEST_SKIP() << "this driver has no multisampled render targets";
    for (const Technique technique : {Technique::Forward, Technique::ForwardPrepass, Technique::ClusteredForward}) {
        // Away from the steps between two sample counts, by more than rounding.
        for (const double share : {0.05, 0.3, 0.55, 0.8, 0.95}) {
            SCOPED_TRACE(share);
            // Alpha is (x + 1/2) / 8 at the centre of column x, so the sharpened alpha is x + 1 - 8 cutoff.
            const Scene scene = rampScene(float((kEdge + 1 - share) / kSide));
            engine::Renderer renderer(context(), scene);
            const engine::RenderedFrame frame = renderer.render(technique, sampled({kSide, kSide}));
            const std::size_t given =
                engine::settingsOn(context().capabilities(), sampled({kSide, kSide})).samplePlaces.size();
            for (int i = 0; i < kSide * kSide; ++i) {
                const int x = i % kSide;
                const float part = x < kEdge   ? 0.0f
                                   : x > kEdge ? 1.0f
                                               : float(std::floor(share * double(given) + 0.5) / double(given));
                EXPECT_EQ(frame.radiance[std::size_t(4 * i)], 0.5f * part) << i;
                EXPECT_EQ(frame.radiance[std::size_t(4 * i + 1)], 0.25f * part) << i;
                EXPECT_EQ(frame.radiance[std::size_t(4 * i + 3)], part) << i;
            }
        }
    }
}

TEST_F(MultisampledEdges, alphaThatEqualsItsCutoffEverywhereIsWhole) {
    for (const float cutoff : {0.0f, 0.5f, 1.0f}) {
        Scene scene = rampScene(cutoff);
        scene.meshes[0].colors.assign(4, {1, 1, 1, cutoff});
        EXPECT_EQ(alphasOf(picture(scene, sampled({8, 8}))), std::set<float>{1.0f}) << cutoff;
    }
    // With a cutoff of 0 nothing is cut out, however steep alpha is.
    Scene stripes = texturedScene(rampScene(0.0f), scenes::TextureSlot::BaseColor, image8([](int x, int) {
                                      return std::array<int, 4>{255, 255, 255, x % 2 == 0 ? 0 : 255};
                                  }));
    stripes.meshes[0].colors.clear();
    EXPECT_EQ(alphasOf(picture(stripes, sampled({8, 8}))), std::set<float>{1.0f});
}

TEST_F(MultisampledEdges, aStraightEdgeCoversTheSamplesOnItsSide) {
    constexpr int kSide = 8, kEdge = 4;
    if (context().capabilities().samplePlaces.back().size() == 1)
        GTEST_SKIP() << "this driver has no multisampled render targets";
    const frame::FrameSettings settings = engine::settingsOn(context().capabilities(), sampled({kSide, kSide}));
    const std::vector<glm::vec2>& samples = settings.samplePlaces;
    scenes::Material paint = unlit({0.5f, 0.25f, 1.0f, 1.0f});
    for (int axis = 0; axis < 2; ++axis) {
        std::set<float> ladder;
        // Odd sixteenths: the rasteriser's grid represents them exactly, and no sample of a common pattern lies on one.
        for (int sixteenth = 1; sixteenth < 16; sixteenth += 2) {
            Scene scene = quadScene(paint);
            makeOrthographic(scene.cameras[0], 1.0);
            const double within = sixteenth / 16.0; // of pixel kEdge, from the left or from below
            const double edge = (kEdge + within) / (kSide / 2) - 1.0;
            scene.nodes[0].parentFromNode = glm::dmat4(2.0);
            scene.nodes[0].parentFromNode[3] = glm::dvec4(0, 0, 0, 1);
            scene.nodes[0].parentFromNode[3][axis] = edge - 2.0;
            const Picture shown = picture(scene, settings);
            const auto inside = std::count_if(samples.begin(), samples.end(),
                                              [&](const glm::vec2& sample) { return sample[axis] < float(within); });
            const float share = float(inside) / float(samples.size());
            ladder.insert(share);
            for (int i = 0; i < kSide * kSide; ++i) {
                const int along = axis == 0 ? i % kSide : kSide - 1 - i / kSide; // rows run from the top
                const float part = along < kEdge ? 1.0f : along > kEdge ? 0.0f : share;
                const float* pixel = shown.pixel(std::size_t(i));
                EXPECT_EQ(pixel[0], 0.5f * part) << sixteenth << " " << i;
                EXPECT_EQ(pixel[2], part) << sixteenth << " " << i;
                EXPECT_EQ(pixel[3], part) << sixteenth << " " << i;
            }
        }
        EXPECT_GE(ladder.size(), 3u) << "the edge never passed a sample";
    }
}

TEST_F(MultisampledEdges, theEdgeOfAMaskedCardHasSharesInBetween) {
    Scene scene = everythingScene();
    scene.nodes = {scene.nodes[5]}; // the masked card
    const std::set<float> hard = alphasOf(picture(scene, sampled({321, 179}, 1)));
    EXPECT_EQ(hard, (std::set<float>{0.0f, 1.0f}));
    const std::set<float> soft = alphasOf(picture(scene, sampled({321, 179})));
    EXPECT_TRUE(soft.contains(0.0f) && soft.contains(1.0f));
    EXPECT_GE(soft.size(), 4u);
}

} // namespace
} // namespace tessera
