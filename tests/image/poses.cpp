#include "engine/Rendering.h"
#include "scenes/Pose.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;

/// The scene with the first instance of every node skinned to a joint of its own below that node, which a clip turns
/// and moves within a second while a morph target swells the mesh.
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
        rig.weights.push_back({int(n), {0.0f}});
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
class Poses : public test::ShadowTest {
protected:
    /// Of a scene of everything or, unless the sweep is a whole one, of a ball under a sun, whose programs are small.
    void expectDrawnAsAnew();
};
using PosesSlow = Poses;

void Poses::expectDrawnAsAnew() {
    for (const auto& [filter, times] : std::vector<std::pair<ShadowFilter, std::vector<double>>>{
             {ShadowFilter::Traced, {1.0, 0.4}}, {ShadowFilter::Hard, {0.4}}}) {
        SCOPED_TRACE(int(filter));
        scenes::Scene scene = waving(test::isWholeSweep() ? test::everythingScene() : test::ballUnderSun());
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {160, 91};
        settings.shadows = test::kAllLightsCast;
        settings.shadowFilter = filter;
        // Else which lights reach what is in view decides on programs too; a sun reaches all.
        settings.prune = !test::isWholeSweep();
        const std::vector<float> before = renderer.render(Technique::Forward, settings).radiance;
        const std::size_t programs = renderer.programs().size();
        for (const double time : times) {
            scenes::poseScene(scene, time);
            renderer.geometryChanged();
            const std::vector<float> after = renderer.render(Technique::Forward, settings).radiance;
            EXPECT_NE(after, before);
            EXPECT_EQ(renderer.programs().size(), programs);
            engine::Renderer anew(context(), scene);
            EXPECT_EQ(after, anew.render(Technique::Forward, settings).radiance) << time;
        }
        scenes::poseScene(scene, 0.0);
        renderer.geometryChanged();
        EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, before);
    }
}

TEST_F(Poses, areDrawnAsByANewRendererWithoutCompilingAnything) {
    expectDrawnAsAnew();
}
TEST_F(PosesSlow, areDrawnAsByANewRendererWithoutCompilingAnything) {
    expectDrawnAsAnew();
}

TEST_F(Poses, everyTechniqueDrawsThemAlikeAndAsANewRenderer) {
    scenes::Scene scene = waving(test::everythingScene());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {160, 91};
    renderer.render(Technique::Deferred, settings);
    scenes::poseScene(scene, 0.7);
    renderer.geometryChanged();
    expectParity(renderer, settings);
    engine::Renderer anew(context(), scene);
    EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance,
              anew.render(Technique::Forward, settings).radiance);
}

} // namespace
} // namespace tessera
