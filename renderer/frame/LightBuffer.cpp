#include "renderer/frame/LightBuffer.h"

#include <fmt/format.h>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

std::size_t lightBytes(const FeatureSet& features, std::size_t count) {
    return count * (sizeof(shared::LightTexels) + (features.lightShapes() ? sizeof(shared::LightShapeTexels) : 0) +
                    (features.lightShadowTexels() ? sizeof(shared::LightShadowTexels) : 0));
}

std::string lightsText(std::size_t count) {
    return fmt::format("{} light{}", count, count == 1 ? "" : "s");
}

std::string transparentText(std::size_t surfaces) {
    return fmt::format("{} transparent {} none", surfaces, surfaces == 1 ? "surface casts" : "surfaces cast");
}

std::vector<glm::vec4> texelsOf(const PackedLights& lights, const FeatureSet& features) {
    std::vector<glm::vec4> texels;
    texels.reserve(lightBytes(features, lights.texels.size()) / sizeof(glm::vec4));
    for (std::size_t i = 0; i < lights.texels.size(); ++i) {
        texels.insert(texels.end(), {lights.texels[i].position, lights.texels[i].color});
        if (features.lightShapes()) texels.insert(texels.end(), {lights.shapes[i].axis, lights.shapes[i].attenuation});
        if (features.lightShadowTexels()) texels.push_back(lights.shadows[i].shadow);
    }
    return texels;
}

LightBuffer::LightBuffer(const PackedLights& lights, const FeatureSet& features)
    : texels_(gpu::Buffer::of("lights", texelsOf(lights, features))) {}

void LightBuffer::bind() const {
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, texels_.texels(graph::Format::Rgba32Float));
}

} // namespace tessera::frame
