#include "scenes/builtin/ShadowTruth.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/reference/CameraRays.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::ShadowRequest;
using namespace test;

/// The ground of the scene `shadow_truth` in the view `shadow`: the visible fractions of one light, beside their closed
/// forms.
class SoftShadows : public ShadowTest {
protected:
    using TruthLight = scenes::builtin::ShadowTruthLight;
    struct Share {
        double seen, truth;
    };

    static scenes::Scene truthScene() {
        scenes::Scene scene = scenes::loadScene("shadow_truth");
        // Below the plate, and above the ground in the disk's shadow.
        scenes::Camera& camera = scene.cameras[0];
        makeOrthographic(camera, 0.4);
        return scene;
    }
    /// Aims the camera at the light's shadow.
    static void aimAt(scenes::Scene& scene, TruthLight light) {
        const glm::dvec3 targetWS =
            light == TruthLight::Lamp ? glm::dvec3(-2.55, 0.0, 0.0) : glm::dvec3(2.56, 0.0, 0.24);
        scene.cameras[0].worldFromCamera = scenes::worldFromLookAt(targetWS + glm::dvec3(0.4, 0.9, 3.0), targetWS);
    }

    static std::vector<Share> sharesOf(const scenes::Scene& scene, TruthLight light, const glm::ivec2& sizePixels,
                                       const auto& seenAt, double sizes = 1.0) {
        const reference::CameraRays rays(scene.cameras[0], sizePixels);
        reference::Settings settings;
        settings.sizePixels = sizePixels;
        settings.camera = scene.cameras[0];
        const reference::Probe probe(scene, settings);
        std::vector<Share> shares;
        for (int y = 0; y < sizePixels.y; ++y)
            for (int x = 0; x < sizePixels.x; ++x) {
                if (probe.at(glm::dvec2(x + 0.5, y + 0.5)).ids.object != 1) continue; // not the ground
                const reference::Ray ray = rays.through(x, y);
                const double depth = -(rays.eyeWS().y + ray.originRWS.y) / ray.direction.y;
                const glm::dvec3 groundWS = rays.eyeWS() + ray.at(depth);
                const bool isKnown =
                    light == TruthLight::Lamp ? std::abs(groundWS.z) < 1.5 && groundWS.x > -4.0 : groundWS.x > 0.5;
                if (isKnown) shares.push_back({seenAt(x, y), shadowTruthShare(light, groundWS, sizes)});
            }
        return shares;
    }

    std::vector<Share> rendered(engine::Renderer& renderer, TruthLight light, int samples,
                                frame::ShadowFilter filter = frame::ShadowFilter::Traced, double sizes = 1.0) {
        frame::FrameSettings settings;
        settings.shadowFilter = filter;
        settings.sizePixels = {256, 144};
        settings.view = frame::DebugView::Shadow;
        settings.soloLight = int(light);
        settings.shadowSamples = samples;
        const engine::RenderedFrame frame = renderer.render(Technique::Deferred, settings);
        return sharesOf(
            renderer.scene(), light, settings.sizePixels,
            [&](int x, int y) { return double(frame.radiance[4 * (std::size_t(y) * 256 + std::size_t(x))]); }, sizes);
    }
};

double rootMeanSquare(const auto& shares) {
    double sum = 0.0;
    for (const auto& [seen, truth] : shares) sum += (seen - truth) * (seen - truth);
    return std::sqrt(sum / double(shares.size()));
}

TEST_F(SoftShadows, haveTheSharesOfTheirClosedFormsWithinThreeStandardErrors) {
    for (const TruthLight light : {TruthLight::Lamp, TruthLight::Sun}) {
        scenes::Scene scene = truthScene();
        aimAt(scene, light);
        engine::Renderer renderer(context(), scene);
        for (const int samples : {1, 16, 64}) {
            const std::vector<Share> shares = rendered(renderer, light, samples);
            constexpr int kBins = 8;
            int checked = 0;
            for (int bin = 0; bin < kBins; ++bin) {
                double sum = 0.0, squares = 0.0;
                int count = 0;
                for (const auto& [seen, truth] : shares) {
                    if (truth <= 0.0 || truth >= 1.0 || int(truth * kBins) != bin) continue;
                    sum += seen - truth;
                    squares += (seen - truth) * (seen - truth);
                    ++count;
                }
                if (count < 100) continue;
                ++checked;
                const double mean = sum / count, standardError = std::sqrt((squares / count - mean * mean) / count);
                EXPECT_LE(std::abs(mean), 3.0 * standardError)
                    << int(light) << ", " << samples << " samples, shares from " << double(bin) / kBins;
            }
            EXPECT_GE(checked, 6);
            fmt::print("light {}, {} samples: RMS {:.5f} of {} pixels\n", int(light), samples, rootMeanSquare(shares),
                       shares.size());
        }
    }
}

// The plate and the disk are flat and perpendicular to the light's direction, as pcss assumes of all casters.
TEST_F(SoftShadows, ofPcssHaveTheWidthsOfTheirClosedForms) {
    for (const TruthLight light : {TruthLight::Lamp, TruthLight::Sun})
        for (const double sizes : {0.25, 0.5, 1.0, 2.0}) {
            scenes::Scene scene = truthScene();
            aimAt(scene, light);
            scenes::Light& changed = scene.lights[std::size_t(light)];
            changed.radiusMetres *= float(sizes);
            changed.angularRadiusRadians = float(std::atan(sizes * std::tan(double(changed.angularRadiusRadians))));
            engine::Renderer renderer(context(), scene);
            for (const int samples : {4, 16, 64}) {
                const auto shares = rendered(renderer, light, samples, frame::ShadowFilter::Pcss, sizes);
                std::size_t wide = 0, wideTruth = 0;
                for (const auto& [seen, truth] : shares) {
                    wide += seen > 0.1 && seen < 0.9;
                    wideTruth += truth > 0.1 && truth < 0.9;
                }
                const double width = double(wide) / double(wideTruth);
                fmt::print("pcss, light {}, {} of its size, {} samples: RMS {:.4f}, {:.2f} as wide\n", int(light),
                           sizes, samples, rootMeanSquare(shares), width);
                if (samples < 64) continue;
                EXPECT_NEAR(width, 1.0, 0.03) << int(light) << ", " << sizes;
                EXPECT_LT(rootMeanSquare(shares), 0.03) << int(light) << ", " << sizes;
            }
        }
}

// Noise of independent lights averages out in their sum. The correlation coefficient of N independent pairs deviates by
// 1/sqrt(N).
TEST_F(SoftShadows, ofTwoLightsInOnePlaceHaveNoiseThatIsNotCorrelated) {
    scenes::Scene scene = truthScene();
    aimAt(scene, TruthLight::Lamp);
    scene.lights.push_back(scene.lights[std::size_t(TruthLight::Lamp)]);
    engine::Renderer renderer(context(), scene);
    for (const auto filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Pcss}) {
        std::vector<double> errors[2];
        for (const bool isSecond : {false, true}) {
            frame::FrameSettings settings;
            settings.shadowFilter = filter;
            settings.sizePixels = {160, 90};
            settings.view = frame::DebugView::Shadow;
            settings.soloLight = isSecond ? 2 : int(TruthLight::Lamp);
            settings.shadowSamples = 4;
            const engine::RenderedFrame frame = renderer.render(Technique::Deferred, settings);
            const auto seenAt = [&](int x, int y) {
                return double(frame.radiance[4 * (std::size_t(y) * 160 + std::size_t(x))]);
            };
            for (const auto& [seen, truth] : sharesOf(scene, TruthLight::Lamp, settings.sizePixels, seenAt))
                if (truth > 0.1 && truth < 0.9) errors[isSecond].push_back(seen - truth);
        }
        double products = 0.0, squares[2] = {0.0, 0.0};
        for (std::size_t i = 0; i < errors[0].size(); ++i) {
            products += errors[0][i] * errors[1][i];
            for (const int light : {0, 1}) squares[light] += errors[light][i] * errors[light][i];
        }
        const double coefficient = products / std::sqrt(squares[0] * squares[1]);
        fmt::print("{}: coefficient {:.4f} of {} pixels\n", infoOf(filter).name, coefficient, errors[0].size());
        EXPECT_GT(errors[0].size(), 500u);
        EXPECT_LT(std::abs(coefficient), 5.0 / std::sqrt(double(errors[0].size()))) << infoOf(filter).name;
    }
}

// A penumbra is at most an eighth of a map's side wide. At 30 degrees a caster at 0.58 of the radius of the map's
// bounding sphere has that penumbra.
TEST_F(SoftShadows, ofSunsTooWideForPcssAreWarnedOf) {
    scenes::Scene scene = truthScene();
    frame::FrameSettings settings = ofSize(32, 18);
    settings.shadowSamples = 1;
    for (const auto filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard, frame::ShadowFilter::Pcss})
        for (const double degrees : {29.0, 31.0, 80.0}) {
            scene.lights[std::size_t(TruthLight::Sun)].angularRadiusRadians = float(glm::radians(degrees));
            engine::Renderer renderer(context(), scene);
            settings.shadowFilter = filter;
            renderer.render(Technique::Deferred, settings);
            const std::string& said = renderer.shadows().missing;
            const bool isReported = filter == frame::ShadowFilter::Pcss && degrees > 30.0;
            EXPECT_EQ(said.find("give --shadow-filter traced") != std::string::npos, isReported) << degrees << said;
        }
}

TEST_F(SoftShadows, getBetterWithSamplesAndAreAllOrNothingOutsidePenumbrae) {
    scenes::Scene scene = truthScene();
    aimAt(scene, TruthLight::Lamp);
    engine::Renderer renderer(context(), scene);
    double before = 1.0;
    for (const int samples : {1, 4, 16, 64}) {
        const std::vector<Share> shares = rendered(renderer, TruthLight::Lamp, samples);
        const double error = rootMeanSquare(shares);
        EXPECT_LT(error, before / 2.0) << samples; // half for random samples, less for these
        before = error;
        int wrong = 0;
        for (const auto& [seen, truth] : shares) wrong += (truth == 0.0 || truth == 1.0) && seen != truth;
        EXPECT_LE(wrong, int(shares.size() / 1000)) << "the edges of penumbrae, to rounding";
    }
}

// Doubling the reference's rays moves a fraction by less than a tenth of the error of 64 samples, which it judges.
TEST_SWEEP(SoftShadows, ofTheReferenceHaveTheirClosedForms) {
    constexpr double kErrorOf64Samples = 0.0069;
    for (const TruthLight light : {TruthLight::Lamp, TruthLight::Sun}) {
        scenes::Scene scene = truthScene();
        aimAt(scene, light);
        std::vector<Share> before;
        for (const int rings : {45, 64}) {
            if (rings > 45 && !isWholeSweep()) continue;
            reference::Settings settings;
            settings.sizePixels = {96, 54};
            settings.camera = scene.cameras[0];
            settings.soloLight = int(light);
            settings.findsAlternatives = false;
            settings.penumbraRings = rings;
            const reference::Rendered shadowed = reference::render(scene, settings);
            settings.shadows = {ShadowRequest::Kind::None};
            const reference::Rendered lit = reference::render(scene, settings);
            const std::vector<Share> shares = sharesOf(scene, light, settings.sizePixels, [&](int x, int y) {
                const std::size_t at = std::size_t(y) * 96 + std::size_t(x);
                return shadowed.radiance[at].r / lit.radiance[at].r;
            });
            const double error = rootMeanSquare(shares);
            fmt::print("reference, light {}, {} rays: RMS {:.6f}\n", int(light), 4 * rings * rings, error);
            EXPECT_LT(error, 0.05 * kErrorOf64Samples); // 0.03
            if (!before.empty()) {
                std::vector<Share> moves = shares;
                for (std::size_t i = 0; i < moves.size(); ++i) moves[i].truth = before[i].seen;
                fmt::print("doubling moves it by RMS {:.6f}\n", rootMeanSquare(moves));
                EXPECT_LT(rootMeanSquare(moves), 0.1 * kErrorOf64Samples);
            }
            before = shares;
        }
    }
}

TEST_F(SoftShadows, areTheSameWhateverElseIsLeftOut) {
    scenes::Scene scene = scenes::loadScene("shadow_truth");
    // A light without intensity, which only unpruned frames evaluate, before the others.
    scenes::Light dark = scene.lights[0];
    dark.intensity = 0.0f;
    scene.lights.insert(scene.lights.begin(), dark);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(161, 91);
    settings.shadowSamples = 3;
    expectPruningIsUnseen(renderer, settings);
}

TEST_F(SoftShadows, areTheSameWithEveryTechniqueToTheLastBit) {
    const scenes::Scene scene = scenes::loadScene("shadow_truth");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(161, 91);
    settings.shadowSamples = 5;
    expectParity(renderer, settings);
}

/// With 1 sample and with 16, and with a fault that must be detected; or with 16 alone.
TEST_SWEEP(SoftShadows, ofAPictureAreWithinTheirNoiseOfTheReference) {
    const scenes::Scene scene = scenes::loadScene("shadow_truth");
    engine::Renderer renderer(context(), scene);
    const ShaderMutant shaders("lib/shadow/disk_samples.glsl", "return radius * ", "return 0.0 * radius * ");
    engine::Renderer hard(context(), scene, shaders.tree());
    validation::CompareRequest request;
    request.techniques = {Technique::Forward};
    request.against = validation::Reference{};
    request.settings.sizePixels = {192, 108};
    for (const int samples : {1, 16}) {
        if (samples == 1 && !isWholeSweep()) continue;
        request.settings.shadowSamples = samples;
        const validation::CompareRecord record =
            validation::compareTechniques(renderer, context().capabilities(), request).record;
        EXPECT_TRUE(record.ok()) << validation::compareTable(record);
        ASSERT_TRUE(record.pairs[0].shadows);
        const validation::ShadowFigures& figures = *record.pairs[0].shadows;
        EXPECT_GT(figures.noisyPixels, 1000u);
        // With one ray the noise is that of independent ones, with 16 it is 0.40.
        EXPECT_LT(figures.noise, samples == 1 ? 1.2 : 0.5) << samples;
        EXPECT_GT(figures.mostNoise, 1.0) << samples;
        EXPECT_LT(figures.mostNoise, 1.15) << samples;
        EXPECT_LT(figures.ofReference, 0.1) << samples;
        if (samples == 1 || !isWholeSweep()) continue;
        const validation::CompareRecord faulty =
            validation::compareTechniques(hard, context().capabilities(), request).record;
        EXPECT_FALSE(faulty.ok()) << "hard shadows pass as soft ones of " << samples << " samples\n"
                                  << validation::compareTable(faulty);
    }
}

/// The error of transformed cosines has no tolerance. It exceeds the noise of many rays, and must not fail as noise.
TEST_F(SoftShadows, areNotJudgedWithTheErrorOfAreaLights) {
    const scenes::Scene scene = scenes::loadScene("studio");
    engine::Renderer renderer(context(), scene);
    validation::CompareRequest request;
    request.techniques = {Technique::Forward};
    request.against = validation::Reference{};
    request.settings.sizePixels = {64, 36};
    request.settings.shadowSamples = 64;
    const validation::CompareRecord record =
        validation::compareTechniques(renderer, context().capabilities(), request).record;
    EXPECT_TRUE(record.ok()) << validation::compareTable(record);
    ASSERT_TRUE(record.pairs[0].shadows);
    EXPECT_GT(record.pairs[0].shadows->noise, 1.5);
    EXPECT_FALSE(record.pairs[0].shadows->mostNoise);
    EXPECT_FALSE(record.pairs[0].tolerance.relMse);
}

} // namespace
} // namespace tessera
