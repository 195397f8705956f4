// A ball of one paint is as bright in coarse layouts as in fp32, in any colour. Rough enough that second-order effects
// of alpha's step stay below the limit: perceptual roughness 0.5, half of that where a texture varies it.

#include "tests/image/ImageTest.h"
#include "tests/support/Random.h"
#include "validation/figures/ErrorFigures.h"
#include "validation/figures/Tolerance.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

scenes::Material randomPaint(Random& random) {
    scenes::Material paint;
    paint.baseColor = {random.unit(), random.unit(), random.unit(), 1.0f};
    paint.metallic = float(random.unit());
    paint.perceptualRoughness = float(random.between(0.5, 1.0));
    paint.ior = float(random.between(1.3, 2.0));
    return paint;
}

/// Varies colours, roughness and metallic over the surface, independently.
void vary(scenes::Scene& scene, Random& random) {
    for (const scenes::TextureSlot slot : {scenes::TextureSlot::BaseColor, scenes::TextureSlot::MetallicRoughness}) {
        scenes::Image& image = scene.images.emplace_back();
        image.name = "paint";
        image.width = image.height = 16;
        for (int i = 0; i < 16 * 16 * 4; ++i) image.texels.push_back(std::byte(random.between(120.0, 255.0)));
        scene.materials[0].texture(slot).image = int(scene.images.size()) - 1;
    }
}

scenes::Scene ballOf(const scenes::Material& paint) {
    scenes::Scene scene = quadScene(paint);
    scene.meshes = {everythingScene().meshes[1]};
    scene.meshes[0].colors.clear();
    scenes::Light sun = sunLight(glm::dvec3(-0.4, -0.7, -1.0));
    scene.lights = {sun, pointLight({-1.5, 0.5, 2.0}, 3.0f)};
    scene.cameras[0].fovYRadians = 0.8;
    return scene;
}

class OnePaint : public ImageTest {};

TEST_F(OnePaint, aBallIsAsBrightInACoarseLayoutAsInFp32) {
    Random random(31);
    for (int i = 0; i < 16; ++i) {
        scenes::Scene scene = ballOf(randomPaint(random));
        const bool varies = i % 2 == 1;
        if (varies) vary(scene, random);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(320, 320);
        const Picture exact = engine::toPicture(renderer.render(Technique::Deferred, settings));
        for (const frame::LayoutInfo& layout : frame::layoutTable().subspan(1)) {
            settings.layout = layout.layout;
            const Picture coarse = engine::toPicture(renderer.render(Technique::Deferred, settings));
            const validation::ErrorFigures figures = validation::errorFigures(coarse, exact);
            SCOPED_TRACE(fmt::format("paint {} {}", i, layout.name));
            fmt::print("paint {}{} {}: bias {:.2e}, relMse {:.2e}, p99.9 {:.2e}\n", i, varies ? " varying" : "",
                       layout.name, figures.bias, figures.relMse, figures.p999Rel);
            EXPECT_GT(figures.litShare, 0.1);
            EXPECT_LE(std::abs(figures.bias), 1e-4);
        }
    }
}

/// A step of alpha relative to alpha, if stored in so many bits as equal steps of its fourth root.
double stepOfAlpha(float alpha, int bits) {
    return 4.0 * (1.0 - std::pow(1e-3, 0.25)) / ((1 << bits) - 1) / std::pow(double(alpha), 0.25);
}

scenes::Material polishedBlack(float alpha) {
    scenes::Material polished = materialOf(scenes::MaterialModel::Microfacet, {0.0f, 0.0f, 0.0f, 1.0f});
    polished.alpha = alpha;
    polished.ior = 1.5f; // which the G-buffer stores exactly
    return polished;
}

/// Radiance scales at most with 1/alpha^2, in the peak, or with alpha^2, far from it; so a step of alpha changes it by
/// two relative steps. A 15-bit normal adds the rotation of the highlight, up to 1.5/alpha per radian.
TEST_F(OnePaint, aNarrowHighlightIsNoMoreThanAStepOff) {
    for (const float alpha : {0.0300f, 0.0551f, 0.0800f}) {
        const scenes::Scene scene = ballOf(polishedBlack(alpha));
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(120, 120);
        const Picture exact = engine::toPicture(renderer.render(Technique::Deferred, settings));
        settings.layout = frame::layoutTable()[1].layout;
        const Picture coarse = engine::toPicture(renderer.render(Technique::Deferred, settings));
        const validation::RadianceFigures figures = validation::radianceFigures(coarse, exact);
        const double step = stepOfAlpha(alpha, 11), turned = 1.5 / double(alpha) * 2.0 / 32767.0;
        fmt::print("alpha {}: max {:.2e}, p99 {:.2e}, a step is {:.2e}, turned {:.2e}\n", alpha, figures.maxRel,
                   figures.p99Rel, step, turned);
        EXPECT_LE(figures.p99Rel, 2.0 * step + turned); // normals are off in a few pixels at the terminator
        EXPECT_GT(figures.p99Rel, 0.0);
    }
}

/// A floor whose highlight is outside of the image has the same error of alpha everywhere.
TEST_F(OnePaint, aHighlightBesideThePictureIsAsBrightInTheMean) {
    for (const float alpha : {0.0123f, 0.0307f, 0.0551f, 0.0999f}) {
        scenes::Scene scene = quadScene(polishedBlack(alpha));
        scenes::Light sun = sunLight(glm::dvec3(-0.6, -0.1, -1.0));
        scene.lights = {sun};
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(128, 128);
        const Picture exact = engine::toPicture(renderer.render(Technique::Deferred, settings));
        for (const auto& [place, bits] : {std::pair(1, 11), std::pair(2, 8)}) {
            const frame::LayoutInfo& layout = frame::layoutTable()[std::size_t(place)];
            settings.layout = layout.layout;
            const Picture coarse = engine::toPicture(renderer.render(Technique::Deferred, settings));
            const validation::RadianceFigures figures = validation::radianceFigures(coarse, exact);
            const double step = stepOfAlpha(alpha, bits);
            fmt::print("alpha {}, {}: bias {:+.1e}, p99 {:.1e}, a step is {:.1e}\n", alpha, layout.name, figures.bias,
                       figures.p99Rel, step);
            // alpha^2 has a second derivative, and a dithered value a variance of at most a quarter of a step's square.
            // The mean over 16384 pixels adds 1e-4; the 10-bit normals of slim add 1e-3.
            EXPECT_LE(std::abs(figures.bias), 0.25 * step * step + (place == 1 ? 1e-4 : 1e-3));
        }
    }
}

/// A streak covers much of the ball, so its steps affect more pixels than those of a round highlight.
TEST_F(OnePaint, aStreakOnABallKeepsThePromiseOfEveryCoarseLayout) {
    for (const auto& [along, across] : {std::pair(0.5f, 0.02f), std::pair(0.5f, 0.08f), std::pair(0.16f, 0.5f)}) {
        scenes::Material brushed = materialOf(scenes::MaterialModel::MicrofacetAnisotropic,
                                              {0.0f, 0.0f, 0.0f, 1.0f}); // only the highlight reflects
        brushed.alpha = along;
        brushed.alphaY = across;
        brushed.ior = 2.5f;
        const scenes::Scene scene = ballOf(brushed);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(120, 120);
        const Picture exact = engine::toPicture(renderer.render(Technique::Deferred, settings));
        for (const frame::LayoutInfo& layout : frame::layoutTable().subspan(1)) {
            settings.layout = layout.layout;
            const Picture coarse = engine::toPicture(renderer.render(Technique::Deferred, settings));
            const validation::ErrorFigures figures = validation::errorFigures(coarse, exact);
            SCOPED_TRACE(fmt::format("alphas {} and {}, {}", along, across, layout.name));
            fmt::print("alphas {} and {}, {}: bias {:.2e}, relMse {:.2e}\n", along, across, layout.name, figures.bias,
                       figures.relMse);
            EXPECT_LE(figures.relMse, layout.promise.relMse);
            EXPECT_LE(std::abs(figures.bias), layout.promise.bias + validation::kBiasNoises * figures.biasNoise);
        }
    }
}

} // namespace
} // namespace tessera
