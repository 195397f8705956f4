#include "passes/recipes/Renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passes/recipes/ChooseSamples.h"
#include "passes/recipes/PreparedFrame.h"
#include "renderer/graph/Execute.h"
#include "scenes/Error.h"
#include "shaders/shared/display.h"
#include "shaders/shared/frame.h"

namespace tessera::recipes {

namespace {

shared::DisplayConstants displayConstants(const frame::FrameSettings& settings) {
    shared::DisplayConstants constants{};
    constants.exposure = glm::vec4(std::exp2(settings.exposureEV));
    const frame::DisplayMapping mapping = frame::displayMapping(settings.view, settings.layout);
    constants.mapping = glm::uvec4(unsigned(mapping), unsigned(settings.toneMap), 0u, 0u);
    return constants;
}

/// GL's rows run from the bottom.
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

} // namespace

struct Renderer::Drawn {
    frame::FrameSettings settings;
    PreparedFrame prepared;
    std::unique_ptr<frame::FrameResources> resources;
    DeclaredFrame frame;
    graph::CompiledGraph compiled;
    std::unique_ptr<graph::Execution> execution;
};

Renderer::Renderer(gpu::Context& context, const scenes::Scene& scene, shader::SourceTree shaders)
    : context_(context), scene_(scene), bounds_(frame::surfaceBounds(scene)), programs_(std::move(shaders)),
      frameConstants_("frame constants", sizeof(shared::FrameConstants), gpu::BufferUse::Dynamic),
      displayConstants_("display constants", sizeof(shared::DisplayConstants), gpu::BufferUse::Dynamic) {}

Renderer::~Renderer() = default;

frame::SceneGpu& Renderer::sceneGpu(const frame::FrameSpec& spec) {
    // Light types change from frame to frame and do not concern the scene's buffers.
    frame::FeatureSet features = spec.settings.prune ? frame::materialFeatures(scene_) : frame::allFeatures();
    const frame::TextureFilter filter = spec.settings.filter;
    if (sceneGpu_ && features == sceneFeatures_ && filter == sceneFilter_) {
        if (materialsChanged_) sceneGpu_->updateMaterials();
        materialsChanged_ = false;
        return *sceneGpu_;
    }
    sceneGpu_ = std::make_unique<frame::SceneGpu>(scene_, features, filter);
    materialsChanged_ = false;
    sceneFeatures_ = features;
    sceneFilter_ = filter;
    return *sceneGpu_;
}

void Renderer::draw(Technique technique, const frame::FrameSettings& asked) {
    const frame::FrameSettings settings = settingsOn(context_.capabilities(), asked);
    auto drawn = std::make_unique<Drawn>();
    drawn->prepared = prepareFrame(scene_, technique, settings, bounds_);
    const PreparedFrame& prepared = drawn->prepared;
    sceneGpu(prepared.spec).setView(prepared.view);
    lights_.upload(prepared.lights);
    frameConstants_.uploadValue(prepared.view.constants);
    displayConstants_.uploadValue(displayConstants(settings));

    drawn_ = std::move(drawn);
    drawn_->settings = settings;
    drawn_->resources = std::make_unique<frame::FrameResources>(frame::FrameResources{
        *sceneGpu_, frameConstants_, displayConstants_, lights_, lightLists_, prepared.view.constants,
        prepared.cullLights, prepared.view.constants.background, programs_, backend_.framebuffers()});
    drawn_->frame = declareFrame(technique, prepared.spec, drawn_->resources.get());
    drawn_->compiled = graph::compile(drawn_->frame.graph, {.cull = settings.prune, .alias = settings.prune});
    programs_.warm(drawn_->frame.programs);
    std::vector<graph::ImportedBuffer> imported;
    if (drawn_->frame.lists) imported = lightLists_.imported(*drawn_->frame.lists);
    drawn_->execution = std::make_unique<graph::Execution>(drawn_->frame.graph, drawn_->compiled, backend_,
                                                           std::span<const graph::ImportedTexture>{}, imported);
    drawn_->execution->run();
}

const gpu::Texture& Renderer::radianceTexture() const {
    return drawn_->execution->texture(drawn_->frame.radiance);
}

const gpu::Texture& Renderer::displayTexture() const {
    return drawn_->execution->texture(drawn_->frame.display);
}

RenderedFrame Renderer::download() const {
    return readBack(radianceTexture(), drawn_->settings.display ? &displayTexture() : nullptr);
}

RenderedFrame readBack(const gpu::Texture& radiance, const gpu::Texture* display) {
    RenderedFrame frame;
    frame.width = radiance.desc().width;
    frame.height = radiance.desc().height;
    frame.radiance = flipped(radiance.downloadAs<float>(), frame.width, frame.height);
    if (display != nullptr) frame.display = flipped(display->downloadAs<std::uint8_t>(), frame.width, frame.height);
    return frame;
}

std::vector<float> Renderer::downloadDepth() const {
    return drawn_->execution->texture(drawn_->frame.depth).downloadAs<float>();
}

DrawnLists Renderer::downloadLists() const {
    const PreparedFrame& prepared = drawn_->prepared;
    DrawnLists drawn;
    drawn.culling = prepared.spec.culling;
    drawn.constants = prepared.view.constants;
    drawn.depths = prepared.view.depths;
    drawn.sceneIndex = prepared.lights.sceneIndex;
    for (std::size_t i = 0; i < prepared.lights.texels.size(); ++i) {
        if (prepared.lights.texels[i].position.w == 0.0f) drawn.everywhere.push_back(std::uint32_t(i));
    }
    if (drawn.culling.method != culling::Method::None) drawn.lists = lightLists_.download();
    return drawn;
}

} // namespace tessera::recipes
