#include "renderer/frame/LightBuffers.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

namespace {

bool hasShapes(const FeatureSet& features) {
    return features[Feature::SpotLights] || features[Feature::AttenuationLights];
}

} // namespace

std::size_t lightBytes(const FeatureSet& features, std::size_t count) {
    return count * (sizeof(shared::LightTexels) + (hasShapes(features) ? sizeof(shared::LightShapeTexels) : 0));
}

void LightBuffers::upload(const PackedLights& lights) {
    lights_.require(lights.texels.size() * LIGHT_TEXELS);
    lights_.buffer().upload(lights.texels);
    if (!hasShapes(lights.features)) return;
    shapes_.require(lights.shapes.size() * LIGHT_SHAPE_TEXELS);
    shapes_.buffer().upload(lights.shapes);
}

void LightBuffers::bind() const {
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, lights_.texels());
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_SHAPES, shapes_.texels());
}

} // namespace tessera::frame
