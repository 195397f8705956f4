// Visible surfaces of area lights: parity of techniques, and pruning without them.
#include <set>

#include "engine/PrepareView.h"
#include "renderer/graph/Plan.h"
#include "tests/image/SeenLightTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using namespace test;

class SeenLightPictures : public SeenLightTest {};

/// Adds one light of each type to the scene, before its camera at (0, 1.5, 6).
scenes::Scene withSeenLights(scenes::Scene scene) {
    double x = -2.2;
    for (const LightType type : kAreaTypes) {
        scenes::Light light = turnedLamp(type, {x, 0.8, 0.4 * x}, {0.3, 0.2, 1.0});
        light.color = {1.0f, 0.5f, 0.25f};
        scene.lights.push_back(light);
        x += 1.5;
    }
    return scene;
}

/// The scene with materials of one kind, opaque and transparent: drawing lights does not depend on materials.
scenes::Scene withPlainMaterials(scenes::Scene scene,
                                 scenes::MaterialModel model = scenes::MaterialModel::MetallicRoughness) {
    for (scenes::Material& material : scene.materials) {
        scenes::Material plain;
        plain.model = model;
        plain.name = material.name;
        plain.baseColor = material.baseColor;
        plain.alphaMode = material.alphaMode;
        plain.doubleSided = material.doubleSided;
        material = plain;
    }
    return scene;
}

TEST_SWEEP(SeenLightPictures, everyTechniqueGivesTheSamePictureToTheLastBit) {
    struct Case {
        const char* name;
        scenes::Scene scene;
        int samples;
        frame::LightingSpace space;
        std::vector<Technique> techniques; ///< besides forward; empty: all
    };
    const scenes::Scene plain = withSeenLights(withPlainMaterials(everythingScene()));
    const scenes::Scene unlit =
        withSeenLights(withPlainMaterials(everythingScene(), scenes::MaterialModel::SingleColor));
    scenes::Scene flat = plain;
    makeOrthographic(flat.cameras[0], 2.0);
    using enum frame::LightingSpace;
    // Compiling lit programs takes most of the time, and drawing lights does not depend on materials.
    std::vector<Case> cases{{"unlit", unlit, 1, World, techniquesInTurn(0)},
                            {"unlit, axes of the view", unlit, 1, View, techniquesInTurn(1)},
                            {"plain", plain, 1, World, {Technique::ClusteredDeferred}},
                            {"orthographic, 4 samples", flat, 4, View, {Technique::ClusteredForward}}};
    if (isWholeSweep()) {
        cases.push_back({"plain", plain, 1, World, {}});
        cases.push_back({"plain, axes of the view", plain, 1, View, {}});
        cases.push_back({"orthographic", flat, 1, World, {Technique::DeferredVolumes}});
        cases.push_back({"everything", withSeenLights(everythingScene()), 1, World, {Technique::ClusteredDeferred}});
        cases.push_back({"even, 4 samples", withSeenLights(evenScene()), 4, World, {Technique::ForwardPlus}});
    }
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        frame::FrameSettings settings = withDiffusion(withSamples(ofSize(96, 54), one.samples));
        settings.space = one.space;
        engine::Renderer renderer(context(), one.scene);
        expectParity(renderer, settings, one.techniques);
        EXPECT_GT(shownPixels(renderer.render(Technique::Forward, settings)), 50u);
    }
}

/// With one sample and four, or with one and materials of one kind: unpruned programs are those of any scene.
TEST_SWEEP(SeenLightPictures, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    const bool isWhole = isWholeSweep();
    for (const int samples : isWhole ? std::vector{1, 4} : std::vector{1}) {
        const scenes::Scene scene = withSeenLights(!isWhole       ? withPlainMaterials(everythingScene())
                                                   : samples == 1 ? everythingScene()
                                                                  : evenScene());
        frame::FrameSettings settings = withDiffusion(withSamples(ofSize(96, 54), samples));
        const auto radiance = [&](bool prune) {
            settings.prune = prune;
            return frameOf(scene, settings, isWhole ? Technique::ForwardPlus : Technique::Deferred).radiance;
        };
        EXPECT_EQ(radiance(true), radiance(false)) << samples;
    }
}

TEST_F(SeenLightPictures, aSceneWithoutLightsToBeSeenHasNoTraceOfThem) {
    const auto tracesOf = [](const scenes::Scene& scene, frame::DebugView view, bool prune) {
        frame::FrameSettings settings;
        settings.view = view;
        settings.prune = prune;
        std::set<std::string> traces;
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::ForwardPlus, settings)) {
            if (program.name == "seen_lights" || program.name == "copy_depth") traces.insert(program.name);
            for (const auto& [name, value] : program.defines)
                if (name.find("SEEN") != std::string::npos && value != "0") traces.insert(name);
        }
        graph::Plan plan = engine::planFrame(scene, Technique::ForwardPlus, settings);
        for (const graph::Plan::LeftOut& item : plan.leftOut)
            if (item.what == "surfaces of area lights") traces.insert(item.why);
        plan.leftOut.clear();
        const std::string text = planText(plan);
        for (const char* name : {"seen_lights", "seen_depth"})
            if (text.find(name) != std::string::npos) traces.insert(name);
        return traces;
    };
    using Traces = std::set<std::string>;
    scenes::Scene scene = scenes::loadScene("spheres");
    const glm::dmat4& eye = scene.cameras[0].worldFromCamera;
    for (const bool prune : {true, false}) {
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune), Traces{"no light has one"});
        scene.lights.push_back(seenLamp(LightType::Sphere, glm::dvec3(eye[3] - 2.0 * eye[2])));
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune), (Traces{"copy_depth", "seen_lights", "seen_depth"}));
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Lights, prune), Traces{"the view shows no lit picture"});
        scene.lights.back().isSeen = false;
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune),
                  Traces{"no light that has one shines and is to be seen"});
        scene.lights.pop_back();
    }
}

/// Light lists, ids and depth contain surfaces only.
TEST_SWEEP(SeenLightPictures, depthsListsAndIdsAreThoseOfSurfaces) {
    scenes::Scene seen = withSeenLights(isWholeSweep() ? everythingScene() : withPlainMaterials(everythingScene()));
    scenes::Scene unseen = seen;
    for (scenes::Light& light : unseen.lights) light.isSeen = false;
    frame::FrameSettings settings = withDiffusion(ofSize(96, 54));
    for (const Technique technique : {Technique::ForwardPlus, Technique::ClusteredDeferred}) {
        engine::Renderer a(context(), seen), b(context(), unseen);
        a.draw(technique, settings);
        b.draw(technique, settings);
        EXPECT_NE(a.download().radiance, b.download().radiance);
        EXPECT_EQ(a.downloadDepth(), b.downloadDepth());
        const engine::DrawnLists own = a.downloadLists(), other = b.downloadLists();
        EXPECT_EQ(own.lists.entries, other.lists.entries);
        settings.view = frame::DebugView::Ids;
        EXPECT_EQ(a.render(technique, settings).radiance, b.render(technique, settings).radiance);
        settings.view = frame::DebugView::Final;
    }
}

} // namespace
} // namespace tessera
