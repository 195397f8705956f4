#include "validation/lower_bound/LowerBoundLighting.h"

#include <cassert>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/slots.h"

namespace tessera::validation {

namespace {

constexpr LightStoreInfo kStores[] = {
    {LIGHT_STORE_TEXEL, "texel buffer", "LIGHT_STORE_TEXEL"},
    {LIGHT_STORE_STORAGE, "storage buffer", "LIGHT_STORE_STORAGE"},
    {LIGHT_STORE_UNIFORM, "uniform buffer", "LIGHT_STORE_UNIFORM"},
};

/// Size of the uniform block of light shapes with polygon corners; the block of LightTexels is smaller.
constexpr std::size_t kMostShapeBytes =
    LIGHT_UNIFORM_LIGHTS * (sizeof(shared::LightShapeTexels) + sizeof(shared::LightCornerTexels));
static_assert(sizeof(shared::LightTexels) <= sizeof(shared::LightShapeTexels) + sizeof(shared::LightCornerTexels));

} // namespace

std::span<const LightStoreInfo> lightStoreTable() {
    return kStores;
}

std::span<const LightStoreInfo> lightStores(const gpu::Capabilities& gl) {
    static_assert(std::rbegin(kStores)->store == LIGHT_STORE_UNIFORM);
    const bool readsUniforms = gl.indexesUniformBlocks && gl.maxUniformBlockBytes >= kMostShapeBytes;
    return std::span(kStores).first(std::size(kStores) - (readsUniforms ? 0 : 1));
}

namespace {

/// The bound prices unshadowed pairs of light and pixel. Unpruned frames have all shadow features.
frame::FrameSpec withoutShadows(frame::FrameSpec spec) {
    for (const frame::Feature feature :
         {frame::Feature::Shadows, frame::Feature::SoftShadows, frame::Feature::ShadowMaps, frame::Feature::ShadowLift})
        spec.features.has.reset(std::size_t(feature));
    return spec;
}

} // namespace

shader::ProgramDesc LowerBoundLighting::program(const frame::FrameSpec& spec, const LightStoreInfo& store) {
    return frame::frameProgram(withoutShadows(spec), "bound_lighting", "passes/fullscreen.vert",
                               "bench/bound_lighting.frag",
                               {{"LIGHT_CURSOR", "LIGHT_CURSOR_ALL"}, {"LIGHT_STORE", std::string(store.define)}});
}

LowerBoundLighting::LowerBoundLighting(shader::ProgramLibrary& programs, const frame::FrameSpec& spec)
    : programs_(programs), spec_(withoutShadows(spec)), view_("lower bound view", sizeof(shared::ViewConstants)),
      constants_("lower bound lighting", sizeof(shared::LightingConstants), gpu::BufferUse::Dynamic),
      environment_("lower bound environment", sizeof(shared::EnvironmentConstants)),
      lights_("lower bound lights", LIGHT_UNIFORM_LIGHTS * sizeof(shared::LightTexels), gpu::BufferUse::Dynamic),
      shapes_("lower bound light shapes", kMostShapeBytes, gpu::BufferUse::Dynamic),
      texels_("lower bound light texels", frame::lightBytes(spec_.features, LIGHT_UNIFORM_LIGHTS),
              gpu::BufferUse::Dynamic),
      radiance_("lower bound radiance", spec.texture(graph::Format::Rgba32Float)),
      framebuffer_({{&radiance_}, nullptr}) {
    assert(spec.features.litModels());
    view_.uploadValue(
        frame::makeCameraView(scenes::Camera{}, spec.settings.sizePixels, frame::LightingSpace::World, glm::vec3(0.0f))
            .constants);
    // Shaders read this block in frames with an environment and in unpruned ones. It has no radiance, and a rotation
    // since a matrix of zeros would make directions NaN.
    environment_.uploadValue(shared::EnvironmentConstants{glm::mat4(1.0f), glm::vec4(0.0f)});
    setLights({});
}

void LowerBoundLighting::setLights(const frame::PackedLights& lights) {
    assert(lights.texels.size() <= LIGHT_UNIFORM_LIGHTS && lights.shapes.size() == lights.texels.size());
    shared::LightingConstants constants{};
    constants.lights.x = unsigned(lights.texels.size());
    constants_.uploadValue(constants);
    lights_.upload(lights.texels);
    shapes_.upload(frame::shapeTexelsOf(lights, spec_.features));
    texels_.upload(frame::texelsOf(lights, spec_.features));
}

void LowerBoundLighting::bindConstants() const {
    gpu::bindUniformBuffer(UNIFORM_VIEW, view_);
    gpu::bindUniformBuffer(UNIFORM_LIGHTING, constants_);
    gpu::bindUniformBuffer(UNIFORM_ENVIRONMENT, environment_);
}

void LowerBoundLighting::bindLights(const LightStoreInfo& store) const {
    switch (store.store) {
    case LIGHT_STORE_UNIFORM:
        gpu::bindUniformBuffer(UNIFORM_LIGHTS, lights_);
        gpu::bindUniformBuffer(UNIFORM_LIGHT_SHAPES, shapes_);
        break;
    case LIGHT_STORE_STORAGE:
        gpu::bindStorageBuffer(STORAGE_LIGHTS, lights_);
        gpu::bindStorageBuffer(STORAGE_LIGHT_SHAPES, shapes_);
        break;
    default:
        gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, texels_.texels(graph::Format::Rgba32Float));
    }
}

void LowerBoundLighting::draw(const LightStoreInfo& store) const {
    gpu::bindFramebuffer(framebuffer_);
    gpu::setState({});
    gpu::useProgram(programs_.get(program(spec_, store)));
    bindConstants();
    bindLights(store);
    gpu::drawFullscreenTriangle();
}

} // namespace tessera::validation
