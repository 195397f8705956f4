#include "validation/FloorGeometry.h"

#include "passes/recipes/PreparedFrame.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::validation {

namespace {

frame::FrameSpec specOf(const recipes::Renderer& renderer, frame::FrameSettings settings) {
    settings.culling = {}; // nothing is lit, and Forward takes no lists
    return recipes::prepareFrame(renderer.scene(), recipes::Technique::Forward, settings).spec;
}

} // namespace

shader::ProgramDesc FloorGeometry::program(const frame::FrameSpec& spec) {
    return frame::frameProgram(spec, "constant", "passes/geometry.vert", "passes/constant.frag", {{"DEPTH_ONLY", "1"}});
}

FloorGeometry::FloorGeometry(recipes::Renderer& renderer, const frame::FrameSettings& settings)
    : renderer_(renderer), spec_(specOf(renderer, settings)),
      frameConstants_("floor frame constants", sizeof(shared::FrameConstants), gpu::BufferUse::Dynamic),
      value_("floor value", spec_.texture(graph::Format::Rgba32Float)),
      depth_("floor depth", spec_.texture(graph::Format::Depth32Float)), framebuffer_({{&value_}, &depth_}) {}

void FloorGeometry::draw(const glm::dvec3& eyeOffsetWS) {
    frame::FrameSettings settings = spec_.settings;
    settings.eyeOffsetWS += eyeOffsetWS;
    const frame::CameraView view =
        frame::makeCameraView(recipes::frameCamera(renderer_.scene(), settings), settings.sizePixels, settings.space,
                              glm::vec3(0.0f), renderer_.bounds());
    frame::SceneGpu& scene = renderer_.sceneGpu(spec_);
    scene.setView(view);
    frameConstants_.uploadValue(view.constants);

    gpu::bindFramebuffer(framebuffer_);
    gpu::clearColor(0, glm::vec4(0.0f));
    gpu::clearDepth(0.0f);
    gpu::useProgram(renderer_.programs().get(program(spec_)));
    gpu::bindUniformBuffer(UNIFORM_FRAME, frameConstants_);
    gpu::PipelineState state;
    state.depthTest = gpu::DepthTest::GreaterEqual;
    state.depthWrite = true;
    scene.draw(scene.opaque(), state);
    state.depthWrite = false;
    scene.draw(scene.transparent(), state);
}

} // namespace tessera::validation
