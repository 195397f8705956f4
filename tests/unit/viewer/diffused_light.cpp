#include <gtest/gtest.h>

#include "engine/Settings.h"
#include "viewer/show/DiffusedLight.h"

namespace tessera::viewer {
namespace {

using scenes::SubsurfaceMethod;

constexpr int kIdlePictures = 3;

class DiffusedLightTest : public testing::Test {
protected:
    DiffusedLightTest() {
        scenes::Material skin;
        skin.subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
        scene_.materials.push_back(skin);
        scene_.meshes.emplace_back().indices = {0, 1, 2};
        scene_.nodes.emplace_back().instances.push_back({.mesh = 0, .material = 0});
    }
    bool isAnew(const Look& look, std::uint64_t edits = 0) const { return known_.isAnew(scene_, {&look, 1}, edits); }
    void draw(const Look& look, std::uint64_t edits = 0) {
        if (isAnew(look, edits)) known_.forget();
        known_.drew(scene_, {&look, 1}, edits, kIdlePictures);
    }

    scenes::Scene scene_;
    DiffusedLight known_;
};

TEST_F(DiffusedLightTest, aSceneThatDiffusesNoneNeedsNone) {
    EXPECT_TRUE(isAnew({}));
    Look off;
    off.settings.subsurface = SubsurfaceMethod::None;
    EXPECT_FALSE(isAnew(off));
    scene_.nodes.clear();
    EXPECT_FALSE(isAnew({}));
}

TEST_F(DiffusedLightTest, whatWasDrawnIsKeptUntilWhatEntersChanges) {
    Look look;
    look.settings.diffusion.sideTexels = 512;
    draw(look);
    EXPECT_FALSE(isAnew(look));
    EXPECT_TRUE(isAnew(look, 1)) << "a light or a material was edited";

    Look moved = look;
    moved.technique = engine::Technique::Forward;
    moved.settings.camera = 1;
    moved.settings.sizePixels = {64, 48};
    moved.settings.specular = false;
    moved.settings.exposureEV = 2.0f;
    moved.settings.toneMap = frame::ToneMap::None;
    EXPECT_FALSE(isAnew(moved));

    const auto changed = [&](auto change) {
        Look other = look;
        change(other.settings);
        return isAnew(other);
    };
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.timeSeconds = 1.0; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.environment.rotationDegrees = 1.0f; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.environment.light = frame::EnvironmentLight::Sampled; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.soloLight = 0; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.shadowFilter = frame::ShadowFilter::Hard; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.diffusion.sideTexels = 1024; }));
    EXPECT_TRUE(changed([](frame::FrameSettings& its) { its.diffusion.gaussians = 2; }));
}

TEST_F(DiffusedLightTest, smallAtlasesTakeThePlaceOfWhatIsKept) {
    Look before, edited;
    edited.settings.diffusion.gaussians = 2;
    draw(before);
    known_.forget(); // while a slider is dragged
    EXPECT_TRUE(isAnew(edited));
    EXPECT_TRUE(isAnew(before)) << "going back needs it anew";
}

TEST_F(DiffusedLightTest, anotherViewNeedsNoneAndLosesItOnlyAfterAWhile) {
    Look lit, normals;
    normals.settings.view = frame::DebugView::Normal;
    EXPECT_FALSE(isAnew(normals));
    draw(lit);
    for (int picture = 0; picture < kIdlePictures; ++picture) {
        EXPECT_FALSE(isAnew(lit));
        draw(normals);
        EXPECT_FALSE(isAnew(normals));
    }
    EXPECT_FALSE(isAnew(lit));
    draw(normals);
    EXPECT_TRUE(isAnew(lit)) << "the renderer dropped it";
}

TEST_F(DiffusedLightTest, twoSidesShareOne) {
    std::array<Look, 2> sides;
    const auto isAnewForBoth = [&] { return known_.isAnew(scene_, sides, 0); };
    known_.drew(scene_, sides, 0, kIdlePictures);
    EXPECT_FALSE(isAnewForBoth());
    sides[0].technique = engine::Technique::Forward;
    EXPECT_FALSE(isAnewForBoth());
    sides[0].settings.subsurface = SubsurfaceMethod::None;
    EXPECT_FALSE(isAnewForBoth()) << "only the right side diffuses light";
    sides[0] = sides[1];
    sides[0].settings.diffusion.gaussians = 1;
    known_.drew(scene_, sides, 0, kIdlePictures);
    EXPECT_TRUE(isAnewForBoth()) << "each picture replaces what the other side needs";
}

TEST_F(DiffusedLightTest, slicesDiffuseTheLightThatAllSidesShare) {
    std::array<Look, 2> sides;
    sides[0].settings.subsurface = SubsurfaceMethod::None;
    sides[1].settings.camera = 3;
    ASSERT_TRUE(sharedDiffusion(scene_, sides));
    EXPECT_EQ(*sharedDiffusion(scene_, sides), sides[1]) << "the other side diffuses none";
    sides[0] = {};
    EXPECT_TRUE(sharedDiffusion(scene_, sides)) << "cameras do not matter";
    sides[0].settings.diffusion.gaussians = 1;
    EXPECT_FALSE(sharedDiffusion(scene_, sides)) << "each needs its own";
    scene_.nodes.clear();
    EXPECT_FALSE(sharedDiffusion(scene_, sides));
}

TEST(DiffusionPace, followsWhatSlicesTake) {
    DiffusionPace pace;
    EXPECT_EQ(pace.tiles(), 1u);
    pace.took(1.0);
    EXPECT_EQ(pace.tiles(), 2u) << "twice at most";
    for (int slice = 0; slice < 20; ++slice) pace.took(1.0 * double(pace.tiles()));
    EXPECT_NEAR(double(pace.tiles()), 80.0, 4.0) << "of 1 ms a tile";
    for (int slice = 0; slice < 20; ++slice) pace.took(1e4);
    EXPECT_GE(pace.tiles(), 1u);
    for (int slice = 0; slice < 40; ++slice) pace.took(0.0);
    EXPECT_LE(pace.tiles(), 1u << 20) << "has an end";
    DiffusionPace ofLargeMesh;
    for (int slice = 0; slice < 30; ++slice) ofLargeMesh.took(500.0 + 1.0 * double(ofLargeMesh.tiles()));
    EXPECT_NEAR(double(ofLargeMesh.tiles()), 502.0, 5.0) << "small slices would cost the mesh again and again";
}

} // namespace
} // namespace tessera::viewer
