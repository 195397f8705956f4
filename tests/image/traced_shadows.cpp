#include <cmath>

#include <fmt/format.h>

#include "tests/image/ShadowTest.h"
#include "tests/support/GlContext.h"
#include "tests/support/ShaderMutant.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using test::kAllLightsCast, test::kShadowCases, test::sceneOf, test::ShadowCase, test::WrongPixels, test::wrongPixels;

class Shadows : public test::ShadowTest {};

TEST_F(Shadows, everyTechniqueCastsTheSameToTheLastBit) {
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {201, 113};
        settings.shadows = tried.shadows;
        SCOPED_TRACE(tried.scene);
        expectParity(renderer, settings);
    }
}

TEST_F(Shadows, everyTechniqueCastsTheSameOnMaskedAndTransparentSurfacesAndWithSeveralSamples) {
    const scenes::Scene scene = test::everythingScene();
    engine::Renderer renderer(context(), scene);
    for (const int samples : {1, 4}) {
        frame::FrameSettings settings;
        settings.sizePixels = {160, 90};
        settings.samples = samples;
        settings.shadows = kAllLightsCast;
        expectParity(renderer, settings);
    }
}

// Beside a triangle of one pixel, the rasteriser runs invocations whose rays meet all boxes of the tree.
TEST_F(Shadows, aPixelIsLitByAllItsLightsWhateverIsRunBesideIt) {
    const scenes::Scene scene = scenes::loadScene("hall");
    frame::FrameSettings settings;
    settings.sizePixels = {980, 778};
    engine::Renderer renderer(context(), scene);
    const auto radiance = renderer.render(engine::Technique::ClusteredForward, settings).radiance;
    EXPECT_EQ(radiance, renderer.render(engine::Technique::ClusteredDeferred, settings).radiance);
    // Where such rays are walked after all, Mesa ends the pixel's loops: it is NaN, and not dark.
    const test::ShaderMutant shaders;
    shaders.replace("lib/shadow/caster_walk.glsl", "isBehind || IS_HELPER ?", "isBehind ?");
    engine::Renderer faulty(context(), scene, shaders.tree());
    const auto ended = faulty.render(engine::Technique::ClusteredForward, settings).radiance;
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < ended.size(); ++i) {
        if (ended[i] == radiance[i]) continue;
        EXPECT_TRUE(std::isnan(ended[i]));
        ++unlike;
    }
    EXPECT_GT(unlike, 0u) << "nothing was run beside a pixel";
}

TEST_F(Shadows, noPixelIsWrongBeyondRounding) {
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = test::settingsOf(tried);
        const WrongPixels count = wrongPixels(renderer, settings);
        fmt::print("{}: {} pixels wrong, {} undecided, {} changed by shadows of {}\n", tried.scene, count.wrong,
                   count.undecided, count.hidden, count.covered);
        EXPECT_EQ(count.wrong, 0u) << tried.scene;
        EXPECT_LE(count.wrongWithout, count.covered / 1000) << tried.scene;
        EXPECT_LE(double(count.undecided), 1.5 * tried.undecidedShare * double(count.covered)) << tried.scene;
        EXPECT_GE(count.hidden, count.covered / 200) << tried.scene << ": nothing to see";
    }
}

// In the light of all, what is wrong with a dim one would not be seen.
TEST_F(Shadows, ofEachLightOfTheHallAloneNoPixelIsWrong) {
    const ShadowCase& hall = kShadowCases[2];
    const scenes::Scene scene = sceneOf(hall);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = test::settingsOf(hall);
    settings.sizePixels = {120, 68};
    WrongPixels all;
    int lights = 0;
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
        if (!scenes::castsShadow(scene, light, hall.shadows)) continue;
        settings.soloLight = int(light);
        const WrongPixels count = wrongPixels(renderer, settings);
        EXPECT_EQ(count.wrong, 0u) << "light " << light;
        all += count;
        ++lights;
    }
    fmt::print("{} lights: {} pixels wrong, {} undecided, {} changed by shadows of {} reached\n", lights, all.wrong,
               all.undecided, all.hidden, all.reached);
    EXPECT_EQ(lights, 17);
    // Measured: 0.48 %.
    EXPECT_LE(double(all.undecided), 0.0072 * double(all.reached));
    EXPECT_LE(all.wrongWithout, all.covered / 1000);
    EXPECT_GE(all.hidden, all.reached / 2) << "nothing to see";
}

TEST_F(Shadows, noPixelOfMaskedMirroredAndTexturedSurfacesIsWrong) {
    const scenes::Scene scene = test::everythingScene();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {240, 135};
    settings.filter = frame::TextureFilter::Exact;
    settings.shadows = kAllLightsCast;
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("everything: {} pixels wrong, {} undecided, {} changed by shadows of {}\n", count.wrong, count.undecided,
               count.hidden, count.covered);
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.wrongWithout, count.covered / 1000);
    // Measured: 0.50 %.
    EXPECT_LE(double(count.undecided), 0.0075 * double(count.covered));
    EXPECT_GE(count.hidden, count.covered / 20);
}

TEST_F(Shadows, noSunPutsAcneOnASphereAndAPlane) {
    scenes::Scene scene = test::ballUnderSun();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.shadows = kAllLightsCast;
    constexpr int kDirections = 1000;
    std::size_t wrong = 0, undecided = 0, covered = 0;
    for (int i = 0; i < kDirections; ++i) {
        scene.lights[0].directionWS = test::sunDirection(i, kDirections);
        const WrongPixels count = wrongPixels(renderer, settings);
        wrong += count.wrong;
        undecided += count.undecided;
        covered += count.covered;
    }
    fmt::print("{} suns: {} pixels wrong, {} undecided of {}\n", kDirections, wrong, undecided, covered);
    EXPECT_EQ(wrong, 0u);
    // Measured: 0.08 %.
    EXPECT_LE(double(undecided), 0.0012 * double(covered));
}

} // namespace
} // namespace tessera
