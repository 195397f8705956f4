#include <iterator>
#include <span>

#include "engine/PrepareView.h"
#include "renderer/graph/Plan.h"
#include "tests/image/ImageTest.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

class Invariance : public ImageTest {
protected:
    static frame::FrameSettings small() {
        frame::FrameSettings settings = withDiffusion(ofSize(320, 181));
        return settings;
    }
    Picture picture(const scenes::Scene& scene, const frame::FrameSettings& settings,
                    Technique technique = Technique::Deferred) {
        return engine::toPicture(frameOf(scene, settings, technique));
    }
};

/// Every built-in scene with every technique and layout. In a short sweep fewer with `deferred`, small and in `exact`:
/// unpruned programs are the same for all, and are compiled once.
TEST_SWEEP_AS(Invariance, pruningNeverChangesABitOfAnyBuiltinScene, InvarianceSlow,
              pruningNeverChangesABitOfAnyBuiltinSceneWithAnyLayout) {
    for (const scenes::BuiltinScene& builtin : builtinsForSweep()) {
        const scenes::Scene scene = builtinForSweep(builtin);
        engine::Renderer renderer(context(), scene);
        const auto drawn = [&](Technique technique, const frame::FrameSettings& settings) {
            return engine::toPicture(renderer.render(technique, settings));
        };
        // pruningNeverChangesABitWhereEverySurfaceHasTheSameLobe covers `forward`.
        std::vector<Technique> techniques{Technique::Deferred};
        if (isWholeSweep()) {
            techniques = techniquesInTurn(0);
            techniques.push_back(Technique::Forward);
        }
        for (const Technique technique : techniques) {
            // pruningNeverChangesABitWhereEverySurfaceHasTheSameLobe takes layouts in turn.
            for (const frame::LayoutInfo& layout : inTurn(frame::layoutTable(), 0)) {
                SCOPED_TRACE(fmt::format("{} {} {}", builtin.name, engine::infoOf(technique).name, layout.name));
                frame::FrameSettings settings = small();
                if (!isWholeSweep()) settings.sizePixels = {96, 55};
                settings.layout = layout.layout;
                const Picture pruned = drawn(technique, settings);
                settings.prune = false;
                const Picture whole = drawn(technique, settings);
                EXPECT_EQ(pruned.rgba, whole.rgba);
                EXPECT_GT(validation::errorFigures(whole, pruned).litShare, 0.1);
            }
        }
    }
}

/// Each material alone with two techniques, layouts in turn. In a short sweep a few with `forward`, which has no
/// G-buffer, and one with many layers with `deferred` in a coarse layout.
TEST_SWEEP(Invariance, pruningNeverChangesABitWhereEverySurfaceHasTheSameLobe) {
    constexpr Technique kBoth[] = {Technique::Forward, Technique::Deferred};
    // In a short sweep: wrapped light, a mask, two widths of a lobe, and a coat.
    constexpr std::size_t kAlone[] = {2, 5, 8, 11};
    const scenes::Scene everything = everythingScene();
    const std::span<const frame::LayoutInfo> layouts = frame::layoutTable();
    for (std::size_t material = 0; material < everything.materials.size(); ++material) {
        if (!isWholeSweep() && std::ranges::find(kAlone, material) == std::end(kAlone)) continue;
        scenes::Scene scene = everything;
        for (scenes::Node& node : scene.nodes)
            for (scenes::MeshInstance& instance : node.instances) instance.material = int(material);
        for (const Technique technique : inTurn(kBoth, material == std::rbegin(kAlone)[0] ? 1 : 0)) {
            // Layouts are taken in turn; that of the coat is a coarse one.
            const frame::LayoutInfo& layout = layouts[material % layouts.size()];
            SCOPED_TRACE(fmt::format("{} {} {}", scene.materials[material].name, int(technique), layout.name));
            frame::FrameSettings settings = small();
            settings.sizePixels = {160, 91};
            settings.layout = layout.layout;
            const Picture pruned = picture(scene, settings, technique);
            settings.prune = false;
            EXPECT_EQ(pruned.rgba, picture(scene, settings, technique).rgba);
        }
    }
}

/// Every built-in scene with two techniques and every layout, or the head of skin, small and in `exact`: it has few
/// features, so that most additions are new to it.
TEST_SWEEP_AS(Invariance, unusedElementsChangeNeitherPictureNorPlan, InvarianceSlow,
              whatNothingDrawsNeverChangesABitOrThePlanOfAnyBuiltinSceneWithAnyLayout) {
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        if (!isWholeSweep() && builtin.name != "head_skin") continue;
        const scenes::Scene scene = builtinForSweep(builtin);
        scenes::Scene more = withUnusedOfEverything(scene);
        checkScene(more);
        // Plans name lights that are off or dark among the omitted parts.
        scenes::Scene moreLights = more;
        moreLights.lights.emplace_back(pointLight({0.0, 1.0, 0.0}, 10.0f)).enabled = false;
        moreLights.lights.push_back(pointLight({0.0, 1.0, 0.0}, 0.0f));
        engine::Renderer renderer(context(), scene), rendererOfMore(context(), more),
            rendererOfLights(context(), moreLights);
        for (const frame::LayoutInfo& layout : inTurn(frame::layoutTable(), 0))
            for (const Technique technique : {Technique::Deferred, Technique::Forward}) {
                SCOPED_TRACE(fmt::format("{} {} {}", builtin.name, int(technique), layout.name));
                frame::FrameSettings settings = small();
                if (!isWholeSweep()) settings.sizePixels = {96, 55};
                settings.layout = layout.layout;
                EXPECT_EQ(graph::planText(engine::planFrame(more, technique, settings)),
                          graph::planText(engine::planFrame(scene, technique, settings)));
                const std::vector<float> radiance = renderer.render(technique, settings).radiance;
                EXPECT_EQ(rendererOfMore.render(technique, settings).radiance, radiance);
                EXPECT_EQ(rendererOfLights.render(technique, settings).radiance, radiance);
            }
    }
}

/// Pixels that store a material index instead of material values.
/// With every other technique, two filters and three views, or the final image with one technique and filter.
TEST_SWEEP(Invariance, materialsReadByTheirNumberGiveEveryBitOfStoredOnesAndOfForward) {
    const scenes::Scene scene = evenScene();
    engine::Renderer renderer(context(), scene);
    for (const frame::TextureFilter filter : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
        for (const frame::DebugView view :
             {frame::DebugView::Final, frame::DebugView::Diffuse, frame::DebugView::Distribution}) {
            // Filters affect texture reads, which debug views of one term share with the final image.
            if (filter == frame::TextureFilter::Exact && view != frame::DebugView::Final) continue;
            if (!isWholeSweep() && (filter != frame::TextureFilter::Hardware || view != frame::DebugView::Final))
                continue;
            frame::FrameSettings settings = small();
            settings.sizePixels = {160, 91};
            settings.filter = filter;
            settings.view = view;
            const std::vector<float> forward = renderer.render(Technique::Forward, settings).radiance;
            for (const Technique technique : isWholeSweep() ? techniquesInTurn(0) : std::vector{Technique::Deferred}) {
                // Blending rounds the sum after each light, so this technique is compared with itself.
                const bool blends = technique == Technique::DeferredVolumes;
                SCOPED_TRACE(fmt::format("{} {} {}", engine::infoOf(technique).name, int(filter), int(view)));
                const std::vector<float> pruned = renderer.render(technique, settings).radiance;
                if (!blends) {
                    EXPECT_EQ(pruned, forward);
                }
                frame::FrameSettings whole = settings;
                whole.prune = false;
                EXPECT_EQ(renderer.render(technique, whole).radiance, pruned);
            }
        }
    }
    // The comparison means nothing unless one stores a material index and the other does not.
    const auto bytes = [&](bool prune) {
        frame::FrameSettings settings = small();
        settings.prune = prune;
        const frame::FrameSpec spec = engine::prepareView(scene, Technique::Deferred, settings).spec;
        return std::pair(frame::holdMaterialNumber(spec.settings.layout, spec.channels),
                         frame::bytesPerPixel(spec.settings.layout, spec.channels));
    };
    EXPECT_EQ(bytes(true), std::pair(true, 24)) << "normal and number, and the coat";
    EXPECT_EQ(bytes(false), std::pair(false, 128));
}

TEST_F(Invariance, plansNameWhatThreeDifferentScenesLeaveOut) {
    const auto left = [](const char* name) {
        const scenes::Scene scene = scenes::loadScene(name);
        std::string all = "\n"; // so that whole lines can be searched
        for (const graph::Plan::LeftOut& item : engine::planFrame(scene, Technique::Deferred, small()).leftOut) {
            EXPECT_FALSE(item.why.empty());
            all += item.what + " (" + item.why + ")\n";
        }
        return all;
    };
    const std::string lattice = left("lattice"), room = left("room"), head = left("head");
    EXPECT_NE(lattice.find("\nnormal maps ("), std::string::npos);
    const std::string byNumber = " (no material varies over a surface, so lighting reads it by its number)\n";
    EXPECT_NE(lattice.find("G-buffer channel emission (needed only by "), std::string::npos);
    EXPECT_NE(room.find("G-buffer channel emission" + byNumber), std::string::npos);
    EXPECT_NE(lattice.find("G-buffer channel albedo" + byNumber), std::string::npos);
    EXPECT_EQ(head.find("G-buffer channel albedo"), std::string::npos);
    EXPECT_EQ(head.find("\nnormal maps ("), std::string::npos);
    EXPECT_NE(head.find("tangents"), std::string::npos);
    EXPECT_NE(lattice, room);
    EXPECT_NE(room, head);
}

TEST_SWEEP(Invariance, picturesAreBitIdenticalFromRunToRun) {
    const char* const name = isWholeSweep() ? "hall" : "lattice";
    const scenes::Scene scene = scenes::loadScene(name);
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        frame::FrameSettings settings = small();
        if (!isWholeSweep()) settings.sizePixels = {160, 91};
        const Picture first = picture(scene, settings, technique.technique);
        const Picture second = picture(scenes::loadScene(name), settings, technique.technique);
        EXPECT_EQ(first.rgba, second.rgba) << technique.name;
    }
}

/// A scene of everything with each technique and every built-in scene with one in turn, or it and the head with one
/// technique each.
TEST_SWEEP_AS(Invariance, worldAndViewSpaceLightingAgree, InvarianceSlow,
              worldAndViewSpaceLightingAgreeInEveryBuiltinScene) {
    std::vector<scenes::Scene> all{everythingScene()};
    // Not the scanned head: mip selection in its fine maps by hardware filtering depends on the last bit of the
    // positions.
    scenes::LoadOptions options;
    options.useAssets = false;
    constexpr std::size_t kHead = 6;
    for (const scenes::BuiltinScene& builtin : inTurn(scenes::builtinScenes(), kHead))
        all.push_back(builtinForSweep(builtin, options));
    // Techniques with bit-equal images, and some that sum lights in another order; one per scene, in turn.
    constexpr Technique kJudged[] = {Technique::Forward, Technique::Deferred, Technique::DeferredVolumes,
                                     Technique::TiledDeferred, Technique::ClusteredForward};
    std::size_t turn = 0;
    for (const scenes::Scene& scene : all) {
        engine::Renderer renderer(context(), scene);
        const bool takesEach = isWholeSweep() && &scene == &all.front();
        for (const Technique technique : std::span(kJudged).subspan(takesEach ? 0 : turn++ % 5, takesEach ? 5 : 1)) {
            frame::FrameSettings settings = small();
            // Shadow outlines depend on the last bit of a position; ShadowMapsTest.tracedOnesAreAsRightInViewSpace
            // judges shadows.
            settings.shadows = {scenes::ShadowRequest::Kind::None};
            const Picture world = engine::toPicture(renderer.render(technique, settings));
            settings.space = frame::LightingSpace::View;
            const Picture view = engine::toPicture(renderer.render(technique, settings));
            const validation::ErrorFigures figures = validation::errorFigures(view, world);
            SCOPED_TRACE(fmt::format("{}, {}: relMse {:.1e}", scene.name, int(technique), figures.relMse));
            // Rotating positions and normals costs one fp32 rounding each; a sharp highlight multiplies it by up to
            // 1/alpha^2.
            EXPECT_LE(figures.relMse, 1e-8);
            EXPECT_LT(figures.bitEqual, 1.0) << "view space was not used";
        }
    }
}

TEST_F(Invariance, aSceneFarFromTheOriginLooksAsAtTheOrigin) {
    const scenes::Scene near = everythingScene();
    scenes::Scene far = near;
    // 2^20 m along each axis: nodes, lights and camera move; meshes stay relative to their nodes.
    const glm::dvec3 offset(1048576.0, -1048576.0, 1048576.0);
    for (scenes::Node& node : far.nodes) node.parentFromNode[3] += glm::dvec4(offset, 0.0);
    for (scenes::Light& light : far.lights) light.positionWS += offset;
    for (scenes::Camera& camera : far.cameras) camera.worldFromCamera[3] += glm::dvec4(offset, 0.0);
    const validation::ErrorFigures figures = validation::errorFigures(picture(far, small()), picture(near, small()));
    // Doubles keep 2e-10 m at this distance; the rest is its rounding to fp32.
    EXPECT_LE(figures.relMse, 1e-8);
}

TEST_F(Invariance, aLightThatIsOffDarkOrOutOfReachNeverChangesABit) {
    const scenes::Scene scene = everythingScene();
    const Picture before = picture(scene, small());
    scenes::Scene more = scene;
    scenes::Light off = pointLight({0, 1, 1}, 100.0f);
    off.enabled = false;
    scenes::Light dark = pointLight({0, 1, 1}, 0.0f);
    scenes::Light behind = pointLight({0, 2, 60}, 100.0f);
    behind.rangeMetres = 5.0f;
    scenes::Light closed = pointLight({0, 3, 1}, 100.0f);
    closed.type = scenes::LightType::Spot;
    closed.outerConeRadians = 0.0f;
    scenes::Light rangeless = pointLight({0, 1, 1}, 100.0f);
    rangeless.rangeMetres = 0.0f;
    more.lights.insert(more.lights.end(), {off, dark, behind, closed, rangeless});
    for (const bool prune : {true, false}) {
        frame::FrameSettings settings = small();
        settings.prune = prune;
        EXPECT_EQ(picture(more, settings).rgba, before.rgba) << "prune " << prune;
    }
}

} // namespace
} // namespace tessera
