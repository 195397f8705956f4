#include "engine/Renderer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "passes/DiffusionPasses.h"
#include "renderer/frame/MaterialFeatures.h"
#include "renderer/frame/TextureRoom.h"
#include "renderer/graph/Execute.h"
#include "renderer/graph/Plan.h"
#include "scenes/Hook.h"

namespace tessera::engine {

namespace {

/// Flips rows, since GL's run bottom-up.
template <typename T>
std::vector<T> flipped(const std::vector<T>& rows, int width, int height) {
    std::vector<T> result(rows.size());
    const std::size_t pitch = std::size_t(width) * 4;
    for (int y = 0; y < height; ++y) {
        std::copy_n(rows.begin() + std::ptrdiff_t(std::size_t(height - 1 - y) * pitch), pitch,
                    result.begin() + std::ptrdiff_t(std::size_t(y) * pitch));
    }
    return result;
}

/// Checks every hook source as loading the scene did, since an edit may have added forbidden constructs.
shader::SourceTree checkingHooks(shader::SourceTree shaders) {
    shaders.prepareHooks(scenes::hookProgramText);
    return shaders;
}

/// The resource of this plan name, if a pass that runs uses its newest version.
std::optional<std::uint32_t> findUsed(const graph::Graph& graph, const graph::CompiledGraph& compiled,
                                      const std::string& name) {
    if (name.empty()) return std::nullopt;
    const std::vector<std::string> names = graph::resourceNames(graph);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    const auto resource = std::uint32_t(found - names.begin());
    const auto leavesNewest = [&](const graph::Graph::Use& use) {
        return use.resource == resource && use.version == graph.resources()[resource].newestVersion;
    };
    const bool isUsed = std::ranges::any_of(compiled.order, [&](const graph::CompiledPass& entry) {
        return std::ranges::any_of(graph.passes()[entry.pass].uses, leavesNewest);
    });
    return isUsed ? std::optional(resource) : std::nullopt;
}

/// Calls `act` with a handle of the newest version of a resource.
template <typename Act>
void withHandle(const graph::Graph& graph, std::uint32_t resource, const Act& act) {
    const graph::Graph::Resource& named = graph.resources()[resource];
    if (std::holds_alternative<graph::TextureDesc>(named.desc))
        act(graph::TextureHandle{resource, named.newestVersion});
    else
        act(graph::BufferHandle{resource, named.newestVersion});
}

} // namespace

struct Renderer::Drawn {
    explicit Drawn(graph::Graph::Keeps keeps) : graph(std::move(keeps)) {}

    std::vector<frame::DrawnView> views;
    std::vector<DeclaredView> declared; ///< parallel to views
    graph::Graph graph;
    graph::CompiledGraph compiled;
    std::optional<std::uint32_t> kept; ///< keptResource(), index into Graph::resources()
    std::unique_ptr<graph::Execution> execution;
};

Renderer::Renderer(gpu::Context& context, const scenes::Scene& scene, shader::SourceTree shaders)
    : context_(context),
      hooked_(scene.hook && scene.hook->movesVertices ? std::make_unique<HookedScene>(scene) : nullptr),
      shown_(hooked_ ? hooked_->scene() : scene), bounds_(frame::surfaceBounds(shown_)),
      programs_(checkingHooks(std::move(shaders))), uvAtlases_(shown_) {}

Renderer::~Renderer() = default;

const frame::SceneGpu& Renderer::sceneGpu(const frame::FrameSpec& spec) {
    constexpr std::size_t kMostUploaded = 2;
    // Light types change from frame to frame and do not concern the scene's buffers.
    const frame::FeatureSet features = frame::surfaceFeatures(shown_, spec.settings.prune, spec.settings.subsurface);
    const frame::TextureFilter filter = spec.settings.filter;
    const scenes::SubsurfaceRequest subsurface = spec.settings.subsurface;
    const auto found = std::ranges::find_if(uploaded_, [&](const Uploaded& uploaded) {
        return uploaded.features == features && uploaded.filter == filter && uploaded.subsurface == subsurface;
    });
    if (found == uploaded_.end()) {
        if (uploaded_.size() == kMostUploaded) uploaded_.pop_back(); // at most two at once
        frame::FeatureSet uploads = features;
        if (spec.features[frame::Feature::Shadows]) uploads.add(frame::Feature::Shadows);
        auto scene = std::make_unique<frame::SceneGpu>(shown_, closedMeshes_, uploads, filter, subsurface);
        uploaded_.insert(uploaded_.begin(), {features, filter, subsurface, std::move(scene)});
    } else {
        if (found->geometryChanged)
            found->scene->updateGeometry();
        else if (found->materialsChanged)
            found->scene->updateMaterials();
        found->materialsChanged = found->geometryChanged = false;
        std::rotate(uploaded_.begin(), found, found + 1);
    }
    return *uploaded_.front().scene;
}

void Renderer::geometryChanged() {
    if (hooked_) hooked_->takeMeshes();
    forgetGeometry();
}

void Renderer::environmentChanged(std::shared_ptr<const frame::FilteredEnvironment> filtered) {
    if (hooked_) hooked_->takeEnvironment();
    environment_.reset();
    filteredEnvironment_ = std::move(filtered);
    for (auto& [view, memory] : diffusionMemories_) memory.forget();
}

const scenes::Scene& Renderer::sceneAt(double timeSeconds, Excess excess) {
    if (!hooked_) return shown_;
    const HookedScene::Changed changed = hooked_->update(timeSeconds, excess, programs_);
    if (changed.vertices || changed.colors) forgetGeometry();
    if (changed.colors) uploaded_.clear(); // colours are a vertex attribute and affect features
    return shown_;
}

void Renderer::forgetGeometry() {
    drawn_.reset(); // it references atlases
    bounds_ = frame::surfaceBounds(shown_);
    closedMeshes_.verticesMoved();
    uvAtlases_.forget();
    for (auto& [view, memory] : diffusionMemories_) memory.forget();
    for (Uploaded& uploaded : uploaded_) uploaded.geometryChanged = true;
}

void Renderer::forgetReloaded() {
    if (std::exchange(reloaded_, programs_.reloaded()) == programs_.reloaded()) return;
    for (auto& [view, memory] : diffusionMemories_) memory.forget();
    shadowMemories_.forget();
}

/// Creates the scene data that the view's shadows need.
void Renderer::makeForShadows(const frame::FrameSpec& spec) {
    frame::SceneGpu& scene = *uploaded_.front().scene;
    if (spec.features[frame::Feature::Shadows]) scene.makeFacetNormals();
    if (spec.tracesShadows()) scene.makeCasters();
}

/// Tiles of an object's atlas that the view may sample. With several samples per pixel, texture coordinates are
/// extrapolated beyond their triangle, to anywhere in the atlas.
frame::TileSet Renderer::seenTiles(const frame::DiffusionObject& object, const frame::GpuUvAtlas& atlas,
                                   const frame::DrawnView& view) const {
    const frame::DrawList& list = view.scene->drawList();
    const auto drawn = std::ranges::find_if(
        view.draws.seen, [&](int i) { return list.draws[std::size_t(i)].instance == object.instance; });
    const frame::FrameSpec& spec = view.prepared.spec;
    if (diffusesAll(view.prepared)) return frame::usedTiles(atlas.tiles);
    const bool seesAll = !spec.settings.prune || spec.samples > 1;
    if (drawn == view.draws.seen.end() || seesAll) return frame::usedTiles(atlas.tiles, drawn != view.draws.seen.end());
    const frame::CameraView& camera = view.prepared.camera;
    const glm::dvec3 objectWS(list.worldFromObject[std::size_t(object.node)][3]);
    return frame::seenTiles(atlas.tiles, camera,
                            frame::roundingMetres(list.draws[std::size_t(*drawn)], objectWS, camera),
                            shown_.materials[std::size_t(object.material)].doubleSided);
}

void Renderer::addDiffusionViews(std::size_t number, frame::DrawnView& view) {
    const frame::PreparedView& prepared = view.prepared;
    if (prepared.diffusionViews.empty()) return;
    view.diffusionMemory = &diffusionMemories_[number];
    if (!keepsDiffusedLight_) view.diffusionMemory->forget();
    view.diffusionMemory->limit(diffusionLimit_ ? std::optional(diffusionLimit_->tiles) : std::nullopt);
    const frame::DrawList& list = view.scene->drawList();
    for (std::size_t cell = 0; cell < prepared.diffusionViews.size(); ++cell) {
        const frame::DiffusionObject& object = prepared.diffusionObjects[cell];
        frame::DrawnView::DiffusionView& own = view.diffusionViews.emplace_back();
        own.drawn.prepared = prepared.diffusionViews[cell];
        own.drawn.scene = view.scene;
        own.drawn.environment = view.environment;
        own.drawn.lobes = view.lobes;
        own.drawn.lightPictures = view.lightPictures;
        const frame::FrameSpec& spec = own.drawn.prepared.spec;
        makeForShadows(spec);
        const auto isOwn = [&](const frame::Draw& draw) { return draw.instance == object.instance; };
        own.drawn.draws = frame::makeViewDraws(list, own.drawn.prepared.camera, false, isOwn);
        if (spec.features[frame::Feature::ShadowMaps])
            own.drawn.shadowMemory = &shadowMemories_.of(numberOfObject(number, cell), spec.settings);
        own.uvAtlas = &uvAtlases_.of(object, spec.diffusionTexels(), spec.gutterTexels);
        own.key = frame::diffusionKey(shown_, object, own.drawn.prepared, view.scene->casterRevision());
        own.seen = seenTiles(object, *own.uvAtlas, view);
        // Kept even if this frame does not read it: the next one may.
        for (const std::string& name : passes::DiffusionPasses::keptNames(number, cell)) backend_.keep(name);
    }
}

void Renderer::connectDiffusionReport(std::vector<frame::DrawnView>& views) const {
    if (!reportDiffusion_) return;
    std::size_t objects = 0;
    for (const frame::DrawnView& view : views)
        for (std::size_t cell = 0; cell < view.diffusionViews.size(); ++cell)
            if (const auto& own = view.diffusionViews[cell];
                !view.diffusionMemory->missing(cell, own.key, own.seen).isEmpty())
                ++objects;
    if (objects == 0) return;
    const auto report = [this, objects, done = std::make_shared<std::size_t>(0)] {
        gpu::finish();
        if (*done < objects) reportDiffusion_(++*done, objects);
    };
    for (frame::DrawnView& view : views) view.objectDiffused = report;
    reportDiffusion_(0, objects);
}

void Renderer::draw(std::span<const ViewRequest> views, const AfterOpaque& after) {
    requireOneFrame(views);
    const double timeSeconds = views.front().settings.timeSeconds;
    if (hooked_ &&
        !std::ranges::all_of(views, [&](const ViewRequest& view) { return view.settings.timeSeconds == timeSeconds; }))
        throw InputError("a hook moves vertices of the scene for all views of a frame; give all of them one time");
    const bool marks = std::ranges::any_of(
        views, [](const ViewRequest& view) { return view.settings.view == frame::DebugView::MovedTooFar; });
    sceneAt(timeSeconds, marks ? Excess::Mark : Excess::Refuse);
    forgetReloaded();
    auto drawn =
        std::make_unique<Drawn>([this](const std::string& name, const graph::ResourceDesc& desc,
                                       std::uint64_t revision) { return backend_.holds(name, desc, revision); });
    for (const ViewRequest& view : views) {
        frame::DrawnView& added = drawn->views.emplace_back();
        frame::FrameSettings settings = settingsOn(context_.capabilities(), view.settings);
        settings.hasClosedBodies = scenes::hasClosedBodies(shown_, closedMeshes_);
        added.prepared = prepareView(shown_, view.technique, settings, bounds_);
    }
    std::vector<ViewSource> sources;
    shadowMemories_.beginFrame();
    for (std::size_t i = 0; i < views.size(); ++i) {
        const frame::SceneGpu& sceneGpuOfAll = sceneGpu(drawn->views[i].prepared.spec);
        frame::DrawnView& view = drawn->views[i];
        const frame::FrameSpec& spec = view.prepared.spec;
        view.scene = &sceneGpuOfAll;
        if (spec.environment && !environment_)
            environment_ =
                std::make_unique<frame::EnvironmentGpu>(*shown_.environment, std::move(filteredEnvironment_));
        view.environment = environment_.get();
        view.lobes = &lobes_;
        view.lightPictures = &lightPictures_;
        makeForShadows(spec);
        view.draws = frame::makeViewDraws(view.scene->drawList(), view.prepared.camera, spec.settings.prune);
        view.listMemory = &listMemory_;
        if (spec.features[frame::Feature::ShadowMaps]) view.shadowMemory = &shadowMemories_.of(i, spec.settings);
        addDiffusionViews(i, view);
        sources.push_back({views[i].technique, spec, &view});
    }
    drawn->declared = declareFrame(drawn->graph, sources, after);
    connectDiffusionReport(drawn->views);
    const bool prune = drawn->views.front().prepared.spec.settings.prune;
    const graph::CompileOptions options{.cull = prune, .alias = prune};
    drawn->compiled = graph::compile(drawn->graph, options);
    drawn->kept = findUsed(drawn->graph, drawn->compiled, keptName_);
    if (drawn->kept && !drawn->graph.resources()[*drawn->kept].imported) {
        withHandle(drawn->graph, *drawn->kept, [&](auto handle) { drawn->graph.output(handle); });
        drawn->compiled = graph::compile(drawn->graph, options);
    }
    programs_.warm(drawn->compiled.programs);
    drawn_.reset(); // returns its textures to the pool
    auto execution = std::make_unique<graph::Execution>(drawn->graph, drawn->compiled, backend_, &programs_);
    execution->run();
    drawn->execution = std::move(execution);
    drawn_ = std::move(drawn);
}

const Renderer::Drawn& Renderer::latest() const {
    if (!drawn_) throw std::logic_error("no frame is drawn: draw() was not called or has failed");
    return *drawn_;
}

const gpu::Texture& Renderer::radianceTexture(std::size_t view) const {
    return latest().execution->texture(latest().declared.at(view).radiance);
}

const gpu::Texture& Renderer::displayTexture(std::size_t view) const {
    return latest().execution->texture(latest().declared.at(view).display);
}

const gpu::Texture& Renderer::texture(graph::TextureHandle output) const {
    return latest().execution->texture(output);
}

RenderedFrame Renderer::download(std::size_t view) const {
    const bool display = latest().views.at(view).prepared.spec.settings.display;
    return readBack(radianceTexture(view), display ? &displayTexture(view) : nullptr);
}

RenderedFrame readBack(const gpu::Texture& radiance, const gpu::Texture* display) {
    RenderedFrame frame;
    frame.width = radiance.desc().width;
    frame.height = radiance.desc().height;
    frame.radiance = flipped(radiance.downloadAs<float>(), frame.width, frame.height);
    if (display != nullptr) frame.display = flipped(display->downloadAs<std::uint8_t>(), frame.width, frame.height);
    return frame;
}

std::optional<KeptResource> Renderer::keptResource() const {
    const Drawn& drawn = latest();
    if (!drawn.kept) return std::nullopt;
    KeptResource kept;
    withHandle(drawn.graph, *drawn.kept, [&]<typename Handle>(Handle handle) {
        if constexpr (std::is_same_v<Handle, graph::TextureHandle>) {
            kept.texture = &drawn.execution->texture(handle);
        } else {
            kept.buffer = &drawn.execution->buffer(handle);
            kept.bytes = drawn.execution->bytes(handle);
        }
    });
    return kept;
}

std::vector<float> Renderer::downloadDepth(std::size_t view) const {
    return latest().execution->texture(latest().declared.at(view).depth).downloadAs<float>();
}

DrawnLists Renderer::downloadLists(std::size_t view) const {
    const frame::PreparedView& prepared = latest().views.at(view).prepared;
    DrawnLists drawn;
    drawn.culling = prepared.spec.culling;
    drawn.view = prepared.camera.constants;
    drawn.lighting = prepared.lighting;
    drawn.depths = prepared.camera.depths;
    drawn.sceneIndex = prepared.lights.sceneIndex;
    for (std::size_t i = 0; i < prepared.lights.texels.size(); ++i) {
        if (prepared.lights.texels[i].position.w == 0.0f) drawn.everywhere.push_back(std::uint32_t(i));
    }
    if (const std::optional<frame::LightListHandles>& lists = latest().declared[view].lists) {
        const auto all = [&](graph::BufferHandle from, auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            const graph::Execution& execution = *latest().execution;
            values = execution.buffer(from).downloadAs<Value>(execution.bytes(from) / sizeof(Value));
        };
        all(lists->tiles, drawn.lists.tiles);
        all(lists->cells, drawn.lists.cells);
        all(lists->entries, drawn.lists.entries);
    }
    return drawn;
}

std::string Renderer::missingTextures(std::size_t view) const {
    return frame::missingTextures(latest().views.at(view).prepared.spec);
}

std::string Renderer::invisibleDiffusion(std::size_t view) const {
    return engine::invisibleDiffusion(shown_, latest().views.at(view).prepared);
}

DiffusionProgress Renderer::diffusionProgress(std::size_t view) const {
    const frame::DrawnView& drawn = latest().views.at(view);
    DiffusionProgress progress;
    progress.isOfAll = diffusesAll(drawn.prepared);
    for (std::size_t cell = 0; cell < drawn.diffusionViews.size(); ++cell) {
        const frame::DrawnView::DiffusionView& own = drawn.diffusionViews[cell];
        const std::size_t tiles = own.seen.count();
        if (tiles == 0) continue;
        const std::size_t missing = drawn.diffusionMemory->missing(cell, own.key, own.seen).count();
        ++progress.objects;
        progress.doneObjects += missing == 0;
        progress.tiles += tiles;
        progress.doneTiles += tiles - missing;
    }
    return progress;
}

DrawnShadows Renderer::shadows(std::size_t view) const {
    const frame::DrawnView& drawnView = latest().views.at(view);
    const frame::PreparedView& prepared = drawnView.prepared;
    DrawnShadows drawn;
    drawn.hasMaps = prepared.spec.features[frame::Feature::ShadowMaps];
    // Shadowed lights come first.
    for (std::size_t i = 0; i < prepared.lights.shadowed; ++i) drawn.lights.push_back({prepared.lights.sceneIndex[i]});
    if (const auto shown = std::size_t(prepared.lights.shown); shown < drawn.lights.size()) drawn.shown = shown;
    drawn.cut = cutShadows(prepared).why;
    drawn.missing = missingShadows(shown_, bounds_, prepared);
    if (!drawn.hasMaps) return drawn;
    const frame::ShadowMaps& maps = prepared.shadowMaps;
    for (const frame::ShadowedLight& light : maps.lights) {
        DrawnShadows::Light& own = drawn.lights[light.light];
        own.faces = light.faces;
        own.wantedTexels = light.wantedTexels;
        own.sideTexels = light.sideTexels;
    }
    drawn.atlasTexels = maps.atlasTexels;
    drawn.budgetMiB = prepared.spec.settings.shadowMaps.budgetMiB;
    drawn.faces = maps.faces.size();
    drawn.drawnFaces = drawnView.shadowMemory->drawnFaces();
    return drawn;
}

} // namespace tessera::engine
