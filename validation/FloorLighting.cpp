#include "validation/FloorLighting.h"

#include <cassert>

#include "renderer/frame/CameraView.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::validation {

namespace {

constexpr LightStoreInfo kStores[] = {
    {LIGHT_STORE_UNIFORM, "uniform buffer", "LIGHT_STORE_UNIFORM"},
    {LIGHT_STORE_TEXEL, "texel buffer", "LIGHT_STORE_TEXEL"},
    {LIGHT_STORE_STORAGE, "storage buffer", "LIGHT_STORE_STORAGE"},
};

} // namespace

std::span<const LightStoreInfo> lightStoreTable() {
    return kStores;
}

shader::ProgramDesc FloorLighting::program(const frame::FrameSpec& spec, const LightStoreInfo& store) {
    return frame::frameProgram(spec, "floor_lighting", "passes/fullscreen.vert", "passes/floor_lighting.frag",
                               {{"LIGHT_CURSOR", "LIGHT_CURSOR_ALL"}, {"LIGHT_STORE", std::string(store.define)}});
}

FloorLighting::FloorLighting(shader::ProgramLibrary& programs, const frame::FrameSpec& spec)
    : programs_(programs), spec_(spec), constants_(frame::makeCameraView(scenes::Camera{}, spec.settings.sizePixels,
                                                                         frame::LightingSpace::World, glm::vec3(0.0f))
                                                       .constants),
      frameConstants_("floor frame constants", sizeof(shared::FrameConstants), gpu::BufferUse::Dynamic),
      lights_("floor lights", LIGHT_UNIFORM_LIGHTS * sizeof(shared::LightTexels), gpu::BufferUse::Dynamic),
      lightTexels_("floor lights", graph::Format::Rgba32Float, lights_),
      radiance_("floor radiance", spec.texture(graph::Format::Rgba32Float)), framebuffer_({{&radiance_}, nullptr}) {
    assert(spec.features.litModels());
    setLights({});
}

void FloorLighting::setLights(std::span<const shared::LightTexels> lights) {
    assert(lights.size() <= LIGHT_UNIFORM_LIGHTS);
    constants_.lights = glm::uvec4(unsigned(lights.size()), 0u, 0u, 0u);
    frameConstants_.uploadValue(constants_);
    lights_.upload(lights);
}

void FloorLighting::draw(const LightStoreInfo& store) const {
    gpu::bindFramebuffer(framebuffer_);
    gpu::setState({});
    gpu::useProgram(programs_.get(program(spec_, store)));
    gpu::bindUniformBuffer(UNIFORM_FRAME, frameConstants_);
    switch (store.store) {
    case LIGHT_STORE_UNIFORM:
        gpu::bindUniformBuffer(UNIFORM_LIGHTS, lights_);
        break;
    case LIGHT_STORE_STORAGE:
        gpu::bindStorageBuffer(STORAGE_LIGHTS, lights_);
        break;
    default:
        gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, lightTexels_);
    }
    gpu::drawFullscreenTriangle();
}

} // namespace tessera::validation
