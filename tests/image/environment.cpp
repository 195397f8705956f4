#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "scenes/builtin/Pictures.h"
#include "scenes/builtin/Shapes.h"
#include "tests/image/FlatTest.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using std::numbers::pi;

scenes::Environment mapOf(int width, int height, const std::function<glm::dvec3(int, int)>& radiance) {
    return {"test", scenes::builtin::drawRadiance("test", width, height, radiance)};
}

scenes::Environment even(double radiance) {
    return mapOf(1, 1, [&](int, int) { return glm::dvec3(radiance); });
}

scenes::Environment builtinMap(const std::string& name) {
    scenes::LoadLedger ledger;
    std::vector<std::string> warnings;
    return scenes::loadEnvironment(std::string(scenes::kBuiltinPrefix) + name, ledger, warnings);
}

/// A sphere before an orthographic camera, which it fills.
scenes::Scene ballUnderSky(const scenes::Material& material) {
    scenes::Scene scene = test::quadScene(material);
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], {}, 1.0, 96, 48);
    scene.cameras[0].projection = scenes::Projection::Orthographic;
    scene.cameras[0].halfHeightMetres = 1.02;
    return scene;
}

class Environment : public test::ShadowTest {
protected:
    engine::RenderedFrame rendered(const scenes::Scene& scene, EnvironmentLight light, int side = 64,
                                   int samples = 256) {
        frame::FrameSettings settings;
        settings.sizePixels = {side, side};
        settings.environment.light = light;
        settings.environment.samples = samples;
        engine::Renderer renderer(context(), scene);
        return renderer.render(Technique::Deferred, settings);
    }
};

TEST_F(Environment, everyTechniqueGivesTheSamePictureToTheLastBit) {
    struct Case {
        scenes::Scene scene;
        EnvironmentLight light;
        int samples;
        std::vector<Technique> techniques; ///< besides forward; none: all
    };
    // Compiling takes nearly all of the time: where each technique has been seen, two suffice for all features.
    for (Case& one : std::vector<Case>{{test::evenScene(), EnvironmentLight::SplitSum, 1, {}},
                                       {test::evenScene(), EnvironmentLight::Sampled, 1, {}},
                                       {test::everythingScene(),
                                        EnvironmentLight::SplitSum,
                                        1,
                                        {Technique::TiledDeferred, Technique::ClusteredForward}},
                                       {ballUnderSky(scenes::Material{}), EnvironmentLight::SplitSum, 4, {}}}) {
        SCOPED_TRACE(fmt::format("{}, {}, {} samples", one.scene.name, infoOf(one.light).name, one.samples));
        one.scene.environment = builtinMap("studio");
        one.scene.environment->rotationDegrees = 25.0f;
        engine::Renderer renderer(context(), one.scene);
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        settings.diffusion = test::coarseDiffusion();
        settings.environment.light = one.light;
        settings.environment.samples = 4;
        settings.samples = one.samples;
        settings.environment.compensates = one.light == EnvironmentLight::Sampled || !one.techniques.empty();
        if (one.samples > 1) settings.environment.backdrop = frame::Backdrop::Blurred;
        expectParity(renderer, settings, one.techniques);
    }
}

TEST_F(Environment, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    struct Case {
        scenes::Scene scene;
        EnvironmentLight light;
    };
    for (Case& one : std::vector<Case>{{scenes::loadScene("spheres"), EnvironmentLight::SplitSum},
                                       {test::evenScene(), EnvironmentLight::Sampled}}) {
        one.scene.environment = builtinMap("sky");
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        settings.diffusion = test::coarseDiffusion();
        settings.environment.light = one.light;
        settings.environment.samples = 4;
        const auto radiance = [&](bool prune) {
            settings.prune = prune;
            return engine::Renderer(context(), one.scene).render(Technique::TiledDeferred, settings).radiance;
        };
        EXPECT_EQ(radiance(true), radiance(false)) << one.scene.name << ", " << infoOf(one.light).name;
    }
}

TEST_F(Environment, aSceneWithoutOneHasNoTraceOfIt) {
    frame::FrameSettings settings;
    const scenes::Scene scene = scenes::loadScene("spheres");
    for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::Deferred, settings))
        for (const auto& [name, value] : program.defines)
            if (name.find("ENVIRONMENT") != std::string::npos) {
                EXPECT_EQ(name, "HAS_ENVIRONMENT");
                EXPECT_EQ(value, "0");
            }
    const graph::Plan plan = engine::planFrame(scene, Technique::Deferred, settings);
    EXPECT_EQ(planText(plan).find("environment_"), std::string::npos) << planText(plan);
}

TEST_F(Environment, theBackdropIsTheMapAndTurnsWithIt) {
    // A camera that looks along -z sees the middle of the map, and turned by 90 degrees what lies a quarter to the
    // right.
    scenes::Scene scene = test::quadScene(test::unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.environment = mapOf(64, 32, [](int x, int y) { return glm::dvec3(x, y, 1.0); });
    for (const double turn : {0.0, 90.0}) {
        frame::FrameSettings settings;
        settings.sizePixels = {9, 9};
        settings.environment.rotationDegrees = float(turn);
        engine::Renderer renderer(context(), scene);
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        const float* const middle = &seen[4 * (4 * 9 + 4)];
        EXPECT_NEAR(middle[0], turn == 0.0 ? 31.5 : 47.5, 1e-3) << turn;
        EXPECT_NEAR(middle[1], 15.5, 1e-3);
        EXPECT_EQ(middle[2], 1.0f);
        EXPECT_EQ(middle[3], 0.0f) << "nothing covers it";
        // To the right in the picture is to the right in the map, and up is up.
        EXPECT_GT(seen[4 * (4 * 9 + 8)], middle[0]);
        EXPECT_LT(seen[4 * 4 + 1], middle[1]);
    }
}

TEST_F(Environment, theBackdropIsThatOfTheReferenceInEveryPixel) {
    scenes::Scene scene = test::quadScene(test::unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.cameras[0].projection = scenes::Projection::Perspective;
    scene.cameras[0].fovYRadians = 1.8; // far from the axis
    scene.environment =
        mapOf(64, 32, [](int x, int y) { return glm::dvec3(1 + x % 5, 1 + y % 7, 1.0 + 0.01 * x * y); });
    scene.environment->rotationDegrees = 40.0f;
    frame::FrameSettings settings;
    settings.sizePixels = {48, 27};
    settings.filter = frame::TextureFilter::Exact;
    const validation::ReferencePicture truth = validation::referencePicture(
        scene, settings, [] {}, validation::Leeway::None);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
    for (std::size_t i = 0; i < seen.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            ASSERT_NEAR(seen[c], truth.picture.rgba[c], 1e-3) << i / 4; // steps of a texel, and fp32 angles
}

/// E(mu, alpha) of a height-correlated GGX lobe with F = 1, shading.md section 6: good to 2e-4. Compensated, all of it.
TEST_F(Environment, aWhiteFurnaceLosesWhatThePublishedTableSays) {
    constexpr double kCosines[] = {0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kAlphas[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kReflected[6][5] = {{.9113, .9745, .9927, .9961, .9973}, {.8834, .9216, .9692, .9831, .9882},
                                         {.8916, .8401, .8572, .8915, .9158}, {.8601, .7652, .6982, .6821, .6879},
                                         {.8107, .6802, .5646, .5014, .4639}, {.7602, .5976, .4507, .3645, .3069}};
    scenes::Material white;
    white.metallic = 1.0f;
    white.doubleSided = true;
    scenes::Scene scene = test::quadScene(white);
    scene.environment = even(1.0);
    scenes::Camera& camera = scene.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 0.05;
    for (const auto& [light, compensates] : {std::pair(EnvironmentLight::SplitSum, false),
                                             {EnvironmentLight::Sampled, false},
                                             {EnvironmentLight::SplitSum, true},
                                             {EnvironmentLight::Sampled, true}}) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {16, 16};
        settings.environment.light = light;
        settings.environment.samples = 1024;
        settings.environment.compensates = compensates;
        for (int a = 0; a < 6; ++a) {
            scene.materials[0].perceptualRoughness = float(std::sqrt(kAlphas[a]));
            renderer.materialsChanged();
            for (int m = 0; m < 5; ++m) {
                const double angle = std::acos(kCosines[m]);
                camera.worldFromCamera = glm::dmat4(1.0);
                camera.worldFromCamera[0] = {std::cos(angle), 0.0, -std::sin(angle), 0.0};
                camera.worldFromCamera[2] = {std::sin(angle), 0.0, std::cos(angle), 0.0};
                camera.worldFromCamera[3] = {2.0 * std::sin(angle), 0.0, 2.0 * std::cos(angle), 1.0};
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                double mean = 0.0;
                for (std::size_t i = 0; i < seen.size(); i += 4) mean += double(seen[i]) * 4.0 / double(seen.size());
                // 256 pixels of 1024 samples of the lobe, whose worth spreads by less than 1, leave 2e-3 / 3.
                EXPECT_NEAR(mean, compensates ? 1.0 : kReflected[a][m],
                            light == EnvironmentLight::SplitSum ? 1e-3 : 2e-3)
                    << infoOf(light).name << ", cosine " << kCosines[m] << ", alpha " << kAlphas[a]
                    << (compensates ? ", compensated" : "");
            }
        }
    }
}

TEST_F(Environment, aMatteBallShowsTheIrradianceOfOneBrightTexel) {
    // One texel of 64 x 32, a lamp of known solid angle, gives k_d L cos dw; no other light.
    constexpr int kX = 8, kY = 10; // before the ball
    scenes::Material matte;
    matte.model = scenes::MaterialModel::Lambert;
    scenes::Scene scene = ballUnderSky(matte);
    scene.environment = mapOf(64, 32, [&](int x, int y) { return glm::dvec3(x == kX && y == kY ? 1e5 : 0.0); });
    // Interpolation spreads the texel over its neighbours: its light is that of a tent.
    glm::dvec3 towards(0.0);
    double light = 0.0;
    constexpr int kParts = 32;
    for (int j = -kParts; j < kParts; ++j)
        for (int i = -kParts; i < kParts; ++i) {
            const double right = (i + 0.5) / kParts, down = (j + 0.5) / kParts;
            const glm::dvec2 place((kX + 0.5 + right) / 64.0, (kY + 0.5 + down) / 32.0);
            const double solidAngle = std::sin(place.y * pi) * (2.0 * pi / 64.0) * (pi / 32.0) / (kParts * kParts);
            const double part = 1e5 * (1.0 - std::abs(right)) * (1.0 - std::abs(down)) * solidAngle;
            towards += part * scenes::directionInMap(place);
            light += part;
        }
    for (const EnvironmentLight how : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        constexpr int kSidePixels = 64;
        const std::vector<float> seen = rendered(scene, how, kSidePixels, 1024).radiance;
        double error = 0.0, sum = 0.0;
        for (int y = 0; y < kSidePixels; ++y)
            for (int x = 0; x < kSidePixels; ++x) {
                const glm::dvec2 at = 1.02 * (glm::dvec2(2.0 * x - 63.0, 63.0 - 2.0 * y) / 64.0);
                if (glm::dot(at, at) > 0.9) continue;
                const glm::dvec3 normal(at, std::sqrt(1.0 - glm::dot(at, at)));
                const double truth = std::max(glm::dot(normal, towards), 0.0);
                error += std::abs(double(seen[std::size_t(4 * (y * kSidePixels + x))]) - truth);
                sum += truth;
            }
        // Facets of a sphere of 96 x 48, and of harmonics their order.
        EXPECT_LE(error / sum, 0.01) << infoOf(how).name;
    }
}

TEST_F(Environment, occlusionDimsItsLightAlone) {
    scenes::Material gloss;
    gloss.metallic = 0.3f;
    gloss.perceptualRoughness = 0.6f;
    scenes::Scene open = test::quadScene(gloss);
    open.environment = even(0.8);
    open.lights = {test::pointLight({0.0, 0.0, 2.0}, 3.0f)};
    scenes::Scene dimmed = open;
    dimmed.images.push_back(test::floatImage(glm::vec4(0.4f, 1.0f, 1.0f, 1.0f)));
    dimmed.materials[0].texture(scenes::TextureSlot::Occlusion).image = int(dimmed.images.size()) - 1;
    dimmed.materials[0].occlusionStrength = 0.5f;
    for (const EnvironmentLight how : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled, EnvironmentLight::Off}) {
        const auto middle = [&](const scenes::Scene& scene) {
            const std::vector<float> seen = rendered(scene, how, 3, 64).radiance;
            return double(seen[4 * 4]);
        };
        scenes::Scene dark = open;
        dark.environment.reset();
        const double lamps = middle(dark), all = middle(open);
        // 1 + 0.5 (0.4 - 1), in 255 steps.
        EXPECT_NEAR(middle(dimmed), lamps + (all - lamps) * std::round(0.7 * 255.0) / 255.0, 1e-6) << infoOf(how).name;
        if (how == EnvironmentLight::Off) {
            EXPECT_EQ(middle(dimmed), lamps);
        } else {
            EXPECT_GT(all, 1.1 * lamps);
        }
    }
}

TEST_F(Environment, aMirrorBallShowsEachDirectionWhereItLies) {
    // Squares of 8 x 8 texels: away from their edges a mirror shows black or white.
    scenes::Material mirror;
    mirror.metallic = 1.0f;
    mirror.perceptualRoughness = 0.0f;
    scenes::Scene scene = ballUnderSky(mirror);
    constexpr int kWidth = 512, kHeight = 256, kSquare = 32;
    const auto isWhite = [&](int x, int y) { return (x / kSquare + y / kSquare) % 2 == 0; };
    scene.environment = mapOf(kWidth, kHeight, [&](int x, int y) { return glm::dvec3(isWhite(x, y) ? 1.0 : 0.0); });
    scene.environment->rotationDegrees = 30.0f;
    constexpr int kSidePixels = 128;
    for (const EnvironmentLight how : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        const std::vector<float> seen = rendered(scene, how, kSidePixels, 64).radiance;
        int judged = 0, wrong = 0;
        for (int y = 0; y < kSidePixels; ++y)
            for (int x = 0; x < kSidePixels; ++x) {
                const glm::dvec2 at =
                    1.02 * (glm::dvec2(2.0 * x + 1.0 - kSidePixels, kSidePixels - 1.0 - 2.0 * y) / double(kSidePixels));
                if (glm::dot(at, at) > 0.6) continue; // beyond, a pixel sees much of the map
                const glm::dvec3 normal(at, std::sqrt(1.0 - glm::dot(at, at)));
                const glm::dvec3 mirrored = 2.0 * normal.z * normal - glm::dvec3(0.0, 0.0, 1.0);
                // Turned counter-clockwise seen from above, what is at longitude l was at l + 30 degrees of the map.
                const glm::dvec2 place = scenes::placeInMap(mirrored);
                const double column = std::fmod(place.x * kWidth + kWidth * 30.0 / 360.0, double(kWidth));
                const double row = place.y * kHeight;
                const auto nearEdge = [&](double texels) {
                    const double within = std::fmod(texels, double(kSquare));
                    return std::min(within, kSquare - within) < 6.0;
                };
                if (nearEdge(column) || nearEdge(row) || std::abs(row - 0.5 * kHeight) > 0.35 * kHeight) continue;
                ++judged;
                const float value = seen[std::size_t(4 * (y * kSidePixels + x))];
                if (std::abs(double(value) - (isWhite(int(column), int(row)) ? 1.0 : 0.0)) > 0.05) ++wrong;
            }
        EXPECT_GT(judged, 1000);
        EXPECT_EQ(wrong, 0) << infoOf(how).name << " of " << judged;
    }
}

/// Against another integration of the same light: means agree within three of their standard errors.
TEST_F(Environment, samplesAgreeWithTheReferenceWithinThreeStandardErrors) {
    scenes::Scene scene = scenes::loadScene("models");
    scene.lights.clear();
    scene.environment = builtinMap("studio");
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.filter = frame::TextureFilter::Exact;
    settings.environment.light = EnvironmentLight::Sampled;
    settings.environment.samples = 256;
    engine::Renderer renderer(context(), scene);
    for (const char* name : {"studio", "sky"}) {
        scene.environment = builtinMap(name);
        renderer.environmentChanged();
        settings.environment.compensates = name == std::string_view("sky");
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::None);
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        double sum = 0.0, squares = 0.0, light = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
            if (truth.surroundings[i].light == glm::dvec3(0.0)) continue;
            double own = 0.0, other = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                own += double(seen[4 * i + c]);
                other += double(truth.picture.rgba[4 * i + c]);
            }
            // By the light of the pixel, so that no bright one decides alone.
            const double error = (own - other) / (own + other + 1e-3);
            sum += error;
            squares += error * error;
            light += other;
            ++count;
        }
        ASSERT_GT(count, 500u);
        const double mean = sum / double(count);
        const double standardError = std::sqrt(squares / double(count) - mean * mean) / std::sqrt(double(count));
        EXPECT_LE(std::abs(mean), 3.0 * standardError) << name << ": " << mean << " of " << standardError;
        EXPECT_LE(standardError, 2e-3) << name;
    }
}

TEST_F(Environment, extremeMapsGiveFiniteLight) {
    const std::pair<const char*, scenes::Environment> maps[] = {
        {"black", even(0.0)},
        {"bright", even(1e30)},
        {"a sun of 1e5 in one texel",
         mapOf(128, 64, [](int x, int y) { return glm::dvec3(x == 70 && y == 20 ? 1e5 : 0.1); })},
        {"one row", mapOf(7, 1, [](int x, int) { return glm::dvec3(x); })},
        {"one column", mapOf(1, 5, [](int, int y) { return glm::dvec3(y); })}};
    scenes::Scene scene = test::evenScene();
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        frame::FrameSettings settings;
        settings.sizePixels = {32, 32};
        settings.diffusion = test::coarseDiffusion();
        settings.environment.light = light;
        settings.environment.samples = 16;
        scene.environment = maps[0].second;
        engine::Renderer renderer(context(), scene);
        for (const auto& [name, environment] : maps) {
            scene.environment = environment;
            renderer.environmentChanged();
            for (const float value : renderer.render(Technique::Deferred, settings).radiance) {
                ASSERT_TRUE(std::isfinite(value)) << name << ", " << infoOf(light).name;
                ASSERT_GE(value, 0.0f) << name << ", " << infoOf(light).name;
            }
        }
    }
}

class EnvironmentSlow : public Environment {};

/// The errors that docs/environment.md tells, and the bars of the split sum: a bias of a hundredth on matte surfaces,
/// and no fireflies.
TEST_F(EnvironmentSlow, theErrorOfTheSplitSumByRoughnessAndEnvironment) {
    const std::pair<const char*, scenes::Environment> environments[] = {
        {"studio", builtinMap("studio")},
        {"sky", builtinMap("sky")},
        {"sun", mapOf(512, 256, [](int x, int y) { return glm::dvec3(x == 60 && y == 70 ? 1e5 : 0.1); })},
        {"squares", mapOf(512, 256, [](int x, int y) { return glm::dvec3((x / 32 + y / 32) % 2 == 0 ? 1.0 : 0.05); })},
        {"even", even(1.0)}};
    struct Row {
        std::string name;
        scenes::Material material;
    };
    std::vector<Row> rows(1);
    rows[0].name = "matte";
    rows[0].material.model = scenes::MaterialModel::Lambert;
    for (const double roughness : {0.0, 0.125, 0.25, 0.5, 0.75, 1.0}) {
        Row& row = rows.emplace_back();
        row.name = fmt::format("metal, roughness {}", roughness);
        row.material.metallic = 1.0f;
        row.material.perceptualRoughness = float(roughness);
    }
    for (const auto& [name, environment] : environments) {
        for (const Row& row : rows) {
            scenes::Scene scene = ballUnderSky(row.material);
            scene.environment = environment;
            frame::FrameSettings settings;
            settings.sizePixels = {40, 40};
            settings.environment.backdrop = frame::Backdrop::Off;
            const validation::ReferencePicture truth = validation::referencePicture(
                scene, settings, [] {}, validation::Leeway::None);
            engine::Renderer renderer(context(), scene);
            const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
            double shown = 0.0, light = 0.0, squares = 0.0, noise = 0.0;
            std::vector<double> over;
            for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
                if (truth.picture.covered[i] == 0) continue;
                const double own = double(seen[4 * i]), other = double(truth.picture.rgba[4 * i]);
                shown += own;
                light += other;
                const double relative = (own - other) / (other + 0.01);
                squares += relative * relative;
                noise += truth.surroundings[i].variance.x / ((other + 0.01) * (other + 0.01));
                over.push_back(own / std::max(other, 1e-3));
            }
            const double count = double(over.size());
            std::ranges::sort(over);
            const double bias = shown / light - 1.0, relMse = squares / count;
            std::printf("%-8s %-22s bias %+.2e relMSE %.2e (noise of the reference %.1e) brightest %.2f\n", name,
                        row.name.c_str(), bias, relMse, noise / count, over[over.size() * 999 / 1000]);
            if (row.material.model == scenes::MaterialModel::Lambert) {
                EXPECT_LE(std::abs(bias), 0.01) << name;
                EXPECT_LE(relMse, 3e-3) << name; // most of it where the sun stands at the horizon
            }
        }
    }
}

} // namespace
} // namespace tessera
