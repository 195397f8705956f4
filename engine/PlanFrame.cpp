#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/RefineLayout.h"
#include "renderer/frame/TextureRoom.h"
#include "scenes/CameraNames.h"
#include "scenes/InUse.h"
#include "scenes/Shadows.h"

namespace tessera::engine {

namespace {

std::string truncationWords(const frame::TruncatedLights& lights, double tolerance) {
    if (lights.sum() == 0) return "no light that is on falls off by A B C or from an area, so it ends none";
    if (tolerance == 0.0)
        return fmt::format("falloff by A B C or from an area of {} never ends; a tolerance above 0 gives it a radius",
                           frame::lightsText(lights.sum()));
    std::string words;
    const auto add = [&](const std::string& part) { words += (words.empty() ? "" : "; ") + part; };
    if (lights.ended > 0)
        add(fmt::format("{} with falloff by A B C or from an area made finite, radii {:.4g} m to {:.4g} m",
                        frame::lightsText(lights.ended), lights.shortestMetres, lights.longestMetres));
    if (lights.belowAlready > 0)
        add(fmt::format("{} nowhere above it, so dark", frame::lightsText(lights.belowAlready)));
    if (lights.endless > 0) add(fmt::format("{} without end, B = C = 0", frame::lightsText(lights.endless)));
    return words;
}

/// Adds channels that are stored more precisely than in the requested layout.
void addRefinements(graph::Plan& plan, const scenes::Scene& scene, const frame::GBufferLayout& requested,
                    const frame::FrameSpec& spec) {
    for (const frame::Refinement& refinement : frame::refinements(requested, scene, spec.settings.subsurface)) {
        if (std::find(spec.channels.begin(), spec.channels.end(), refinement.channel) == spec.channels.end()) continue;
        plan.choices.push_back(
            {fmt::format("G-buffer channel {}", frame::channelTable()[std::size_t(refinement.channel)].name),
             fmt::format("as in {}", frame::layoutTable()[std::size_t(refinement.encoding)].name),
             std::string(refinement.why)});
    }
}

/// Describes the shading of area lights.
graph::Plan::Choice areaChoice(const frame::FrameSpec& spec) {
    const std::string name(infoOf(spec.settings.area.lights).name);
    const std::string why = fmt::format("light of {} with a surface", frame::lightsText(spec.areaLights));
    if (!spec.usesAreaSamples()) return {"area lights", name, why + ", in closed form"};
    return {"area lights", name,
            fmt::format("{}, {} sample{} a pixel of each kind", why, spec.settings.area.samples,
                        spec.settings.area.samples == 1 ? "" : "s")};
}

/// Describes the cost of diffusion: atlases, and levels of each object.
graph::Plan::Choice diffusionChoice(const frame::PreparedView& prepared) {
    constexpr std::size_t kMostNamed = 4;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < std::min(prepared.diffusionViews.size(), kMostNamed); ++i) {
        const std::size_t levels = prepared.diffusionViews[i].spec.diffusionKernel->levels.size();
        words.push_back(
            fmt::format("{}: {} level{}", prepared.diffusionObjects[i].name, levels, levels == 1 ? "" : "s"));
    }
    if (prepared.diffusionViews.size() > kMostNamed)
        words.push_back(fmt::format("{} more", prepared.diffusionViews.size() - kMostNamed));
    const frame::FrameSpec& spec = prepared.spec;
    return {"diffused light",
            fmt::format("{} object{}, {} texels a side, {:.4g} MiB kept", prepared.diffusionViews.size(),
                        prepared.diffusionViews.size() == 1 ? "" : "s", spec.diffusionTexels(),
                        spec.diffusionBytes() / 1048576.0),
            fmt::format("{}; only visible tiles are lit and diffused", fmt::join(words, ", "))};
}

graph::Plan::Choice atlasChoice(const frame::ShadowMaps& maps, const frame::FrameSettings& settings) {
    const auto bytes = double(graph::descBytes(maps.atlas()));
    std::map<int, std::size_t> sides;
    for (const frame::ShadowedLight& light : maps.lights)
        if (light.sideTexels > 0) sides[light.sideTexels] += std::size_t(light.faces);
    std::vector<std::string> words;
    for (const auto& [side, faces] : sides) words.push_back(fmt::format("{} of {}x{}", faces, side, side));
    std::string why = words.empty() ? "no faces" : fmt::format("faces: {}", fmt::join(words, ", "));
    if (maps.reduced() > 0)
        why += fmt::format("; the budget of {:g} MiB leaves {} fewer texels than wanted", settings.shadowMaps.budgetMiB,
                           frame::lightsText(maps.reduced()));
    if (const std::string lost = lostShadows(maps, settings); !lost.empty()) why += "; " + lost;
    return {"shadow atlas",
            fmt::format("{}x{} texels, {:.4g} MiB", maps.atlasTexels.x, maps.atlasTexels.y, bytes / 1048576.0),
            std::move(why)};
}

void addChoices(graph::Plan& plan, const scenes::Scene& scene, const frame::PreparedView& prepared) {
    const frame::FrameSettings& settings = prepared.spec.settings;
    plan.choices.push_back({"camera", scenes::nameOfCamera(scene, std::size_t(settings.camera)),
                            "the one that the setting camera names, else the first"});
    plan.choices.push_back(
        {"light store", "buffer texture, RGBA32F",
         "read fastest of uniform, storage and texture buffers on software rasterisers, and has no 64 KiB limit"});
    plan.choices.push_back(
        {"lighting space", settings.space == frame::LightingSpace::World ? "world axes" : "view",
         "the eye is subtracted in double precision, so scenes far from the origin keep their digits"});
    const frame::TruncatedLights& truncated = prepared.lights.truncated;
    if (settings.rangeTolerance > 0.0 || truncated.sum() > 0) {
        plan.choices.push_back({"range tolerance", fmt::format("{:g}", settings.rangeTolerance),
                                truncationWords(truncated, settings.rangeTolerance)});
    }
    if (prepared.lights.shadowed > 0) {
        const scenes::CasterCounts casters = scenes::casterCounts(scene);
        std::string why = fmt::format("{} triangles hide light", casters.triangles);
        if (casters.transparent > 0) why += "; " + frame::transparentText(casters.transparent);
        const bool hasMaps = prepared.spec.features[frame::Feature::ShadowMaps];
        plan.choices.push_back(
            {"shadows",
             fmt::format("of {} of {}, {}", prepared.lights.shadowed - prepared.shadowMaps.unmapped(),
                         frame::lightsText(prepared.lights.texels.size()),
                         hasMaps ? fmt::format("in maps ({})", infoOf(settings.shadowFilter).name) : "traced"),
             std::move(why)});
        if (hasMaps) plan.choices.push_back(atlasChoice(prepared.shadowMaps, settings));
    }
    if (prepared.spec.areaLights > 0) plan.choices.push_back(areaChoice(prepared.spec));
    if (CutShadows cut = cutShadows(prepared); !cut.why.empty())
        plan.choices.push_back(
            {"loops of lights", fmt::format("up to {} iterations", cut.iterations), std::move(cut.why)});
    if (!prepared.diffusionViews.empty()) plan.choices.push_back(diffusionChoice(prepared));
    if (std::string unseen = invisibleDiffusion(scene, prepared); !unseen.empty())
        plan.choices.push_back({"width of diffused light", "less than a texel", std::move(unseen)});
    if (std::string missing = frame::missingTextures(prepared.spec); !missing.empty())
        plan.choices.push_back({"textures",
                                prepared.spec.withoutTextures.empty()
                                    ? "none of materials left out"
                                    : fmt::format("{} left out", prepared.spec.withoutTextures.size()),
                                std::move(missing)});
    for (const std::string& warning : scene.warnings) plan.choices.push_back({"scene", scene.name, warning});
}

std::vector<std::pair<std::string, std::uint64_t>>
countersOf(const scenes::Scene& scene, const frame::PreparedView& prepared, bool storesSurfaces) {
    std::size_t draws = 0;
    for (const scenes::Node& node : scene.nodes)
        draws += std::size_t(
            std::count_if(node.instances.begin(), node.instances.end(),
                          [&](const scenes::MeshInstance& instance) { return scenes::isDrawn(scene, instance); }));
    const frame::FrameSpec& spec = prepared.spec;
    const glm::ivec2 size = spec.settings.sizePixels;
    const int gbufferBytes = storesSurfaces ? spec.gbufferBytesPerPixel() : 0;
    return {{"triangles", scenes::triangleCount(scene)},
            {"draws", draws},
            {"lights", scene.lights.size()},
            {"lightsEvaluated", prepared.lights.texels.size()},
            {"lightBytes", frame::lightBytes(prepared.lights.features, prepared.lights.texels.size())},
            {"gbufferBytesPerPixel", std::uint64_t(gbufferBytes)},
            {"pixels", std::uint64_t(size.x) * std::uint64_t(size.y)}};
}

/// Adds a view's omitted parts, choices and counters, with names that end in `suffix`.
void addView(graph::Plan& plan, const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings,
             const frame::PreparedView& prepared, const std::string& suffix) {
    const bool storesSurfaces =
        std::ranges::find(plan.passes, "gbuffer" + suffix, &graph::Plan::Pass::name) != plan.passes.end();
    const std::size_t choicesBefore = plan.choices.size();
    for (graph::Plan::LeftOut& item : frame::leftOut(scene, prepared.spec, prepared.lights, storesSurfaces)) {
        item.what += suffix;
        plan.leftOut.push_back(std::move(item));
    }
    addChoices(plan, scene, prepared);
    const auto append = [&](std::vector<graph::Plan::Choice> choices) {
        std::ranges::move(choices, std::back_inserter(plan.choices));
    };
    append(cullingChoices(technique, settings, prepared.spec.features, prepared.spec.culling));
    append(sampleChoices(settings));
    if (std::optional<graph::Plan::Choice> choice = lightingChoice(technique, settings))
        plan.choices.push_back(std::move(*choice));
    if (storesSurfaces) addRefinements(plan, scene, settings.layout, prepared.spec);
    for (std::size_t i = choicesBefore; i < plan.choices.size(); ++i) plan.choices[i].what += suffix;
    for (auto& [name, value] : countersOf(scene, prepared, storesSurfaces))
        plan.counters.emplace_back(name + suffix, value);
}

} // namespace

graph::Plan planViews(const scenes::Scene& scene, std::span<const ViewRequest> views, const AfterOpaque& after) {
    requireOneFrame(views);
    std::vector<frame::PreparedView> prepared;
    for (const ViewRequest& view : views) prepared.push_back(prepareView(scene, view.technique, view.settings));
    std::vector<ViewSource> sources;
    for (std::size_t i = 0; i < views.size(); ++i) sources.push_back({views[i].technique, prepared[i].spec});
    graph::Graph graph;
    declareFrame(graph, sources, after);
    const bool prune = views.front().settings.prune;
    graph::Plan plan = graph::makePlan(graph, graph::compile(graph, {.cull = prune, .alias = prune}));
    plan.scene = scene.name;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const ViewRequest& view = views[i];
        plan.technique += (i == 0 ? "" : ", ") + std::string(infoOf(view.technique).name);
        // The graph names resources of later views the same way.
        addView(plan, scene, view.technique, view.settings, prepared[i], i == 0 ? "" : fmt::format(" ({})", i + 1));
    }
    return plan;
}

graph::Plan planFrame(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings) {
    const ViewRequest view{technique, settings};
    return planViews(scene, {&view, 1});
}

namespace {

std::vector<shader::ProgramDesc> programsOfView(Technique technique, const frame::PreparedView& prepared, bool cull) {
    const ViewSource view{technique, prepared.spec};
    graph::Graph graph;
    declareFrame(graph, {&view, 1});
    return graph::compile(graph, {.cull = cull}).programs;
}

} // namespace

std::vector<shader::ProgramDesc> framePrograms(const scenes::Scene& scene, Technique technique,
                                               const frame::FrameSettings& settings) {
    return programsOfView(technique, prepareView(scene, technique, settings), false);
}

std::vector<shader::ProgramDesc> Renderer::programsOf(Technique technique, const frame::FrameSettings& settings) const {
    const frame::FrameSettings own = settingsOn(context_.capabilities(), settings);
    return programsOfView(technique, prepareView(shown_, technique, own, bounds_), own.prune);
}

} // namespace tessera::engine
