#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "renderer/frame/RefineLayout.h"
#include "scenes/Load.h"
#include "tests/support/ErrorText.h"

namespace tessera::engine {
namespace {

/// Returns the plan's choice of this name; empty without one.
graph::Plan::Choice choiceOf(const graph::Plan& plan, std::string_view what) {
    const auto found = std::ranges::find(plan.choices, what, &graph::Plan::Choice::what);
    return found == plan.choices.end() ? graph::Plan::Choice() : *found;
}

std::uint64_t counterOf(const graph::Plan& plan, std::string_view name) {
    const auto found =
        std::ranges::find(plan.counters, name, [](const auto& counter) { return std::string_view(counter.first); });
    EXPECT_NE(found, plan.counters.end()) << name;
    return found == plan.counters.end() ? 0 : found->second;
}

/// The plan's choices about channels stored differently from the layout.
std::vector<graph::Plan::Choice> channelChoices(const scenes::Scene& scene, const frame::GBufferLayout& layout) {
    frame::FrameSettings settings;
    settings.layout = layout;
    std::vector<graph::Plan::Choice> found;
    for (const graph::Plan::Choice& choice : planFrame(scene, Technique::Deferred, settings).choices)
        if (choice.what.starts_with("G-buffer channel ")) found.push_back(choice);
    return found;
}

TEST(PlanFrame, aChannelThatIsStoredFinerThanTheLayoutIsNamedWithItsReasonAndNoOtherIs) {
    const scenes::Scene scene = scenes::loadScene("models"); // has half-vector masking and anisotropic highlights
    const frame::GBufferLayout& packed = frame::layoutTable()[1].layout;
    const frame::GBufferLayout& slim = frame::layoutTable()[2].layout;
    const std::vector<graph::Plan::Choice> choices = channelChoices(scene, slim);
    const std::vector<frame::Refinement> refinements = frame::refinements(slim, scene);
    ASSERT_EQ(choices.size(), refinements.size());
    std::vector<std::string> channels;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        channels.push_back(choices[i].what);
        EXPECT_EQ(choices[i].chosen, "as in packed");
        EXPECT_FALSE(choices[i].why.empty());
        EXPECT_EQ(choices[i].why, refinements[i].why);
    }
    EXPECT_EQ(channels, (std::vector<std::string>{"G-buffer channel normal", "G-buffer channel microsurface",
                                                  "G-buffer channel tangent"}));
    EXPECT_TRUE(channelChoices(scene, packed).empty());
}

TEST(PlanFrame, aLightThatIsLeftOutSavesJustTheBytesThatALightTakes) {
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights.assign(3, scenes::Light());
    for (const scenes::LightType type : {scenes::LightType::Point, scenes::LightType::Spot}) {
        for (scenes::Light& light : scene.lights) light.type = type;
        scene.lights[1].enabled = scene.lights[2].enabled = false;
        const graph::Plan plan = planFrame(scene, Technique::Forward, {});
        const auto left = std::ranges::find(plan.leftOut, "2 lights", &graph::Plan::LeftOut::what);
        ASSERT_NE(left, plan.leftOut.end());
        EXPECT_EQ(left->bytes, 2 * counterOf(plan, "lightBytes"));
    }
}

TEST(PlanFrame, aChoiceThatASettingMadeNamesTheSettingAndItsDefaultGivesAReason) {
    const scenes::Scene scene = scenes::loadScene("lattice");
    const auto whyTile = [&](std::optional<int> tilePixels) {
        frame::FrameSettings settings;
        settings.culling.tilePixels = tilePixels;
        return choiceOf(planFrame(scene, Technique::ForwardPlus, settings), "tile").why;
    };
    EXPECT_EQ(whyTile(32), "chosen by the setting tile; automatic restores the default");
    EXPECT_THAT(whyTile({}), testing::HasSubstr("fastest"));
}

/// The room with `count` soft lights that cast shadows.
scenes::Scene softLights(std::size_t count) {
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights.assign(count, scene.lights.front());
    for (scenes::Light& light : scene.lights) {
        light.castsShadow = true;
        light.radiusMetres = 0.1f;
    }
    return scene;
}

std::string whyLeftOut(const scenes::Scene& scene, std::string_view what, const frame::FrameSettings& settings = {}) {
    const graph::Plan plan = planFrame(scene, Technique::Deferred, settings);
    const auto left = std::ranges::find(plan.leftOut, what, &graph::Plan::LeftOut::what);
    return left == plan.leftOut.end() ? "not left out" : left->why;
}

TEST(PlanFrame, texturesThatADriverHasNoRoomForAreNamedWithTheReason) {
    scenes::LoadOptions options;
    options.useAssets = false;
    scenes::Scene scene = scenes::loadScene("glass", options);
    for (scenes::Material& material : scene.materials) {
        material.iridescence = material.clearcoat = 1.0f;
        material.sheenColor = glm::vec3(1.0f);
        for (scenes::TextureUse& use : material.textures) use.image = 0;
    }
    if (scene.images.empty()) scene.images.push_back({"texel", {}, 1, 1, std::vector<std::byte>(4)});
    const auto reported = [&](const frame::FrameSettings& settings) {
        return choiceOf(planFrame(scene, Technique::Deferred, settings), "textures").why;
    };
    frame::FrameSettings settings;
    EXPECT_EQ(reported(settings), "");
    EXPECT_EQ(whyLeftOut(scene, "film-thickness texture", settings), "not left out");
    settings.texturesAStage = TEXTURE_UNITS_GUARANTEED;
    EXPECT_THAT(reported(settings), testing::HasSubstr("samples at most 16 textures"));
    EXPECT_THAT(reported(settings), testing::EndsWith("iridescence texture, film-thickness texture"));
    EXPECT_EQ(whyLeftOut(scene, "film-thickness texture", settings),
              "a shader of this driver samples too few textures");
    settings.prune = false;
    EXPECT_THAT(reported(settings), testing::EndsWith("iridescence texture, film-thickness texture"));
}

TEST(PlanFrame, theOneReasonIsGivenWhyThereAreNoShadows) {
    scenes::Scene scene = scenes::loadScene("room");
    frame::FrameSettings settings;
    EXPECT_EQ(whyLeftOut(scene, "shadows"), "no light in view has castsShadow");
    using Kind = scenes::ShadowRequest::Kind;
    for (const scenes::ShadowRequest none : {scenes::ShadowRequest{Kind::None}, {Kind::First, 0}}) {
        settings.shadows = none;
        EXPECT_EQ(whyLeftOut(scene, "shadows", settings), "no light is to cast any");
    }
    settings.shadows = {Kind::All};
    EXPECT_EQ(whyLeftOut(scene, "shadows", settings), "not left out");
    scene.lights.insert(scene.lights.begin(), scene.lights.front());
    scene.lights.front().enabled = false;
    settings.shadows = {Kind::First, 1};
    EXPECT_EQ(whyLeftOut(scene, "shadows", settings), "none of the first 1 light is on and in view");
    settings.shadows = {Kind::All};
    for (scenes::Material& material : scene.materials) material.castsShadow = false;
    EXPECT_EQ(whyLeftOut(scene, "shadows", settings), "no surface casts any");
    for (scenes::Material& material : scene.materials) {
        material.castsShadow = true;
        material.alphaMode = scenes::AlphaMode::Blend;
    }
    EXPECT_THAT(whyLeftOut(scene, "shadows", settings),
                testing::MatchesRegex("no surface casts any; [0-9]+ transparent surfaces cast none"));
    scene.lights.clear();
    EXPECT_EQ(whyLeftOut(scene, "shadows", settings), "no light is on and in view");
}

TEST(PlanFrame, theOneReasonIsGivenWhyNoShadowIsSoft) {
    scenes::Scene scene = softLights(1);
    frame::FrameSettings settings;
    EXPECT_EQ(whyLeftOut(scene, "soft shadows", settings), "not left out");
    settings.shadowFilter = frame::ShadowFilter::Pcf;
    EXPECT_EQ(whyLeftOut(scene, "soft shadows", settings), "the shadow filter pcf ignores the sizes of lights");
    settings.shadowFilter = frame::ShadowFilter::Pcss;
    scene.lights.front().radiusMetres = 0.0f;
    EXPECT_EQ(whyLeftOut(scene, "soft shadows", settings), "no light in view that casts shadows has a size");
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    EXPECT_EQ(whyLeftOut(scene, "soft shadows", settings), "there are no shadows");
}

TEST(PlanFrame, reportsWhatDiffusionCosts) {
    frame::FrameSettings settings;
    settings.diffusion.sideTexels = 128;
    const auto reported = [&](const char* scene) {
        return choiceOf(planFrame(scenes::loadScene(scene), Technique::Deferred, settings), "diffused light");
    };
    const graph::Plan::Choice choice = reported("diffusion_truth");
    // An atlas of two cells side by side plus a row of texels, and two textures per object; 16 bytes per texel.
    EXPECT_EQ(choice.chosen, "2 objects, 128 texels a side, 1.504 MiB kept");
    EXPECT_THAT(choice.why, testing::HasSubstr("levels"));
    EXPECT_EQ(reported("room").what, "");
}

TEST(PlanFrame, lightThatIsNarrowerThanATexelIsReportedWithTheUnitOfTheModel) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    const auto reported = [&] {
        return choiceOf(planFrame(scene, Technique::Deferred, {}), "width of diffused light").why;
    };
    EXPECT_EQ(reported(), "") << "a texel is 0.04 mm";
    for (scenes::Material& material : scene.materials) material.subsurface.scaleMetres = 1e3f;
    const std::string why = reported();
    for (const char* part :
         {"light is not diffused over mesh '", "(material 'skin')",
          "its widest Gaussian is 2.72 mm, and a texel of its atlas", "scaleMetres", "nor over 1 other object"})
        EXPECT_THAT(why, testing::HasSubstr(part));
    for (scenes::Material& material : scene.materials) material.subsurface.method = scenes::SubsurfaceMethod::DepthMap;
    EXPECT_EQ(reported(), "");
}

TEST(PlanFrame, samplesOfAreaLightsThatLoopsOfMesaMayEndAreReportedWithTheRemedy) {
    const scenes::Scene scene = scenes::loadScene("lamps");
    const auto reported = [&](int samples) {
        frame::FrameSettings settings;
        settings.area = {frame::AreaLights::Sampled, samples};
        return choiceOf(planFrame(scene, Technique::Forward, settings), "loops of lights").why;
    };
    EXPECT_EQ(reported(16), "");
    EXPECT_THAT(reported(256), testing::HasSubstr("which gives NaN; give fewer --area-samples"));
}

TEST(PlanFrame, shadowsThatLoopsOfMesaMayEndAreReportedWithTheRemedy) {
    frame::FrameSettings settings;
    const auto reported = [&](const scenes::Scene& scene) {
        return choiceOf(planFrame(scene, Technique::Deferred, settings), "loops of lights");
    };
    // Per light two times 1024 texels, one for the face and one for the light; 116 for the loops over the 64 lights.
    settings.shadowFilter = frame::ShadowFilter::Pcss;
    settings.shadowSamples = 1024;
    EXPECT_EQ(reported(softLights(64)).chosen, "up to 131316 iterations");
    EXPECT_EQ(reported(softLights(64)).why,
              "shadows of 64 lights take up to 131316 iterations of a shader's loops where all reach a pixel, and Mesa "
              "ends those after 65535, which gives NaN; give fewer --shadow-samples or shadows to fewer lights "
              "(--shadows N)");
    settings.softwareBackend = false;
    EXPECT_EQ(reported(softLights(64)).chosen, "");
    settings.softwareBackend = true;
    settings.view = frame::DebugView::Normal;
    EXPECT_EQ(reported(softLights(64)).chosen, "");
    settings.view = frame::DebugView::Final;
    settings.shadowSamples = 16;
    EXPECT_EQ(reported(softLights(64)).chosen, "");
    settings.shadowFilter = frame::ShadowFilter::Traced;
    settings.shadowSamples = 1024;
    EXPECT_THAT(reported(softLights(64)).why, testing::HasSubstr("give fewer --shadow-samples or"));
    settings.shadowFilter = frame::ShadowFilter::Pcf;
    EXPECT_EQ(reported(softLights(1000)).chosen, "") << "21 iterations a light with 3 texels";
    settings.shadowMaps.widthTexels = 7;
    EXPECT_THAT(reported(softLights(1000)).why, testing::HasSubstr("give a smaller --shadow-width or"));
    // A diffusion view has its own lights.
    frame::PreparedView whole;
    whole.diffusionViews = {prepareView(softLights(1000), Technique::Deferred, settings)};
    whole.diffusionObjects.emplace_back().name = "mesh 'bust'";
    EXPECT_THAT(cutShadows(whole).why, testing::StartsWith("when lighting mesh 'bust' for diffusion: shadows of 1000"));
    whole.diffusionViews.clear();
    EXPECT_EQ(cutShadows(whole).why, "");
    // Every cascade counts.
    scenes::Scene suns = softLights(300);
    for (scenes::Light& light : suns.lights) light.type = scenes::LightType::Directional;
    EXPECT_NE(reported(suns).chosen, "");
    settings.shadowMaps.cascades = 1;
    EXPECT_EQ(reported(suns).chosen, "");
}

TEST(PlanFrame, everyRoundOverTheLightsIsAPassThatWaitsForTheOneBefore) {
    scenes::LoadOptions options;
    options.lights = 1000;
    const scenes::Scene scene = scenes::loadScene("lattice", options);
    frame::FrameSettings settings;
    settings.culling.builder = culling::Builder::Compute;
    settings.culling.lanes = 1; // more lights than the loops of one round visit
    const graph::Plan plan = planFrame(scene, Technique::ClusteredDeferred, settings);
    for (const char* step : {"light_count", "light_sizes", "light_lists"}) {
        int rounds = 0;
        for (const graph::Plan::Pass& pass : plan.passes) {
            if (!pass.name.starts_with(step)) continue;
            const bool waits = pass.barrier.find("storage") != std::string::npos;
            EXPECT_TRUE(waits || rounds == 0) << pass.name << ", round " << rounds;
            ++rounds;
        }
        EXPECT_GT(rounds, 1) << step;
    }
}

TEST(PlanFrame, twoViewsOfAFrameReuseMemory) {
    const scenes::Scene scene = scenes::loadScene("hall");
    const std::vector<ViewRequest> views(2);
    const graph::Plan one = planViews(scene, std::span(views).first(1)), two = planViews(scene, views);
    EXPECT_LT(two.bytes, two.bytesWithoutAliasing);
    EXPECT_EQ(one.bytes, one.bytesWithoutAliasing) << "of one view all lives at once";
    // The second view's G-buffer reuses the memory of the first one's.
    const auto sharing = std::ranges::find_if(
        two.resources, [](const graph::Plan::Resource& resource) { return resource.name == "gbuffer.albedo (2)"; });
    ASSERT_NE(sharing, two.resources.end());
    EXPECT_TRUE(sharing->aliasOf.starts_with("gbuffer.")) << sharing->aliasOf;
}

TEST(PlanFrame, theViewsOfAFrameShareTheScenesBuffersAndWhatAnApplicationKeeps) {
    const scenes::Scene scene = scenes::loadScene("hall");
    const std::vector<ViewRequest> views(2);
    std::vector<std::size_t> requested;
    graph::TextureHandle kept;
    const auto add = [&](graph::Graph& graph, std::size_t view, const frame::FrameSpec&, const OpaquePicture& opaque) {
        requested.push_back(view);
        if (view > 0) return opaque.radiance;
        struct Written {
            graph::TextureHandle texture;
        };
        kept = graph.persist("kept", graph::TextureDesc{graph::Format::Rgba32Float, 4, 4}, 1);
        const auto setup = [&](graph::PassBuilder& pass, Written& out) { out.texture = pass.write(kept); };
        kept = graph.addPass<Written>("keep", setup, [](const Written&, const graph::PassContext&) {}).texture;
        graph.output(kept);
        return opaque.radiance;
    };
    const AfterOpaque after{false, add};
    const graph::Plan plan = planViews(scene, views, after);
    EXPECT_THAT(requested, testing::ElementsAre(0u, 1u));
    for (const char* name : {"indices", "materials", "kept"}) {
        EXPECT_EQ(std::ranges::count(plan.resources, name, &graph::Plan::Resource::name), 1) << name;
        EXPECT_EQ(std::ranges::count(plan.resources, name + std::string(" (2)"), &graph::Plan::Resource::name), 0);
    }
}

TEST(PlanFrame, aPlanWithPassesOfAnApplicationReportsWhatTheyStoreAndWhichAreLeftOut) {
    const scenes::Scene scene = scenes::loadScene("hall");
    const ViewRequest view{Technique::Forward, {}};
    const auto add = [](graph::Graph& graph, std::size_t, const frame::FrameSpec& spec, const OpaquePicture& opaque) {
        struct Data {
            graph::TextureHandle texture;
        };
        const auto setup = [&](graph::PassBuilder& pass, Data& data) {
            data.texture = pass.create("unread", spec.texture(graph::Format::Rgba32Float));
        };
        graph.addPass<Data>("unread_pass", setup, [](const Data&, const graph::PassContext&) {});
        graph.output(opaque.gbuffer.value().textures.front());
        return opaque.radiance;
    };
    const graph::Plan plan = planViews(scene, {&view, 1}, {true, add});
    EXPECT_GT(counterOf(plan, "gbufferBytesPerPixel"), 0u);
    EXPECT_THAT(plan.leftOut,
                testing::Contains(testing::Field(&graph::Plan::LeftOut::what, testing::HasSubstr("unread_pass"))));
}

TEST(PlanFrame, aFrameOfViewsLeavesOutChoosesAndCountsWhatItsViewsDo) {
    const scenes::Scene scene = scenes::loadScene("hall");
    std::vector<ViewRequest> views(2);
    views[1].technique = Technique::Forward;
    const graph::Plan first = planFrame(scene, views[0].technique, views[0].settings);
    const graph::Plan second = planFrame(scene, views[1].technique, views[1].settings);
    const graph::Plan both = planViews(scene, views);
    EXPECT_EQ(both.leftOut.size(), first.leftOut.size() + second.leftOut.size());
    EXPECT_EQ(both.choices.size(), first.choices.size() + second.choices.size());
    ASSERT_FALSE(first.counters.empty());
    ASSERT_EQ(both.counters.size(), first.counters.size() + second.counters.size());
    EXPECT_EQ(both.counters.front(), first.counters.front());
    EXPECT_EQ(both.counters.back().first, second.counters.back().first + " (2)");
    EXPECT_EQ(both.leftOut.back().what, second.leftOut.back().what + " (2)");
}

TEST(PlanFrame, viewsThatCannotBeOneFrameAreAlwaysRefused) {
    const scenes::Scene scene = scenes::loadScene("room");
    std::vector<ViewRequest> views(2);
    views[1].settings.prune = false;
    EXPECT_EQ(test::errorText<InputError>([&] { planViews(scene, views); }),
              "views of a frame have prune on and prune off; give all of them the same");
    views[1] = views[0];
    views[1].settings.filter = frame::TextureFilter::Exact;
    EXPECT_THROW(planViews(scene, views), InputError);
    EXPECT_THROW(planViews(scene, {}), std::logic_error);
}

TEST(PlanFrame, aDepthPrepassNeverReadsMaterialsButThoseWithHoles) {
    scenes::Scene scene = scenes::loadScene("room");
    const auto reads = [&] {
        const graph::Plan plan = planFrame(scene, Technique::ForwardPrepass, {});
        const auto pass = std::ranges::find(plan.passes, "depth_prepass", &graph::Plan::Pass::name);
        return pass->reads;
    };
    EXPECT_THAT(reads(), testing::Not(testing::Contains("materials")));
    scene.materials.front().alphaMode = scenes::AlphaMode::Mask;
    EXPECT_THAT(reads(), testing::Contains("materials"));
}

TEST(PlanFrame, surfacesAreStoredInForwardTechniquesOnlyOnDemand) {
    const scenes::Scene scene = scenes::loadScene("room");
    for (const TechniqueInfo& info : techniqueTable()) {
        const graph::Plan plan = planFrame(scene, info.technique, {});
        const auto stored = std::ranges::count(plan.passes, "gbuffer", &graph::Plan::Pass::name);
        EXPECT_EQ(stored, info.usesGBuffer() ? 1 : 0) << info.name;
    }
}

} // namespace
} // namespace tessera::engine
