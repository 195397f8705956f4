// Mirror reflections of an environment against its map, looked up in double precision.
#include <numbers>

#include "shaders/shared/environment.h"
#include "shaders/shared/models.h"
#include "tests/image/PlaneUnderSky.h"
#include "validation/reference/Microfacet.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using namespace test;

class EnvironmentMirrors : public EnvironmentTest {};

constexpr int kMirrorPixels = 64;
constexpr TiltedPlane kMirror{0.35, 50.0, 1.4, kMirrorPixels};
constexpr double kSunRadiance = 1e5;

glm::dvec3 mirroredByPixel(int x, int y) {
    const glm::dvec3 toViewer = kMirror.toViewer(x, y), normal = kMirror.normal();
    return 2.0 * glm::dot(normal, toViewer) * normal - toViewer;
}

/// Squares of 8 x 8 texels.
double squaresAt(int x, int y) {
    return (x / 8 + y / 8) % 2 == 0 ? 1.0 : 0.05;
}

/// A sky with a sun in the texel that the centre of a pixel mirrors.
SkyRadiance sunShownBy(int pixelX, int pixelY) {
    const glm::ivec2 sun(scenes::placeInMap(mirroredByPixel(pixelX, pixelY)) * glm::dvec2(kSkyWidth, kSkyHeight));
    return [sun](int x, int y) { return x == sun.x && y == sun.y ? kSunRadiance : 0.1; };
}

double schlickFactor(double straight, double cosine) {
    return straight + (1.0 - straight) * std::pow(1.0 - cosine, 5);
}

struct MirrorCase {
    std::string name;
    scenes::Material material;
    std::function<double(double cosView)> reflected;
};

/// Each kind of lobe above black.
std::vector<MirrorCase> mirrorCases() {
    using scenes::MaterialModel;
    const scenes::Material black = blackDielectric();
    scenes::Material metal = metalOf(0.0);
    metal.baseColor = glm::vec4(glm::vec3(0.7f), 1.0f);
    scenes::Material coated = black;
    coated.specularFactor = 0.0f; // the coat alone reflects
    coated.perceptualRoughness = 0.5f;
    coated.clearcoat = 0.75f;
    coated.clearcoatPerceptualRoughness = 0.0f;
    scenes::Material varnished = metal;
    varnished.clearcoat = 1.0f;
    varnished.clearcoatPerceptualRoughness = 0.0f;
    scenes::Material glass = black;
    glass.model = MaterialModel::Microfacet;
    glass.alpha = glass.alphaY = 0.0f;
    glass.specularColor = glm::vec3(0.9f);
    glass.ior = 1.5f;
    scenes::Material brushed = glass;
    brushed.model = MaterialModel::MicrofacetAnisotropic;
    scenes::Material water = glass; // seen from below
    water.ior = 0.75f;
    const auto ofMetal = [](double cosine) { return schlickFactor(double(0.7f), cosine); };
    const auto ofGlass = [](double ior) {
        return [ior](double cosine) { return double(0.9f) * reference::fresnelDielectric(ior, cosine); };
    };
    return {{"metal", metal, ofMetal},
            {"a coat", coated, [](double cosine) { return 0.75 * schlickFactor(0.04, cosine); }},
            {"a coat over metal", varnished,
             [=](double cosine) {
                 const double coat = schlickFactor(0.04, cosine);
                 return coat + (1.0 - coat) * ofMetal(cosine);
             }},
            {"microfacet", glass, ofGlass(1.5)},
            {"microfacet_anisotropic", brushed, ofGlass(1.5)},
            {"microfacet, ior 0.75", water, ofGlass(0.75)}};
}

constexpr EnvironmentLight kBothLights[] = {EnvironmentLight::SplitSum, EnvironmentLight::Sampled};

TEST_SWEEP(EnvironmentMirrors, everyLobeOfRoughnessZeroShowsTheMapTimesFresnelsFactorToRounding) {
    std::size_t turn = 0;
    const std::pair<const char*, SkyRadiance> maps[] = {{"squares", squaresAt}, {"a sun", sunShownBy(40, 20)}};
    for (const MirrorCase& one : mirrorCases()) {
        ++turn;
        for (const auto& [name, map] : maps) {
            scenes::Scene scene = kMirror.sceneOf(one.material);
            scene.environment = skyOf(map);
            engine::Renderer renderer(context(), scene);
            for (const EnvironmentLight how : inTurn(kBothLights, turn)) {
                frame::FrameSettings settings = ofSize(kMirrorPixels, kMirrorPixels);
                settings.environment.light = how;
                settings.environment.samples = 1;
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                int judged = 0;
                double brightest = 0.0;
                for (int y = 0; y < kMirrorPixels; ++y)
                    for (int x = 0; x < kMirrorPixels; ++x) {
                        const float* const pixel = &seen[std::size_t(4 * (y * kMirrorPixels + x))];
                        const double cosView = glm::dot(kMirror.normal(), kMirror.toViewer(x, y));
                        // Excludes the onset of total reflection, which amplifies rounding.
                        if (pixel[3] == 0.0f || cosView < 0.02 || std::abs(cosView * cosView - 0.4375) < 1e-4) continue;
                        const SeenSky truth = seenOfSky(map, mirroredByPixel(x, y));
                        const double share = one.reflected(cosView);
                        // Angles in fp32 are good to 1e-5, a thousandth of a texel.
                        const double error = share * (2e-3 * (truth.most - truth.least) + 1e-4 * truth.radiance);
                        ASSERT_NEAR(pixel[0], share * truth.radiance, error)
                            << one.name << ", " << name << ", " << infoOf(how).name << " at " << x << ", " << y;
                        ++judged;
                        brightest = std::max(brightest, truth.radiance);
                    }
                EXPECT_GT(judged, kMirrorPixels * kMirrorPixels * 9 / 10) << one.name;
                EXPECT_GT(brightest, map(0, 0) > 0.5 ? 0.99 : 0.1 * kSunRadiance) << "the sun is in view";
            }
        }
    }
}

/// Sampled light keeps the lobe; no filtered level is as sharp, so the split sum reads the map.
TEST_F(EnvironmentMirrors, aHighlightOfAHugeExponentShowsTheMapTimesWhatItReflectsOfEvenLight) {
    constexpr double kExponent = 1e8;
    scenes::Material gloss = materialOf(scenes::MaterialModel::BlinnPhong);
    gloss.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    gloss.exponent = float(kExponent);
    gloss.specularColor = glm::vec3(1e6f);
    scenes::Scene scene = kMirror.sceneOf(gloss);
    scene.environment = skyOf(squaresAt);
    frame::FrameSettings settings = ofSize(kMirrorPixels, kMirrorPixels);
    const std::vector<float> seen = drawn(scene, settings);
    int judged = 0;
    for (int y = 0; y < kMirrorPixels; ++y)
        for (int x = 0; x < kMirrorPixels; ++x) {
            const double cosView = glm::dot(kMirror.normal(), kMirror.toViewer(x, y));
            if (seen[std::size_t(4 * (y * kMirrorPixels + x) + 3)] == 0.0f || cosView < 0.1) continue;
            const SeenSky truth = seenOfSky(squaresAt, mirroredByPixel(x, y));
            const double share = 1e6 * 8.0 * std::numbers::pi * cosView / kExponent; // (n.h)^p over 4 n.v dh
            // Half a percent for the table.
            const double error = share * (2e-3 * (truth.most - truth.least) + 5e-3 * truth.radiance);
            ASSERT_NEAR(seen[std::size_t(4 * (y * kMirrorPixels + x))], share * truth.radiance, error)
                << x << ", " << y;
            ++judged;
        }
    EXPECT_GT(judged, kMirrorPixels * kMirrorPixels / 2);
}

/// Normals of a ball are interpolated between vertices that rasterisers round to 1/256 of a pixel.
TEST_SWEEP(EnvironmentMirrors, aBallShowsWhatTheReferenceShowsOfIt) {
    std::size_t turn = 0;
    constexpr int kBallPixels = 40;
    for (const MirrorCase& one : mirrorCases()) {
        scenes::Scene scene = ballUnderSky(one.material);
        scene.environment = skyOf(squaresAt);
        scene.environment->rotationDegrees = 30.0f;
        frame::FrameSettings settings = exactOfSize(kBallPixels, kBallPixels);
        settings.environment.samples = 1;
        settings.environment.backdrop = frame::Backdrop::Off;
        const validation::ReferencePicture truth = strictReference(scene, settings);
        engine::Renderer renderer(context(), scene);
        for (const EnvironmentLight how : inTurn(kBothLights, turn++)) {
            settings.environment.light = how;
            const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
            double shown = 0.0, wanted = 0.0;
            for (int y = 0; y < kBallPixels; ++y)
                for (int x = 0; x < kBallPixels; ++x) {
                    const glm::dvec2 at = 1.02 * (glm::dvec2(2.0 * x + 1.0 - kBallPixels, kBallPixels - 1.0 - 2.0 * y) /
                                                  double(kBallPixels));
                    if (glm::dot(at, at) > 0.6) continue; // further out, a pixel covers much of the map
                    const double cosView = std::sqrt(1.0 - glm::dot(at, at));
                    if (std::abs(2.0 * cosView * at.y) > 0.9) continue; // columns are narrow near the poles
                    const auto i = std::size_t(4 * (y * kBallPixels + x));
                    // A tenth of a texel; total reflection begins abruptly.
                    const double error = 0.1 * one.reflected(cosView) + (one.material.ior < 1.0f ? 0.1 : 0.0);
                    ASSERT_NEAR(seen[i], truth.picture.rgba[i], error)
                        << one.name << ", " << infoOf(how).name << " at " << x << ", " << y;
                    shown += double(seen[i]);
                    wanted += double(truth.picture.rgba[i]);
                }
            EXPECT_GT(wanted, 0.0);
            EXPECT_NEAR(shown, wanted, 5e-3 * wanted) << one.name << ", " << infoOf(how).name;
        }
    }
}

TEST_SWEEP(EnvironmentMirrors, everyTechniqueGivesTheSamePictureAndPruningChangesNoBit) {
    std::size_t turn = 0;
    scenes::Scene scene = ballUnderSky({});
    scenes::Material& material = scene.materials[0];
    material.metallic = 0.5f;
    material.clearcoat = 0.5f;
    scene.environment = skyOf(sunShownBy(40, 20));
    frame::FrameSettings settings = ofSize(48, 48);
    settings.environment.samples = 4;
    struct Case {
        float roughness, coatRoughness;
        EnvironmentLight how;
    };
    for (const Case& one : {Case{0.0f, 0.0f, EnvironmentLight::SplitSum},
                            {0.0f, 0.0f, EnvironmentLight::Sampled},
                            {0.07f, 0.2f, EnvironmentLight::SplitSum},
                            {0.11f, 0.11f, EnvironmentLight::SplitSum}}) { // too rough to read the map
        SCOPED_TRACE(fmt::format("{}, roughness {} and {}", infoOf(one.how).name, one.roughness, one.coatRoughness));
        material.perceptualRoughness = one.roughness;
        material.clearcoatPerceptualRoughness = one.coatRoughness;
        settings.environment.light = one.how;
        engine::Renderer renderer(context(), scene);
        expectParity(renderer, settings,
                     one.roughness == 0.0f ? techniquesInTurn(turn++) : std::vector{Technique::Deferred});
        if (!isWholeSweep() && one.how == EnvironmentLight::SplitSum && one.roughness != 0.07f) continue;
        expectPruningIsUnseen(renderer, settings);
    }
}

/// Between the map and its first filtered level, and where programs stop reading the map.
TEST_F(EnvironmentMirrors, lightOfTheSplitSumIsContinuousInAlpha) {
    scenes::Material gloss = materialOf(scenes::MaterialModel::Microfacet);
    gloss.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    scenes::Scene scene = kMirror.sceneOf(gloss);
    scene.environment = skyOf(squaresAt);
    frame::FrameSettings settings = ofSize(kMirrorPixels, kMirrorPixels);
    const auto radiance = [&](double alpha) {
        scene.materials[0].alpha = float(alpha);
        return drawn(scene, settings);
    };
    for (const double alpha : {ALPHA_MIN, 0.003, ENVIRONMENT_LEAST_ALPHA, 1.1 * ENVIRONMENT_LEAST_ALPHA}) {
        const std::vector<float> below = radiance(0.9999 * alpha), above = radiance(1.0001 * alpha);
        double most = 0.0;
        for (std::size_t i = 0; i < below.size(); ++i) most = std::max(most, double(std::abs(below[i] - above[i])));
        EXPECT_LE(most, 1e-4) << alpha;
    }
    EXPECT_NE(radiance(ALPHA_MIN), radiance(ENVIRONMENT_LEAST_ALPHA));
}

TEST_F(EnvironmentMirrors, onlyWhatMayBeAMirrorReadsTheMapItself) {
    scenes::Scene scene = kMirror.sceneOf({});
    scene.environment = skyOf(squaresAt);
    frame::FrameSettings settings;
    settings.environment.backdrop = frame::Backdrop::Off;
    const auto readsMap = [&](float roughness) {
        scene.materials[0].perceptualRoughness = roughness;
        const graph::Plan plan = engine::planFrame(scene, Technique::Deferred, settings);
        return planText(plan).find("environment_map") != std::string::npos;
    };
    EXPECT_TRUE(readsMap(0.0f));
    EXPECT_TRUE(readsMap(0.1f));
    EXPECT_FALSE(readsMap(0.2f));
    settings.environment.light = EnvironmentLight::Off;
    EXPECT_FALSE(readsMap(0.0f));
}

} // namespace
} // namespace tessera
