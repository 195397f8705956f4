#include <filesystem>

#include "scenes/Clips.h"
#include "scenes/Pose.h"
#include "scenes/Rest.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/AnimatedModels.h"
#include "validation/timing/FrameTimer.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using namespace test;

/// Skins the first instance of every node to a new joint below that node. A clip rotates and moves the joint within a
/// second while a morph target inflates the mesh.
scenes::Scene waving(scenes::Scene scene) {
    scenes::Rig& rig = scene.rig;
    scenes::Clip& clip = rig.clips.emplace_back();
    clip.name = "wave";
    clip.samplers = {{scenes::Interpolation::Linear, 4, {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0.2f, 0.3f, 0.93f}},
                     {scenes::Interpolation::Linear, 3, {0.0f, 1.0f}, {0, 0, 0, 0.1f, 0.2f, 0.1f}},
                     {scenes::Interpolation::Linear, 1, {0.0f, 1.0f}, {0, 0.05f}}};
    rig.playing = {0};
    const std::size_t nodes = scene.nodes.size();
    for (std::size_t n = 0; n < nodes; ++n) {
        if (scene.nodes[n].instances.empty()) continue;
        const scenes::MeshInstance drawn = scene.nodes[n].instances.front();
        scene.nodes[n].instances.erase(scene.nodes[n].instances.begin());
        scenes::Shape& shape = rig.shapes.emplace_back();
        shape.rest = scene.meshes[std::size_t(drawn.mesh)];
        const std::size_t vertices = shape.rest.positionsOS.size();
        shape.influences = 4;
        shape.joints.assign(4 * vertices, 0);
        shape.weights.assign(4 * vertices, 0.25f);
        shape.targets.emplace_back().positionsOS = shape.rest.normalsOS;
        const int joint = int(scene.nodes.size());
        scene.nodes.emplace_back().parent = int(n);
        rig.skins.push_back({"joint", {joint}, {glm::dmat4(1.0)}});
        rig.nodes.push_back({joint});
        rig.weights.push_back({0.0f});
        scenes::Node& stand = scene.nodes.emplace_back();
        stand.instances.push_back(drawn);
        stand.instances[0].mesh = int(scene.meshes.size());
        rig.deformed.push_back({int(scene.meshes.size()), int(rig.shapes.size()) - 1, int(n), joint + 1,
                                int(rig.skins.size()) - 1, int(rig.weights.size()) - 1});
        scene.meshes.push_back(shape.rest);
        const int target = int(rig.nodes.size()) - 1;
        clip.channels.push_back({scenes::AnimatedProperty::Rotation, target, 0});
        clip.channels.push_back({scenes::AnimatedProperty::Translation, target, 1});
        clip.channels.push_back({scenes::AnimatedProperty::Weights, int(rig.weights.size()) - 1, 2});
    }
    scenes::checkScene(scene);
    scenes::poseScene(scene, 0.0);
    return scene;
}

/// Poses of a scene that a renderer already draws.
class Poses : public ShadowTest {};
using PosesSlow = Poses;

/// A scene of everything or, in a short sweep, a ball under a sun, whose programs are small.
TEST_SWEEP(Poses, areDrawnAsByANewRendererWithoutCompilingAnything) {
    for (const auto& [filter, times] : std::vector<std::pair<ShadowFilter, std::vector<double>>>{
             {ShadowFilter::Traced, {1.0, 0.4}}, {ShadowFilter::Hard, {0.4}}}) {
        SCOPED_TRACE(int(filter));
        scenes::Scene scene = waving(isWholeSweep() ? everythingScene() : ballUnderSun());
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = withShadows(ofSize(160, 91), filter);
        // Else programs also depend on which lights reach visible surfaces; a sun reaches all.
        settings.prune = !isWholeSweep();
        const std::vector<float> before = renderer.render(Technique::Forward, settings).radiance;
        const std::size_t programs = renderer.programs().size();
        for (const double time : times) {
            scenes::poseScene(scene, time);
            renderer.geometryChanged();
            const std::vector<float> after = renderer.render(Technique::Forward, settings).radiance;
            EXPECT_NE(after, before);
            EXPECT_EQ(renderer.programs().size(), programs);
            EXPECT_EQ(after, drawn(scene, settings, Technique::Forward)) << time;
        }
        scenes::poseScene(scene, 0.0);
        renderer.geometryChanged();
        EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, before);
    }
}

/// The scene with its posed meshes as static ones.
scenes::Scene asPlainMeshes(scenes::Scene scene) {
    scene.rig = {};
    scenes::checkScene(scene);
    return scene;
}

/// Bit-identical depth, in shadows and in ids too, so that passes that test for equal depth lose no pixel.
TEST_SWEEP(Poses, everyPassHasTheVerticesOfPlainMeshes) {
    scenes::Scene scene = waving(isWholeSweep() ? everythingScene() : ballUnderSun());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(160, 91));
    settings.prune = !isWholeSweep();
    renderer.draw(Technique::Forward, settings);
    constexpr double kTimesSeconds[] = {0.3, 0.7, 1.0};
    for (const double seconds : inTurn(kTimesSeconds, 1)) {
        SCOPED_TRACE(seconds);
        scenes::poseScene(scene, seconds);
        renderer.geometryChanged();
        const scenes::Scene plain = asPlainMeshes(scene);
        engine::Renderer truth(context(), plain);
        for (const ShadowFilter filter : {ShadowFilter::Traced, ShadowFilter::Hard}) {
            settings.shadowFilter = filter;
            EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance,
                      truth.render(Technique::Forward, settings).radiance)
                << int(filter);
        }
        const std::vector<float> depths = truth.downloadDepth();
        frame::FrameSettings asAtlas = settings; // depths from the lights
        asAtlas.view = frame::DebugView::ShadowAtlas;
        const std::vector<float> atlas = truth.render(Technique::Forward, asAtlas).radiance;
        EXPECT_GT(std::ranges::count_if(atlas, [](float shown) { return shown > 0.0f && shown < 1.0f; }), 100);
        EXPECT_TRUE(renderer.render(Technique::Forward, asAtlas).radiance == atlas);
        EXPECT_GT(std::ranges::count_if(depths, [](float depth) { return depth > 0.0f; }), 1000);
        frame::FrameSettings asIds = settings;
        asIds.view = frame::DebugView::Ids;
        const std::vector<float> ids = truth.render(Technique::Forward, asIds).radiance;
        std::vector<Technique> techniques = techniquesInTurn(0);
        techniques.push_back(Technique::Forward);
        for (const Technique technique : techniques) {
            SCOPED_TRACE(engine::infoOf(technique).name);
            renderer.draw(technique, settings);
            EXPECT_TRUE(renderer.downloadDepth() == depths);
            EXPECT_TRUE(renderer.render(technique, asIds).radiance == ids);
            EXPECT_TRUE(renderer.downloadDepth() == depths) << "of the view ids";
        }
    }
}

TEST_SWEEP(Poses, everyTechniqueDrawsThemAlikeAndAsANewRenderer) {
    scenes::Scene scene = waving(isWholeSweep() ? everythingScene() : metalScene());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(160, 91);
    renderer.render(Technique::Deferred, settings);
    std::size_t turn = 0;
    for (const double seconds : {1.0, 0.15, 0.7}) {
        SCOPED_TRACE(seconds);
        scenes::poseScene(scene, seconds);
        renderer.geometryChanged();
        expectParity(renderer, settings, techniquesInTurn(turn++));
    }
    EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, drawn(scene, settings, Technique::Forward));
}

/// A ball of a checkered material without layers. Within a second a clip turns it into glass with all of them, moves
/// the texture and widens the field of view.
scenes::Scene transforming() {
    using scenes::AnimatedProperty;
    scenes::Scene scene = ballUnderSun();
    scenes::Image& checker = scene.images.emplace_back();
    checker.name = "checker";
    checker.width = checker.height = 8;
    for (int i = 0; i < 64; ++i)
        for (int channel = 0; channel < 4; ++channel)
            checker.texels.push_back(std::byte(channel == 3 || (i + i / 8) % 2 == 0 ? 255 : 40));
    const int ball = int(scene.materials.size());
    scenes::Material& material = scene.materials.emplace_back();
    material.name = "ball";
    material.metallic = 0.0f;
    material.texture(scenes::TextureSlot::BaseColor).image = int(scene.images.size()) - 1;
    scene.nodes[0].instances[0].material = ball;
    struct Change {
        AnimatedProperty property;
        std::vector<float> from, to;
        scenes::TextureSlot slot = scenes::TextureSlot::Count;
    };
    const Change changes[] = {
        {AnimatedProperty::Transmission, {0.0f}, {0.75f}},
        {AnimatedProperty::Clearcoat, {0.0f}, {1.0f}},
        {AnimatedProperty::SheenColor, {0, 0, 0}, {0.5f, 0.25f, 0.0f}},
        {AnimatedProperty::Iridescence, {0.0f}, {1.0f}},
        {AnimatedProperty::AnisotropyStrength, {0.0f}, {0.5f}},
        {AnimatedProperty::Emissive, {0, 0, 0}, {0.0f, 0.125f, 0.0f}},
        {AnimatedProperty::PerceptualRoughness, {1.0f}, {0.25f}},
        {AnimatedProperty::TextureOffset, {0, 0}, {0.3f, 0.1f}, scenes::TextureSlot::BaseColor},
        {AnimatedProperty::TextureRotation, {0.0f}, {0.7f}, scenes::TextureSlot::BaseColor},
        {AnimatedProperty::CameraFovY, {0.8f}, {1.2f}},
    };
    scenes::Clip& clip = scene.rig.clips.emplace_back();
    clip.name = "transform";
    for (const Change& change : changes) {
        const bool isLens = change.property == AnimatedProperty::CameraFovY;
        clip.channels.push_back({change.property, int(scene.rig.numbers.size()), int(clip.samplers.size())});
        scene.rig.numbers.push_back({change.property, isLens ? 0 : ball, glm::dvec4(0.0), change.slot});
        std::vector<float> values = change.from;
        values.insert(values.end(), change.to.begin(), change.to.end());
        clip.samplers.push_back({scenes::Interpolation::Linear, int(change.from.size()), {0.0f, 1.0f}, values});
    }
    scene.rig.playing = {0};
    scenes::takeRest(scene);
    scenes::checkScene(scene);
    scenes::poseScene(scene, 0.0);
    return scene;
}

TEST_F(Poses, layersTexturesGlassAndLensesThatComeAndGoAreDrawnAsByANewRenderer) {
    scenes::Scene scene = transforming();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(160, 91);
    const std::vector<float> first = renderer.render(Technique::Deferred, settings).radiance;
    for (const double seconds : {0.5, 1.0, 0.0}) {
        SCOPED_TRACE(seconds);
        scenes::poseScene(scene, seconds);
        renderer.geometryChanged();
        const std::vector<float> posed = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_EQ(posed == first, seconds == 0.0);
        EXPECT_TRUE(posed == drawn(scene, settings));
        if (seconds == 0.5) expectParity(renderer, settings);
    }
}

TEST_F(Poses, aBillionSecondsBeforeAndAfterTheClipShowItsEnds) {
    scenes::Scene scene = waving(ballUnderSun());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(160, 91));
    const auto drawnAt = [&](double seconds) {
        scenes::poseScene(scene, seconds);
        renderer.geometryChanged();
        settings.timeSeconds = seconds;
        return renderer.render(Technique::Deferred, settings).radiance;
    };
    EXPECT_EQ(drawnAt(1e9), drawnAt(1.0));
    EXPECT_EQ(drawnAt(-1e9), drawnAt(0.0));
    EXPECT_NE(drawnAt(0.0), drawnAt(1.0));
}

/// A scene that no clip moves costs the same as one without clips.
TEST_F(PosesSlow, aSceneThatNothingMovesTakesThePassesAndTheTimeOfPlainMeshes) {
    scenes::Scene scene = waving(ballUnderSun());
    scenes::playClip(scene, "none");
    scenes::poseScene(scene, 0.0);
    const scenes::Scene plain = asPlainMeshes(scene);
    frame::FrameSettings settings = withShadows(ofSize(320, 180), ShadowFilter::Hard);
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        EXPECT_EQ(graph::planText(engine::planFrame(scene, info.technique, settings)),
                  graph::planText(engine::planFrame(plain, info.technique, settings)))
            << info.name;
    engine::Renderer renderer(context(), scene), plainRenderer(context(), plain), twin(context(), plain);
    std::vector<validation::TimedPoint> points;
    for (engine::Renderer* one : {&plainRenderer, &renderer, &twin})
        points.push_back({one, Technique::ClusteredDeferred, settings});
    const std::vector<std::vector<double>> timesMs =
        validation::timeInTurn(points, {}, {.warmUpRounds = 3, .rounds = 60});
    // Ratios of frames drawn one after the other, so that changes of the machine's pace cancel.
    const auto ratio = [&](std::size_t point) {
        std::vector<double> ratios;
        for (std::size_t round = 0; round < timesMs[0].size(); ++round)
            ratios.push_back(timesMs[point][round] / timesMs[0][round]);
        return validation::spreadOf(ratios).median;
    };
    fmt::print("a frame that nothing moves takes {:.3f} times as long as that of plain meshes, which takes {:.1f} ms; "
               "the same once more {:.3f} times\n",
               ratio(1), validation::spreadOf(timesMs[0]).median, ratio(2));
    EXPECT_NEAR(ratio(1), 1.0, 0.1);
}

/// A model of the repository, or one of Khronos', by its file below the folder of third-party models.
class PosesOfModelsSlow : public ShadowTest, public testing::WithParamInterface<std::string_view> {};

TEST_P(PosesOfModelsSlow, everyTechniqueDrawsThemAlikeAtTwentyTimesInAnyOrder) {
    const std::filesystem::path own = ownModelsFolder() / GetParam();
    const std::optional<std::filesystem::path> file = std::filesystem::exists(own) ? own : fileOfAssets(GetParam());
    if (!file) GTEST_SKIP() << "there is no folder of third-party models that has " << GetParam();
    frame::FrameSettings settings = ofSize(96, 54);
    scenes::Scene scene = modelUnderSun(*file, 96.0 / 54.0);
    engine::Renderer renderer(context(), scene);
    double lengthSeconds = 0.0;
    scene.rig.playing.clear(); // all at once
    for (const scenes::Clip& clip : scene.rig.clips) {
        scene.rig.playing.push_back(int(scene.rig.playing.size()));
        lengthSeconds = std::max(lengthSeconds, scenes::lengthSeconds(clip));
    }
    ASSERT_GT(lengthSeconds, 0.0);
    constexpr std::size_t kTimes = 20, kStep = 7;
    const auto poseAt = [&](std::size_t time) {
        scenes::poseScene(scene, lengthSeconds * (double(time) + 0.37) / double(kTimes));
        renderer.geometryChanged();
    };
    std::vector<std::vector<float>> pictures(kTimes);
    for (std::size_t turn = 0; turn < kTimes; ++turn) {
        const std::size_t time = turn * kStep % kTimes;
        SCOPED_TRACE(time);
        poseAt(time);
        expectParity(renderer, settings);
        pictures[time] = renderer.render(Technique::Forward, settings).radiance;
    }
    EXPECT_TRUE(std::ranges::any_of(pictures, [&](const auto& other) { return other != pictures[0]; }))
        << "nothing moves";
    for (std::size_t time = 0; time < kTimes; ++time) {
        poseAt(time);
        EXPECT_TRUE(renderer.render(Technique::Forward, settings).radiance == pictures[time]) << time;
    }
}

INSTANTIATE_TEST_SUITE_P(Own, PosesOfModelsSlow, testing::ValuesIn(kOwnModels));
INSTANTIATE_TEST_SUITE_P(Khronos, PosesOfModelsSlow, testing::ValuesIn(kAnimatedModels));

} // namespace
} // namespace tessera
