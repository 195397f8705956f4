#include "validation/lower_bound/LowerBoundGeometry.h"

#include "engine/PrepareView.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::validation {

namespace {

frame::FrameSpec specOf(const engine::Renderer& renderer, frame::FrameSettings settings) {
    settings.culling = {}; // nothing is lit, and Forward reads no lists
    return engine::prepareView(renderer.scene(), engine::Technique::Forward, settings).spec;
}

/// Uploads values; recreates the buffer only where they do not fit.
template <typename Value>
void fill(std::optional<gpu::Buffer>& buffer, const char* label, const std::vector<Value>& values) {
    const std::size_t bytes = values.size() * sizeof(Value);
    if (!buffer || buffer->bytes() < bytes) buffer.emplace(label, bytes, gpu::BufferUse::Dynamic);
    buffer->upload(values);
}

} // namespace

shader::ProgramDesc LowerBoundGeometry::program(const frame::FrameSpec& spec) {
    return frame::frameProgram(spec, "constant", "passes/geometry.vert", "bench/constant.frag", {{"DEPTH_ONLY", "1"}});
}

LowerBoundGeometry::LowerBoundGeometry(engine::Renderer& renderer, const frame::FrameSettings& settings)
    : renderer_(renderer), spec_(specOf(renderer, settings)),
      constants_("lower bound view", sizeof(shared::ViewConstants), gpu::BufferUse::Dynamic),
      value_("lower bound value", spec_.texture(graph::Format::Rgba32Float)),
      depth_("lower bound depth", spec_.texture(graph::Format::Depth32Float)), framebuffer_({{&value_}, &depth_}) {}

void LowerBoundGeometry::draw(const glm::dvec3& eyeOffsetWS) {
    frame::FrameSettings settings = spec_.settings;
    settings.eyeOffsetWS += eyeOffsetWS;
    const frame::CameraView view =
        frame::makeCameraView(engine::frameCamera(renderer_.scene(), settings), settings.sizePixels, settings.space,
                              glm::vec3(0.0f), renderer_.bounds());
    const frame::SceneGpu& scene = renderer_.sceneGpu(spec_);
    const frame::ViewDraws draws = frame::makeViewDraws(scene.drawList(), view, spec_.settings.prune);
    fill(rows_, "lower bound draw rows", draws.rows);
    fill(commands_, "lower bound draw commands", scene.commandsOf(draws));
    constants_.uploadValue(view.constants);

    gpu::bindFramebuffer(framebuffer_);
    gpu::clearColor(0, glm::vec4(0.0f));
    gpu::clearDepth(0.0f);
    gpu::useProgram(renderer_.programs().get(program(spec_)));
    gpu::bindUniformBuffer(UNIFORM_VIEW, constants_);
    gpu::PipelineState state;
    state.depthTest = gpu::DepthTest::GreaterEqual;
    state.depthWrite = true;
    scene.draw({*rows_, *commands_}, draws.opaque, state);
    state.depthWrite = false;
    scene.draw({*rows_, *commands_}, draws.transparent, state);
}

} // namespace tessera::validation
