// GPU images against those of the reference renderer, pixel by pixel, with the same filtering on both sides.
#include <filesystem>
#include <iterator>
#include <span>

#include "scenes/Pose.h"
#include "tests/image/FlatTest.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/ShownTriangles.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/figures/ErrorFigures.h"
#include "validation/reference/Texels.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::TextureSlot;
using namespace test;

/// Tolerances of a built-in scene on software rasterisers, at most ten times the measured figures (docs/reference.md
/// has the figures): two to five times, for compilers that order operations otherwise. The surfaces of each scene
/// explain them: distant normal maps in hall, edge-on triangles in lattice, one material model in every pixel of room.
struct SceneBars {
    const char* scene;
    int width, height;
    double p999Rel, relMse, bias, excluded;
};
constexpr SceneBars kSmallBars[] = {
    {"hall", 160, 90, 1e-3, 1.5e-9, 2e-5, 0.015},       {"spheres", 160, 90, 1e-4, 6e-12, 7e-7, 0.012},
    {"models", 160, 90, 5e-4, 6e-10, 5e-6, 0.005},      {"lattice", 160, 90, 4e-4, 1.5e-10, 1.2e-5, 0.008},
    {"room", 160, 90, 6e-6, 5e-13, 1.5e-7, 0.0003},     {"shadow_truth", 160, 90, 1.5e-4, 1e-12, 6e-7, 0.001},
    {"head", 160, 90, 1.5e-4, 1.5e-11, 1e-6, 0.003},    {"head_skin", 160, 90, 3e-4, 1.5e-10, 1e-6, 0.005},
    {"head_marble", 160, 90, 3e-4, 1e-10, 1e-6, 0.005}, {"diffusion_truth", 160, 90, 1e-6, 1e-13, 1e-7, 0.001},
};
/// At the programs' default image size. One sharp highlight decides the bias of spheres.
constexpr SceneBars kDefaultBars[] = {
    {"hall", 1280, 720, 1.2e-3, 3e-9, 3e-6, 0.002},        {"spheres", 1280, 720, 1.2e-4, 5e-11, 1e-4, 0.0015},
    {"models", 1280, 720, 4e-4, 5e-9, 5e-7, 0.0006},       {"lattice", 1280, 720, 4e-4, 2e-10, 2.5e-6, 0.001},
    {"room", 1280, 720, 6e-6, 4e-13, 1.2e-7, 0.00005},     {"shadow_truth", 1280, 720, 1.5e-4, 8e-13, 4e-7, 0.0002},
    {"head", 1280, 720, 1.5e-4, 4e-11, 1e-6, 0.0005},      {"head_skin", 1280, 720, 2.5e-4, 1e-9, 1e-6, 0.001},
    {"head_marble", 1280, 720, 2.5e-4, 4e-9, 1e-6, 0.001}, {"diffusion_truth", 1280, 720, 1e-6, 1e-13, 1e-7, 0.001},
};

/// Tolerances of scenes with area lights. Lobe shapes are approximations, whose error (docs/area-lights.md) exceeds
/// rounding. Without shadows, whose noise SoftShadows tests. Measured 2.6e-2 for lamps, whose floor and tables are
/// viewed at 80 degrees and more, where shapes are worst, 1.4e-2 for studio and 9.7e-3 for glass: rough glass alone has
/// 5.4e-3, since the reference integrates its lobe. Environments are sampled: the split sum of that of glass errs by
/// 2.7e-2 (docs/glass.md).
struct AreaLitBars {
    const char* scene;
    std::optional<int> lights; ///< fewer than in the scene, for speed: each is an integral
    double relMse, bias;
};
constexpr AreaLitBars kAreaLitBars[] = {
    {"lamps", 250, 4e-2, 0.02}, {"studio", {}, 3e-2, 0.03}, {"glass", {}, 1.2e-2, 0.015}};

class Reference : public ImageTest {
protected:
    /// Forward alone: the parity tests compare the other techniques with it.
    std::vector<validation::ComparePair> compared(const scenes::Scene& scene, frame::FrameSettings settings,
                                                  bool hardware) {
        settings.filter = frame::TextureFilter::Exact;
        engine::Renderer renderer(context(), scene);
        validation::CompareRequest request;
        request.techniques = {Technique::Forward};
        request.against = validation::Reference{};
        request.settings = settings;
        request.hardwareFilter = hardware;
        return validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
    }

    /// Returns the figures of exact filtering. With `hardware`, the pair of hardware filtering must pass too.
    validation::ErrorFigures expectAgreement(const std::string& what, const scenes::Scene& scene,
                                             const frame::FrameSettings& settings, bool hardware = false) {
        const std::vector<validation::ComparePair> pairs = compared(scene, settings, hardware);
        for (const validation::ComparePair& pair : pairs) {
            SCOPED_TRACE(what + ", " + pair.a);
            const validation::ErrorFigures& figures = pair.figures;
            fmt::print("{:<24} {:<26} p99.9 {:.1e}  relMse {:.1e}  bias {:+.1e}  max {:.1e}  excluded {:.3f} %\n", what,
                       pair.a, figures.p999Rel, figures.relMse, figures.bias, figures.maxRel, 100.0 * figures.excluded);
            // referenceTolerance() defines the limits and their reasons.
            EXPECT_TRUE(pair.tolerance.p999Rel && pair.tolerance.relMse && pair.tolerance.bias);
            EXPECT_TRUE(pair.verdict.ok) << testing::PrintToString(pair.verdict.missed);
            // Silhouettes: edges moved by the rasteriser's 1/256 of a pixel, and triangles no larger than a pixel.
            EXPECT_LT(figures.excluded, 0.02);
        }
        return pairs.front().figures;
    }

    /// Holds a built-in scene to the tolerances of software rasterisers. Other drivers may round divisions and roots
    /// otherwise, and have only the limits of referenceTolerance().
    void expectAsGoodAsMeasured(const SceneBars& bars) {
        scenes::Scene scene = scenes::loadScene(bars.scene);
        // Soft shadows are noisy; SoftShadows holds them to closed forms.
        for (scenes::Light& light : scene.lights) light.radiusMetres = light.angularRadiusRadians = 0.0f;
        // Texture-space diffusion approximates otherwise than the reference; Diffusion tests it.
        frame::FrameSettings settings = ofSize(bars.width, bars.height);
        const auto diffuses = [](const scenes::Material& material) {
            return material.subsurface.method == scenes::SubsurfaceMethod::TextureSpaceDiffusion;
        };
        if (std::any_of(scene.materials.begin(), scene.materials.end(), diffuses))
            settings.subsurface = scenes::SubsurfaceMethod::DepthMap;
        const validation::ErrorFigures figures = expectAgreement(bars.scene, scene, settings, true);
        if (!context().capabilities().isSoftware) return;
        SCOPED_TRACE(bars.scene);
        EXPECT_LE(figures.p999Rel, bars.p999Rel);
        EXPECT_LE(figures.relMse, bars.relMse);
        EXPECT_LE(std::abs(figures.bias), bars.bias);
        EXPECT_LE(figures.excluded, bars.excluded);
        // Lower a tolerance that is this far above the measured figure. Sums of signed errors and counts of single
        // pixels may be small by chance, and over a million pixels a single one may decide relMse.
        if (bars.width > 160) return;
        // Surfaces that face the only light get or lose all of it, here bit-identically.
        if (figures.maxRel == 0.0) return;
        EXPECT_GE(figures.p999Rel, 0.1 * bars.p999Rel);
        EXPECT_GE(figures.relMse, 0.1 * bars.relMse);
    }

    /// All scenes, or three in a short sweep: of all material models, of shadows and of fine maps.
    void expectEverySceneAsGoodAsMeasured(std::span<const SceneBars> bars) {
        EXPECT_EQ(bars.size() + std::size(kAreaLitBars), scenes::builtinScenes().size()) << "a scene has no bars";
        constexpr std::string_view kOfMostKinds[] = {"models", "shadow_truth", "head_marble"};
        for (const SceneBars& scene : bars)
            if (isWholeSweep() || std::ranges::find(kOfMostKinds, scene.scene) != std::end(kOfMostKinds))
                expectAsGoodAsMeasured(scene);
    }

    /// An animated scene, at each of these times or at one of them in turn.
    void expectAgreementAtTimes(const std::string& what, scenes::Scene scene, std::span<const double> timesSeconds);
    void expectAgreementOfModel(const std::filesystem::path& file, double lengthSeconds);
};
using ReferenceSlow = Reference;

TEST_SWEEP(Reference, everyBuiltinSceneAgreesWithIt) {
    expectEverySceneAsGoodAsMeasured(kSmallBars);
}

/// Every scene with area lights, or the one with the most shapes of them.
TEST_SWEEP(Reference, everyBuiltinSceneOfAreaLightsIsAsNearAsTheShapesOfLobes) {
    constexpr std::size_t kStudio = 1;
    for (const AreaLitBars& bars : inTurn(kAreaLitBars, kStudio)) {
        SCOPED_TRACE(bars.scene);
        scenes::LoadOptions options;
        options.lights = bars.lights;
        frame::FrameSettings settings = withoutShadows(ofSize(160, 90));
        settings.environment.light = frame::EnvironmentLight::Sampled;
        settings.environment.samples = 256;
        // Other refraction modes depend on the image
        // (GlassBehindSlow.mostOfTheSceneGlassIsNearerToTheReferenceWithWhatStandsBehind).
        settings.refraction = frame::Refraction::Environment;
        const validation::ComparePair pair = compared(scenes::loadScene(bars.scene, options), settings, false).front();
        const validation::ErrorFigures& figures = pair.figures;
        fmt::print("{:<24} relMse {:.1e}  bias {:+.1e}  excluded {:.3f} %\n", bars.scene, figures.relMse, figures.bias,
                   100.0 * figures.excluded);
        EXPECT_FALSE(pair.tolerance.relMse) << "held to nothing but these bars";
        EXPECT_EQ(figures.bad.sum() + figures.badOutside.sum(), 0u);
        EXPECT_LE(figures.relMse, bars.relMse);
        EXPECT_LE(std::abs(figures.bias), bars.bias);
        EXPECT_LE(figures.excluded, 0.03); // thin bars and rods, far away
        EXPECT_GT(figures.relMse, 1e-7) << "an approximation: the test compares a picture with itself";
    }
}

void Reference::expectAgreementAtTimes(const std::string& what, scenes::Scene scene,
                                       std::span<const double> timesSeconds) {
    for (scenes::Light& light : scene.lights) light.radiusMetres = light.angularRadiusRadians = 0.0f;
    std::optional<double> before;
    for (const double seconds : inTurn(timesSeconds, 1)) {
        frame::FrameSettings settings = ofSize(160, 90);
        settings.timeSeconds = seconds;
        scenes::poseScene(scene, seconds);
        const double now = expectAgreement(fmt::format("{} at {} s", what, seconds), scene, settings).meanLuminance;
        EXPECT_GT(now, 0.0) << "nothing is seen";
        if (before) {
            EXPECT_NE(now, *before) << "nothing moves";
        }
        before = now;
    }
}

/// The hook's motion and colours, from early on to long after the head fell ill, with the ears at different angles.
TEST_SWEEP(Reference, aHeadThatAHookMovesAgreesWithIt) {
    constexpr double kTimesSeconds[] = {0.6, 2.9, 5.3, 8.0, 11.7};
    expectAgreementAtTimes("head_sick",
                           scenes::loadScene(std::string(TESSERA_SOURCE_DIR) + "/scenes/files/head_sick.json"),
                           kTimesSeconds);
}

/// At times of its clip at which all parts move.
void Reference::expectAgreementOfModel(const std::filesystem::path& file, double lengthSeconds) {
    std::vector<double> timesSeconds;
    for (const double share : {0.07, 0.27, 0.48, 0.7, 0.95}) timesSeconds.push_back(share * lengthSeconds);
    expectAgreementAtTimes(file.stem().string(), modelUnderSun(file, 160.0 / 90.0), timesSeconds);
}
TEST_F(Reference, aBendingSkinAgreesWithIt) {
    expectAgreementOfModel(ownModelsFolder() / "skinned_bar.gltf", 2.0);
}
TEST_F(ReferenceSlow, modelsOfTheRepositoryAgreeWithIt) {
    for (const std::string_view model : kOwnModels) expectAgreementOfModel(ownModelsFolder() / model, 2.0);
}
/// A skin of 19 joints that walks for two seconds.
TEST_F(ReferenceSlow, aWalkingSkinAgreesWithIt) {
    const std::optional<std::filesystem::path> file = fileOfAssets("CesiumMan/CesiumMan.glb");
    if (!file) GTEST_SKIP() << "there is no folder of third-party models that has CesiumMan";
    expectAgreementOfModel(*file, 2.0);
}

/// At the programs' default image size: single pixels with large errors are rare.
TEST_F(ReferenceSlow, everyBuiltinSceneAgreesWithItAtTheDefaultSize) {
    expectEverySceneAsGoodAsMeasured(kDefaultBars);
}

TEST_F(Reference, aSceneOfEveryFeatureAgreesWithIt) {
    scenes::Scene scene = everythingScene();
    expectAgreement("everything", scene, ofSize(161, 89));
    frame::FrameSettings settings = ofSize(160, 90);
    settings.specular = false;
    expectAgreement("everything, no specular", scene, settings);
    settings.specular = true;
    settings.rangeTolerance = 0.05;
    settings.timeSeconds = 1.5;
    expectAgreement("everything, tolerance", scene, settings);
    settings.rangeTolerance = 0.0;
    settings.soloLight = 1;
    settings.space = frame::LightingSpace::View;
    expectAgreement("everything, one light", scene, settings);
    makeOrthographic(scene.cameras[0], 2.5);
    expectAgreement("everything, orthographic", scene, ofSize(161, 90));
    scene.cameras[0].farMetres = 20.0;
    expectAgreement("the same, far plane", scene, ofSize(161, 90));
}

TEST_F(Reference, aSceneFarFromTheOriginAgreesWithIt) {
    scenes::Scene scene = everythingScene();
    const glm::dvec3 away(0x1p20, 0.0, -0x1p20);
    for (scenes::Node& node : scene.nodes) node.parentFromNode[3] += glm::dvec4(away, 0.0);
    for (scenes::Light& light : scene.lights) light.positionWS += away;
    scene.cameras[0].worldFromCamera[3] += glm::dvec4(away, 0.0);
    expectAgreement("everything at 2^20 m", scene, ofSize(160, 90));
}

/// Glass in front of glass in front of an opaque ball: each layer counts with its own weight.
TEST_F(Reference, transparentSurfacesOnTopOfEachOtherAgreeWithIt) {
    scenes::Scene scene = everythingScene();
    const scenes::Material glass = scene.materials[std::size_t(scene.nodes.back().instances.front().material)];
    for (const double z : {0.5, 3.0, 1.25}) {
        scene.nodes.push_back(scene.nodes.back());
        scene.nodes.back().parentFromNode[3] = glm::dvec4(-0.2 * z, 0.3, z, 1.0);
        scene.nodes.back().instances.front().material = int(scene.materials.size());
        scene.materials.push_back(glass);
        scene.materials.back().baseColor.a = float(0.1 + 0.2 * z);
    }
    expectAgreement("panes of glass", scene, ofSize(160, 90));
}

/// An index of refraction of 1000 reflects 99.6 % of light; the table of lobes holds the rest less accurately.
TEST_F(Reference, roughGlassOfAHighIndexAgreesToWhatTheTableOfLobesHolds) {
    for (const float roughness : {0.2f, 0.5f}) {
        scenes::Material glass;
        glass.metallic = 0.0f;
        glass.perceptualRoughness = roughness;
        glass.transmission = 1.0f;
        glass.ior = 1000.0f;
        scenes::Scene scene = quadScene(glass);
        scene.meshes[0] = {};
        scenes::builtin::appendSphere(scene.meshes[0], {}, 1.0, 48, 24);
        scene.background = glm::vec3(1.0f);
        expectAgreement("glass of index 1000", scene, ofSize(48, 48));
    }
}

/// A single wrong number in a scene is detected: one light is 1 % too bright.
TEST_F(Reference, aLightThatDiffersByOnePercentNeverPasses) {
    scenes::Scene scene = scenes::loadScene("room");
    frame::FrameSettings settings = ofSize(96, 54);
    const validation::ReferencePicture truth = validation::referencePicture(scene, settings);
    scene.lights[0].intensity *= 1.01f;
    engine::Renderer renderer(context(), scene);
    const Picture picture = engine::toPicture(renderer.render(Technique::Forward, settings));
    const validation::ErrorFigures figures = validation::errorFigures(
        picture, truth.picture, validation::shownTriangles(renderer, settings, truth.ids).excluded);
    EXPECT_FALSE(validation::checkTolerance(figures, validation::referenceTolerance(scene, settings)).ok);
}

TEST_F(Reference, hardwareFilteringIsAPairOfItsOwnAndHolds) {
    const scenes::Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene);
    validation::CompareRequest request;
    request.techniques = {Technique::Deferred, Technique::Forward};
    request.against = validation::Reference{};
    request.settings = ofSize(96, 54);
    request.settings.filter = frame::TextureFilter::Exact;
    const auto pairs = validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
    ASSERT_EQ(pairs.size(), 3u);
    EXPECT_EQ(pairs[2].a, validation::hardwareFilterName("deferred"));
    EXPECT_TRUE(pairs[2].tolerance.p999Rel && pairs[2].tolerance.relMse && pairs[2].tolerance.bias);
    EXPECT_TRUE(pairs[2].verdict.ok) << testing::PrintToString(pairs[2].verdict.missed);
    EXPECT_EQ(pairs[0].figures.relMse, pairs[1].figures.relMse); // the same picture from both
}

/// Detected in whole scenes too, where little is minified and texture is a small part of most pixels.
TEST_F(Reference, aTextureWithoutItsSmallerLevelsNeverPassesAsHardwareFiltering) {
    const scenes::Scene scene = everythingScene();
    const ShaderMutant shaders("lib/material/texture_filter.glsl", "texture(image, uv)", "textureLod(image, uv, 0.0)");
    engine::Renderer renderer(context(), scene, shaders.tree());
    const frame::FrameSettings settings = ofSize(96, 54);
    const Picture shown = engine::toPicture(renderer.render(Technique::Forward, settings));
    const validation::ReferencePicture truth = validation::referencePicture(scene, settings);
    const validation::ErrorFigures figures = validation::errorFigures(
        shown, truth.nearestTo(shown), validation::shownTriangles(renderer, settings, truth.ids).excluded);
    EXPECT_FALSE(validation::checkTolerance(figures, validation::referenceTolerance(scene, settings)).ok);
}

class SrgbDecoding : public FlatTest {};

TEST_F(SrgbDecoding, everyCodeValueIsDecodedToRounding) {
    frame::FrameSettings settings;
    settings.filter = frame::TextureFilter::Exact;
    for (int first = 0; first < 256; first += kSide * kSide) {
        const auto code = [first](int x, int y) { return first + y * kSide + x; };
        const scenes::Image image = image8([&](int x, int y) {
            return std::array<int, 4>{code(x, y), code(x, y), 0, 255};
        });
        const engine::RenderedFrame shown =
            frame(texturedScene(flatScene(unlit()), TextureSlot::BaseColor, image), settings);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double wanted = reference::linearFromSrgb(code(x, y) / 255.0);
                // Six fp32 roundings, and neighbouring texels that rounding of a coordinate blends in.
                EXPECT_NEAR(pixel(shown, x, y).r, wanted, 1e-6 * wanted + 1e-9) << code(x, y);
            }
    }
}

} // namespace
} // namespace tessera
