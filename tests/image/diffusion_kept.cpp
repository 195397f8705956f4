// Diffused irradiance from frame to frame: what is cached, what is recomputed, and what is added in slices.

#include "tests/image/DiffusionTest.h"
#include "tests/image/EnvironmentTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::SubsurfaceMethod;
using namespace test;

class KeptDiffusion : public DiffusionTest {};

/// Names of the diffusion passes of the latest frame.
std::vector<std::string> passesThatDiffuse(engine::Renderer& renderer) {
    std::vector<std::string> names;
    for (const gpu::PassTiming& timing : renderer.backend().passTimings())
        if (timing.name.starts_with("diffusion")) names.push_back(timing.name);
    return names;
}

/// Changes the camera and per-pixel settings, then the lighting. With shadow maps, outside of a whole sweep, skips
/// per-pixel settings: their passes are those of traced shadows.
TEST_SWEEP(KeptDiffusion, diffusedLightIsKeptWhileWhatEntersIsTheSame) {
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        scenes::Scene ball = sphereScene(0.03, 12);
        for (scenes::Light& light : ball.lights) light.castsShadow = true;
        frame::FrameSettings settings = withDiffusion(ofSize(160, 90), 128);
        settings.shadowFilter = filter;
        Technique technique = Technique::Deferred;
        engine::Renderer renderer(context(), ball);
        renderer.render(technique, settings);
        EXPECT_FALSE(passesThatDiffuse(renderer).empty());
        int step = 0;
        const auto moved = [&](auto change, bool keeps) {
            change();
            ++step;
            const std::vector<float> seen = renderer.render(technique, settings).radiance;
            EXPECT_EQ(passesThatDiffuse(renderer).empty(), keeps) << infoOf(filter).name << ", " << step;
            const std::vector<float> fresh = drawn(ball, settings, technique);
            double most = 0.0;
            for (std::size_t i = 0; i < seen.size(); ++i)
                most = std::max(most, std::abs(double(seen[i]) - double(fresh[i])));
            EXPECT_EQ(most, 0.0) << infoOf(filter).name << ", " << step;
        };
        moved([&] { settings.eyeOffsetWS = {0.01, 0.0, 0.002}; }, true);
        const bool isShort = !isWholeSweep() && filter != frame::ShadowFilter::Traced;
        const auto ofPixels = [&](Technique drawnBy, int samples, bool specular, frame::DebugView view) {
            technique = drawnBy;
            settings.samples = samples;
            settings.specular = specular;
            settings.view = view;
        };
        if (!isShort) {
            moved([&] { ofPixels(Technique::Forward, 1, false, frame::DebugView::Final); }, true);
            moved([&] { ofPixels(Technique::Deferred, 1, true, frame::DebugView::Normal); }, true);
            moved([&] { settings.view = frame::DebugView::Final; }, true);
            // A comparison switches diffusion off and on.
            moved([&] { settings.subsurface = scenes::SubsurfaceMethod::None; }, true);
            moved([&] { settings.subsurface.reset(); }, true);
        }
        // Multisampled pixels may look up any texel, so all texels are lit, once.
        moved([&] { ofPixels(Technique::Forward, 4, true, frame::DebugView::Final); }, false);
        if (!isShort) {
            moved([&] { ofPixels(Technique::Forward, 1, true, frame::DebugView::Final); }, true);
            moved([&] { ofPixels(Technique::Forward, 4, true, frame::DebugView::Final); }, true);
        }
        moved([&] { ball.lights[0].intensity *= 2.0f; }, false);
        moved([&] { ball.lights[0].directionWS = glm::dvec3(0.0, -1.0, 0.0); }, false);
        moved([&] { settings.diffusion.gaussians = 2; }, false);
        moved([&] { settings.eyeOffsetWS = {0.0, 0.01, 0.0}; }, true);
        ball.materials[0].subsurface.preScatterShare = 1.0f;
        renderer.materialsChanged();
        moved([] {}, false);
        // A highlight leaves where it enters.
        ball.materials[0].specularColor = glm::vec3(0.5f);
        ball.materials[0].metallic = 0.0f;
        ball.materials[0].perceptualRoughness = 0.3f;
        renderer.materialsChanged();
        moved([] {}, true);
    }
}

/// enteredMaterial() removes these from the cache key, takeEnteredValues() from the shader of the entering light.
TEST_F(KeptDiffusion, lightThatEntersIsTheSameWhateverLayersHighlightAndEmissionASurfaceHas) {
    for (const bool prune : {true, false}) {
        scenes::Scene ball = sphereScene(0.03, 12);
        scenes::Material& skin = ball.materials[0];
        const auto layOver = [&](float amount) {
            skin.clearcoat = amount;
            skin.clearcoatPerceptualRoughness = amount;
            skin.sheenColor = skin.emissive = glm::vec3(amount);
            skin.perceptualRoughness = amount;
            skin.ior = 1.0f + amount;
        };
        skin.model = scenes::MaterialModel::MetallicRoughness;
        skin.metallic = 0.0f;
        layOver(0.6f);
        frame::FrameSettings settings = withDiffusion(ofSize(80, 45), 64);
        settings.prune = prune;
        engine::Renderer renderer(context(), ball);
        renderer.render(Technique::Deferred, settings);
        EXPECT_FALSE(passesThatDiffuse(renderer).empty());
        layOver(0.4f);
        renderer.materialsChanged();
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_TRUE(passesThatDiffuse(renderer).empty()) << "pruned: " << prune;
        EXPECT_EQ(drawn(ball, settings), seen) << "pruned: " << prune;
    }
}

TEST_F(KeptDiffusion, lightOfAnEnvironmentIsDiffusedAnewWhereItTurnsOrIsFoundAnotherWay) {
    scenes::Scene ball = sphereScene(0.03, 12);
    // A different colour from every direction.
    const auto surround = [&](double brightness) {
        ball.environment = environmentOf(8, 4, [&](int x, int y) { return brightness * glm::dvec3(x, y, 8 - x); });
    };
    surround(0.1);
    frame::FrameSettings settings = withDiffusion(ofSize(80, 45), 64);
    settings.environment.samples = 4;
    engine::Renderer renderer(context(), ball);
    renderer.render(Technique::Deferred, settings);
    EXPECT_FALSE(passesThatDiffuse(renderer).empty());
    const auto moved = [&](const char* what, const auto& change, bool keeps) {
        change();
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_EQ(passesThatDiffuse(renderer).empty(), keeps) << what;
        EXPECT_EQ(drawn(ball, settings), seen) << what;
    };
    moved(
        "nothing", [] {}, true);
    moved(
        "its backdrop", [&] { settings.environment.backdrop = frame::Backdrop::Off; }, true);
    moved(
        "turned by the frame", [&] { settings.environment.rotationDegrees = 70.0f; }, false);
    moved(
        "turned by the scene", [&] { ball.environment->rotationDegrees = -30.0f; }, false);
    moved(
        "brighter by the frame", [&] { settings.environment.intensity = 2.0f; }, false);
    moved(
        "brighter by the scene", [&] { ball.environment->intensity = 0.7f; }, false);
    moved(
        "more samples where none are taken", [&] { settings.environment.samples = 16; }, true);
    moved(
        "sampled", [&] { settings.environment.light = frame::EnvironmentLight::Sampled; }, false);
    moved(
        "more samples", [&] { settings.environment.samples = 4; }, false);
    moved(
        "turned while sampled", [&] { settings.environment.rotationDegrees = 0.0f; }, false);
    moved(
        "off", [&] { settings.environment.light = frame::EnvironmentLight::Off; }, false);
    moved(
        "filtered", [&] { settings.environment.light = frame::EnvironmentLight::SplitSum; }, false);
    surround(0.2);
    renderer.environmentChanged();
    moved(
        "another map", [] {}, false);
}

TEST_F(KeptDiffusion, lightOfAnAreaLightIsDiffusedAnewWhereItIsFoundAnotherWay) {
    scenes::Scene ball = sphereScene(0.03, 12);
    scenes::Light& panel = ball.lights.emplace_back();
    panel.type = scenes::LightType::Rectangle;
    panel.positionWS = {0.0, 0.5, 1.0};
    panel.directionWS = glm::normalize(glm::dvec3(0.0, -0.5, -1.0));
    frame::FrameSettings settings = withDiffusion(ofSize(80, 45), 64);
    settings.area = {frame::AreaLights::Sampled, 4};
    engine::Renderer renderer(context(), ball);
    const auto diffusesWith = [&](const frame::AreaSettings& area) {
        settings.area = area;
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_EQ(drawn(ball, settings), seen);
        return !passesThatDiffuse(renderer).empty();
    };
    EXPECT_TRUE(diffusesWith({frame::AreaLights::Sampled, 4}));
    EXPECT_FALSE(diffusesWith({frame::AreaLights::Sampled, 4}));
    EXPECT_TRUE(diffusesWith({frame::AreaLights::Sampled, 16}));
    EXPECT_TRUE(diffusesWith({frame::AreaLights::Ltc, 16}));
    EXPECT_FALSE(diffusesWith({frame::AreaLights::Ltc, 4})) << "which takes no samples";
}

/// Diffusion at half resolution and with one Gaussian: all four combinations, or both together in every second step.
TEST_SWEEP(KeptDiffusion, lightingOnlyWhatIsSeenChangesNoBit) {
    scenes::Scene ball = sphereScene(0.03, 24);
    ball.cameras[0].projection = scenes::Projection::Perspective;
    ball.cameras[0].fovYRadians = 0.7;
    ball.cameras[0].nearMetres = 1e-3;
    for (const bool half : {false, true})
        for (const std::optional<int> gaussians : {std::optional<int>(), std::optional<int>(1)}) {
            if (!isWholeSweep() && !(half && gaussians)) continue;
            frame::FrameSettings settings = withDiffusion(ofSize(200, 150), isWholeSweep() ? 512 : 256);
            settings.diffusion.half = half;
            if (gaussians) settings.diffusion.gaussians = *gaussians;
            scenes::Scene seen = ball;
            engine::Renderer renderer(context(), seen), all(context(), ball);
            settings.prune = true;
            for (int step = 0; step < 7; step += isWholeSweep() ? 1 : 2) {
                // Around the ball, then so near that most of it is outside of the image.
                const double angle = 0.9 * step, metres = step < 5 ? 0.12 : 0.045;
                const glm::dvec3 eyeWS(metres * std::sin(angle), 0.02 - 0.01 * step, metres * std::cos(angle));
                ball.cameras[0].worldFromCamera = scenes::worldFromLookAt(eyeWS, glm::dvec3(0.0));
                seen.cameras[0] = ball.cameras[0];
                settings.prune = true;
                const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
                settings.prune = false;
                EXPECT_EQ(all.render(Technique::Deferred, settings).radiance, pruned)
                    << "half " << half << ", step " << step;
            }
        }
}

/// At full and half resolution, or only at half.
TEST_SWEEP(KeptDiffusion, lightThatIsAddedInSlicesEndsAsTheSameBits) {
    scenes::Scene ball = sphereScene(0.03, 24);
    for (scenes::Light& light : ball.lights) light.castsShadow = true;
    ball.cameras[0].projection = scenes::Projection::Perspective;
    ball.cameras[0].fovYRadians = 0.7;
    ball.cameras[0].nearMetres = 1e-3;
    const auto lookFrom = [&](double angle) {
        const glm::dvec3 eyeWS(0.12 * std::sin(angle), 0.02, 0.12 * std::cos(angle));
        ball.cameras[0].worldFromCamera = scenes::worldFromLookAt(eyeWS, glm::dvec3(0.0));
    };
    lookFrom(0.0);
    for (const bool half : {false, true}) {
        if (!isWholeSweep() && !half) continue;
        frame::FrameSettings settings = withDiffusion(ofSize(120, 90), 256);
        settings.diffusion.half = half;
        const auto fresh = [&] { return engine::Renderer(context(), ball).render(Technique::Deferred, settings); };
        engine::Renderer renderer(context(), ball);
        const auto addAll = [&](bool isOfAll) {
            renderer.limitDiffusion(engine::DiffusionLimit{.tiles = 4, .isOfAll = isOfAll});
            engine::DiffusionProgress before;
            int slices = 0;
            do {
                renderer.draw(Technique::Deferred, settings);
                const engine::DiffusionProgress progress = renderer.diffusionProgress();
                EXPECT_EQ(progress.objects, 1u);
                EXPECT_EQ(progress.isOfAll, isOfAll);
                EXPECT_GE(progress.doneTiles, before.doneTiles);
                EXPECT_EQ(progress.doneObjects, progress.isDone() ? 1u : 0u);
                before = progress;
                if (++slices > 1000) FAIL() << "no end of slices";
            } while (!before.isDone());
            EXPECT_GT(slices, isOfAll ? 0 : 2) << "half " << half;
        };
        const auto drawKnown = [&] {
            renderer.limitDiffusion(engine::DiffusionLimit{});
            return renderer.render(Technique::Deferred, settings).radiance;
        };
        addAll(false);
        EXPECT_EQ(drawKnown(), fresh().radiance);
        EXPECT_TRUE(passesThatDiffuse(renderer).empty());

        // Another camera reveals tiles that are not lit yet.
        lookFrom(2.5);
        const std::vector<float> known = drawKnown(), whole = fresh().radiance;
        EXPECT_FALSE(renderer.diffusionProgress().isDone());
        EXPECT_NE(known, whole);
        EXPECT_TRUE(passesThatDiffuse(renderer).empty()) << "the first slice has reported the unknown texels";
        addAll(true);
        EXPECT_EQ(drawKnown(), whole);
        lookFrom(-1.8);
        EXPECT_EQ(drawKnown(), fresh().radiance) << "all is known";
        EXPECT_TRUE(renderer.diffusionProgress().isDone());

        renderer.limitDiffusion({});
        lookFrom(0.0);
        EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, fresh().radiance);
    }
}

TEST_F(KeptDiffusion, aFrameReportsOfHowManyObjectsTheLightIsDiffused) {
    scenes::Scene balls = sphereScene(0.03, 12);
    scenes::Node other = balls.nodes[0];
    other.parentFromNode[3] += glm::dvec4(0.01, 0.0, 0.0, 0.0);
    balls.nodes.push_back(other);
    frame::FrameSettings settings = withDiffusion(ofSize(80, 60), 64);
    engine::Renderer renderer(context(), balls);
    using Reports = std::vector<std::pair<std::size_t, std::size_t>>;
    Reports reports;
    renderer.reportDiffusion([&](std::size_t done, std::size_t objects) { reports.emplace_back(done, objects); });
    const std::vector<float> first = renderer.render(Technique::Deferred, settings).radiance;
    EXPECT_EQ(reports, (Reports{{0, 2}, {1, 2}, {2, 2}}));
    reports.clear();
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, first);
    EXPECT_TRUE(reports.empty()) << "nothing was diffused anew";
    EXPECT_EQ(drawn(balls, settings), first);
}

TEST_F(KeptDiffusion, whereNoLightIsKnownItLeavesWhereItEntersAndNothingOldShows) {
    scenes::Scene ball = sphereScene(0.03, 24);
    frame::FrameSettings settings = withDiffusion(ofSize(120, 90), 128);
    engine::Renderer renderer(context(), ball);
    const std::vector<float> diffused = renderer.render(Technique::Deferred, settings).radiance;
    const float intensity = ball.lights[0].intensity;
    ball.lights[0].intensity = 3.0f * intensity;
    renderer.limitDiffusion(engine::DiffusionLimit{});
    const std::vector<float> limited = renderer.render(Technique::Deferred, settings).radiance;
    engine::Renderer fresh(context(), ball);
    fresh.limitDiffusion(engine::DiffusionLimit{});
    EXPECT_EQ(limited, fresh.render(Technique::Deferred, settings).radiance);
    EXPECT_EQ(fresh.diffusionProgress().doneTiles, 0u);
    settings.subsurface = SubsurfaceMethod::None;
    const std::vector<float> none = fresh.render(Technique::Deferred, settings).radiance;
    ASSERT_EQ(limited.size(), none.size());
    for (std::size_t i = 0; i < none.size(); ++i) ASSERT_NEAR(limited[i], none[i], 1e-4f + 1e-3f * std::abs(none[i]));
    // And back: tiles marked as unknown do not count as lit.
    ball.lights[0].intensity = intensity;
    settings.subsurface.reset();
    renderer.limitDiffusion({});
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, diffused);
}

} // namespace
} // namespace tessera
