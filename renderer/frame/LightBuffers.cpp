#include "renderer/frame/LightBuffers.h"

#include <fmt/format.h>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

std::size_t lightBytes(const FeatureSet& features, std::size_t count) {
    return count * (sizeof(shared::LightTexels) + (features.lightShapes() ? sizeof(shared::LightShapeTexels) : 0));
}

std::string lightsText(std::size_t count) {
    return fmt::format("{} light{}", count, count == 1 ? "" : "s");
}

LightBuffers::LightBuffers(const PackedLights& lights)
    : lights_(gpu::Buffer::of("lights", lights.texels)), shapes_(gpu::Buffer::of("light shapes", lights.shapes)) {}

void LightBuffers::bind() const {
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, lights_.texels(graph::Format::Rgba32Float));
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_SHAPES, shapes_.texels(graph::Format::Rgba32Float));
}

} // namespace tessera::frame
