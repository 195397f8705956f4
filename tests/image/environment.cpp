// Environment light in frames: techniques, pruning, options, and checks without a reference.
#include <memory>
#include <numbers>

#include "base/Median.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/FlatTest.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using std::numbers::pi;
using namespace test;

class Environment : public EnvironmentTest {};
using EnvironmentPicturesSlow = Environment;
using EnvironmentCostSlow = Environment;

TEST_SWEEP_AS(Environment, everyTechniqueGivesTheSamePictureToTheLastBit, EnvironmentPicturesSlow,
              everyTechniqueGivesTheSamePictureToTheLastBit) {
    struct Case {
        scenes::Scene scene;
        EnvironmentLight light;
        int samples;
        std::vector<Technique> techniques; ///< besides forward; empty: all
    };
    // Nearly all of the time is compilation: once each technique is covered, a few cover all features.
    scenes::Material occluded;
    occluded.metallic = 0.3f;
    occluded.texture(scenes::TextureSlot::Occlusion).image = 0;
    scenes::Scene ball = ballUnderSky(occluded);
    ball.images = {everythingScene().images[0]};
    std::vector<Case> cases{{ball, EnvironmentLight::SplitSum, 1, techniquesInTurn(0)},
                            {ball, EnvironmentLight::Sampled, 1, techniquesInTurn(1)},
                            {ball, EnvironmentLight::SplitSum, 4, techniquesInTurn(0, 4)},
                            {evenScene(), EnvironmentLight::SplitSum, 1, {Technique::TiledDeferred}}};
    if (isWholeSweep()) {
        cases = {
            {evenScene(), EnvironmentLight::SplitSum, 1, {}},
            {evenScene(), EnvironmentLight::Sampled, 1, {}},
            {everythingScene(), EnvironmentLight::SplitSum, 1, {Technique::TiledDeferred, Technique::ClusteredForward}},
            {ball, EnvironmentLight::SplitSum, 4, {}}};
    }
    for (Case& one : cases) {
        SCOPED_TRACE(fmt::format("{}, {}, {} samples", one.scene.name, infoOf(one.light).name, one.samples));
        one.scene.environment = builtinEnvironment("studio");
        one.scene.environment->rotationDegrees = 25.0f;
        engine::Renderer renderer(context(), one.scene);
        frame::FrameSettings settings = withDiffusion(withSamples(ofSize(96, 54), one.samples));
        settings.environment.light = one.light;
        settings.environment.samples = 4;
        settings.environment.compensates = one.samples == 1;
        if (one.samples > 1) settings.environment.backdrop = frame::Backdrop::Blurred;
        expectParity(renderer, settings, one.techniques);
    }
}

/// Filtered and sampled light, or only filtered light: other pruning does not depend on it.
TEST_SWEEP_AS(Environment, leavingOutWhatTheSceneDoesNotNeedChangesNoBit, EnvironmentPicturesSlow,
              leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    struct Case {
        scenes::Scene scene;
        EnvironmentLight light;
    };
    std::vector<Case> cases{{scenes::loadScene("spheres"), EnvironmentLight::SplitSum}};
    if (isWholeSweep()) cases.push_back({evenScene(), EnvironmentLight::Sampled});
    for (Case& one : cases) {
        one.scene.environment = builtinEnvironment(isWholeSweep() ? "sky" : "studio"); // the studio is made faster
        frame::FrameSettings settings = withDiffusion(ofSize(96, 54));
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
    // A camera that looks along -z shows the middle of the map; turned by 90 degrees, the part a quarter to the right.
    scenes::Scene scene = quadScene(unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.environment = environmentOf(64, 32, [](int x, int y) { return glm::dvec3(x, y, 1.0); });
    for (const double turn : {0.0, 90.0}) {
        frame::FrameSettings settings = ofSize(9, 9);
        settings.environment.rotationDegrees = float(turn);
        const std::vector<float> seen = drawn(scene, settings);
        const float* const middle = &seen[4 * (4 * 9 + 4)];
        EXPECT_NEAR(middle[0], turn == 0.0 ? 31.5 : 47.5, 1e-3) << turn;
        EXPECT_NEAR(middle[1], 15.5, 1e-3);
        EXPECT_EQ(middle[2], 1.0f);
        EXPECT_EQ(middle[3], 0.0f) << "nothing covers it";
        // Right in the image is right in the map, and up is up.
        EXPECT_GT(seen[4 * (4 * 9 + 8)], middle[0]);
        EXPECT_LT(seen[4 * 4 + 1], middle[1]);
    }
}

/// Blurring keeps radiance linear that is linear in the direction: a lobe shortens the direction by the same factor
/// everywhere. Interpolation errs by the square of a triangle's size. A bilinear sampler shows lines of 0.014 across
/// the edges of the octahedron, which are the planes of the map's axes.
TEST_F(Environment, aBlurredBackdropShowsNoEdgesOfItsMap) {
    const glm::dvec3 gradient(0.55, 0.35, -0.6);
    scenes::Scene scene = quadScene(unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.environment = environmentOf(512, 256, [&](int x, int y) {
        return glm::dvec3(1.0 + glm::dot(gradient, scenes::directionInMap({(x + 0.5) / 512.0, (y + 0.5) / 256.0})));
    });
    engine::Renderer renderer(context(), scene);
    constexpr int kSidePixels = 65;
    for (const double turn : {0.0, 45.0, 90.0, 200.0}) {
        frame::FrameSettings settings = ofSize(kSidePixels, kSidePixels);
        settings.environment.backdrop = frame::Backdrop::Blurred;
        settings.environment.rotationDegrees = float(turn);
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        const double halfHeight = std::tan(0.5 * scene.cameras[0].fovYRadians), radians = turn * pi / 180.0;
        double products = 0.0, squares = 0.0;
        std::vector<glm::dvec2> wantedAndSeen;
        for (int y = 0; y < kSidePixels; ++y)
            for (int x = 0; x < kSidePixels; ++x) {
                const glm::dvec2 place = (2.0 * glm::dvec2(x + 0.5, y + 0.5) / double(kSidePixels) - 1.0) * halfHeight;
                const glm::dvec3 ray = glm::normalize(glm::dvec3(place.x, -place.y, -1.0));
                // The map turns counter-clockwise, viewed from above; in the map, the ray turns back.
                const glm::dvec3 inMap(ray.x * std::cos(radians) - ray.z * std::sin(radians), ray.y,
                                       ray.x * std::sin(radians) + ray.z * std::cos(radians));
                const double wanted = glm::dot(gradient, inMap);
                const double own = double(seen[std::size_t(4 * (y * kSidePixels + x))]) - 1.0;
                products += wanted * own;
                squares += wanted * wanted;
                wantedAndSeen.emplace_back(wanted, own);
            }
        const double kept = products / squares;
        EXPECT_GT(kept, 0.9) << turn << ": a lobe of alpha 0.12 is narrow";
        EXPECT_LT(kept, 1.0) << turn;
        double worst = 0.0;
        for (const glm::dvec2& pair : wantedAndSeen) worst = std::max(worst, std::abs(pair.y - kept * pair.x));
        fmt::print("turned by {}: {:.4f} of the gradient is kept, error {:.2e}\n", turn, kept, worst);
        EXPECT_LT(worst, 2e-3) << turn;
    }
}

TEST_F(Environment, aMatteBallShowsTheIrradianceOfOneBrightTexel) {
    // One texel of 64 x 32, a lamp of known solid angle, gives k_d L cos dw; no other light.
    constexpr int kX = 8, kY = 10; // in front of the ball
    scenes::Material matte = lambert();
    scenes::Scene scene = ballUnderSky(matte);
    scene.environment = environmentOf(64, 32, [&](int x, int y) { return glm::dvec3(x == kX && y == kY ? 1e5 : 0.0); });
    // Interpolation distributes the texel's light over its neighbours as a tent.
    glm::dvec3 towards(0.0);
    constexpr int kParts = 32;
    for (int j = -kParts; j < kParts; ++j)
        for (int i = -kParts; i < kParts; ++i) {
            const double right = (i + 0.5) / kParts, down = (j + 0.5) / kParts;
            const glm::dvec2 place((kX + 0.5 + right) / 64.0, (kY + 0.5 + down) / 32.0);
            const double solidAngle = std::sin(place.y * pi) * (2.0 * pi / 64.0) * (pi / 32.0) / (kParts * kParts);
            const double part = 1e5 * (1.0 - std::abs(right)) * (1.0 - std::abs(down)) * solidAngle;
            towards += part * scenes::directionInMap(place);
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
        // Errors of the triangles of a sphere of 96 x 48, and of the order of the harmonics.
        EXPECT_LE(error / sum, 0.01) << infoOf(how).name;
    }
}

TEST_F(Environment, occlusionDimsItsLightAlone) {
    scenes::Material gloss;
    gloss.metallic = 0.3f;
    gloss.perceptualRoughness = 0.6f;
    scenes::Scene open = quadScene(gloss);
    open.environment = evenEnvironment(0.8);
    open.lights = {pointLight({0.0, 0.0, 2.0}, 3.0f)};
    scenes::Scene dimmed = open;
    dimmed.images.push_back(floatImage(glm::vec4(0.4f, 1.0f, 1.0f, 1.0f)));
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

TEST_F(Environment, aLightThatIsShownAloneIsAloneBeforeTheBackdrop) {
    scenes::Scene scene = ballUnderSky(scenes::Material{});
    scene.environment = evenEnvironment(0.8);
    scene.lights = {pointLight({0.0, 0.0, 2.0}, 3.0f), pointLight({1.0, 2.0, 2.0}, 3.0f)};
    scenes::Scene dark = scene;
    dark.environment.reset();
    frame::FrameSettings settings = ofSize(16, 16);
    settings.soloLight = 1;
    engine::Renderer renderer(context(), scene);
    const std::vector<float> wanted = drawn(dark, settings);
    for (const EnvironmentLight how : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        settings.environment.light = how;
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        int lit = 0, background = 0;
        for (std::size_t i = 0; i < seen.size(); i += 4)
            for (std::size_t c = i; c < i + 3; ++c) {
                const bool isCovered = seen[i + 3] > 0.0f;
                ASSERT_EQ(seen[c], isCovered ? wanted[c] : 0.8f) << infoOf(how).name << ", pixel " << i / 4;
                ++(isCovered ? lit : background);
            }
        EXPECT_GT(lit, 300);
        EXPECT_GT(background, 30);
    }
    const auto truth = [&](const scenes::Scene& of) {
        frame::FrameSettings plain = settings;
        plain.environment.backdrop = frame::Backdrop::Off;
        return strictRadiance(of, plain);
    };
    EXPECT_EQ(truth(scene), truth(dark));
    // The tolerance allows no error of filtered light.
    EXPECT_EQ(validation::referenceTolerance(scene, settings).reason,
              validation::referenceTolerance(dark, settings).reason);
    const graph::Plan plan = engine::planFrame(scene, Technique::Deferred, settings);
    const auto left = std::ranges::find(plan.leftOut, "light of the environment", &graph::Plan::LeftOut::what);
    ASSERT_NE(left, plan.leftOut.end());
    EXPECT_EQ(left->why, "one light is shown alone");
}

TEST_F(Environment, aMirrorBallShowsEachDirectionWhereItLies) {
    // Squares of 32 x 32 texels: away from their edges a mirror shows black or white.
    scenes::Material mirror = metalOf(0.0);
    scenes::Scene scene = ballUnderSky(mirror);
    constexpr int kWidth = 512, kHeight = 256, kSquare = 32;
    const auto isWhite = [&](int x, int y) { return (x / kSquare + y / kSquare) % 2 == 0; };
    scene.environment =
        environmentOf(kWidth, kHeight, [&](int x, int y) { return glm::dvec3(isWhite(x, y) ? 1.0 : 0.0); });
    scene.environment->rotationDegrees = 30.0f;
    constexpr int kSidePixels = 128;
    for (const EnvironmentLight how : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        const std::vector<float> seen = rendered(scene, how, kSidePixels, 64).radiance;
        int judged = 0, wrong = 0;
        for (int y = 0; y < kSidePixels; ++y)
            for (int x = 0; x < kSidePixels; ++x) {
                const glm::dvec2 at =
                    1.02 * (glm::dvec2(2.0 * x + 1.0 - kSidePixels, kSidePixels - 1.0 - 2.0 * y) / double(kSidePixels));
                if (glm::dot(at, at) > 0.6) continue; // further out, a pixel covers much of the map
                const glm::dvec3 normal(at, std::sqrt(1.0 - glm::dot(at, at)));
                const glm::dvec3 mirrored = 2.0 * normal.z * normal - glm::dvec3(0.0, 0.0, 1.0);
                // Turned counter-clockwise, viewed from above: longitude l shows what was at l + 30 degrees of the map.
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

TEST_F(Environment, extremeMapsGiveFiniteLight) {
    const std::pair<const char*, scenes::Environment> maps[] = {
        {"black", evenEnvironment(0.0)},
        {"bright", evenEnvironment(1e30)},
        {"a sun of 1e5 in one texel",
         environmentOf(128, 64, [](int x, int y) { return glm::dvec3(x == 70 && y == 20 ? 1e5 : 0.1); })},
        {"one row", environmentOf(7, 1, [](int x, int) { return glm::dvec3(x); })},
        {"one column", environmentOf(1, 5, [](int, int y) { return glm::dvec3(y); })}};
    scenes::Scene scene = evenScene();
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        frame::FrameSettings settings = withDiffusion(ofSize(32, 32));
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

TEST_F(EnvironmentPicturesSlow, extremeIndicesAndRoughnessesGiveFiniteLight) {
    scenes::Scene scene = evenScene();
    scene.environment = builtinEnvironment("studio");
    engine::Renderer renderer(context(), scene);
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled})
        for (const float ior : {1.0f, 1e3f, 1e6f})
            for (const float roughness : {0.0f, 1.0f}) {
                for (scenes::Material& material : scene.materials) {
                    material.ior = ior;
                    material.perceptualRoughness = material.alpha = material.alphaY = roughness;
                }
                renderer.materialsChanged();
                frame::FrameSettings settings = withDiffusion(ofSize(32, 32));
                settings.environment.light = light;
                settings.environment.samples = 16;
                for (const float value : renderer.render(Technique::Deferred, settings).radiance) {
                    ASSERT_TRUE(std::isfinite(value)) << ior << ", " << roughness << ", " << infoOf(light).name;
                    ASSERT_GE(value, 0.0f) << ior << ", " << roughness << ", " << infoOf(light).name;
                }
            }
}

/// A textured model in the studio, against the same model unlit, and against a shader with constants for look-ups of
/// filtered light: the rest of the cost is arithmetic. There are no light lists, so all of it is the environment.
TEST_F(EnvironmentCostSlow, ofAModelWithoutLights) {
    const auto file = fileOfAssets("WaterBottle/WaterBottle.gltf");
    if (!file) GTEST_SKIP() << "there is no WaterBottle in the folder of assets";
    scenes::Scene lit = scenes::loadScene(file->string());
    lit.lights.clear();
    lit.environment = builtinEnvironment("studio");
    scenes::Scene unlit = lit;
    for (scenes::Material& material : unlit.materials) material.model = scenes::MaterialModel::SingleColor;
    unlit.environment = {};
    const ShaderMutant withoutLookUps("lib/environment/filtered_map.glsl",
                                      "precise vec3 light = a + share.x * (b - a) + share.y * (c - a);",
                                      "vec3 light = vec3(0.5, 0.4, 0.3);");
    struct Variant {
        const char* name;
        const scenes::Scene& scene;
        std::unique_ptr<engine::Renderer> renderer;
        std::vector<double> frames, lighting;
    };
    Variant variants[] = {{"unlit", unlit, std::make_unique<engine::Renderer>(context(), unlit), {}, {}},
                          {"lit", lit, std::make_unique<engine::Renderer>(context(), lit), {}, {}},
                          {"lit without look-ups",
                           lit,
                           std::make_unique<engine::Renderer>(context(), lit, withoutLookUps.tree()),
                           {},
                           {}}};
    frame::FrameSettings settings = ofSize(1280, 720);
    settings.environment.backdrop = frame::Backdrop::Off;
    for (int round = -1; round < 9; ++round)
        for (Variant& variant : variants) {
            variant.renderer->backend().setProfiling(true);
            const engine::RenderedFrame frame = variant.renderer->render(Technique::Deferred, settings);
            if (round < 0) continue; // compiles
            double all = 0.0, lighting = 0.0;
            for (const gpu::PassTiming& timing : variant.renderer->backend().passTimings()) {
                const double ms = timing.gpuMs.value_or(timing.cpuMs);
                all += ms;
                if (timing.name.ends_with("lighting")) lighting += ms;
                if (round == 0) fmt::print("{}: {} {:.2f} ms\n", variant.name, timing.name, ms);
            }
            variant.frames.push_back(all);
            variant.lighting.push_back(lighting);
        }
    for (const Variant& variant : variants)
        fmt::print("{}: frame {:.2f} ms, lighting {:.2f} ms\n", variant.name, medianOf(variant.frames),
                   medianOf(variant.lighting));
    EXPECT_GT(medianOf(variants[1].frames), medianOf(variants[2].frames));
}

} // namespace
} // namespace tessera
