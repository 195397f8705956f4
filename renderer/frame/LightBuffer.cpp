#include "renderer/frame/LightBuffer.h"

#include <iterator>

#include <fmt/format.h>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

namespace {

void addShape(std::vector<glm::vec4>& texels, const PackedLights& lights, const FeatureSet& features, std::size_t i) {
    texels.insert(texels.end(), {lights.shapes[i].axis, lights.shapes[i].attenuation});
    if (!features[scenes::LightType::Polygon]) return;
    const shared::LightCornerTexels corners = lights.corners.empty() ? shared::LightCornerTexels{} : lights.corners[i];
    texels.push_back(corners.outline);
    texels.insert(texels.end(), std::begin(corners.corners), std::end(corners.corners));
    texels.insert(texels.end(), {corners.shareEnds, corners.lastEnd});
}

} // namespace

std::size_t lightBytes(const FeatureSet& features, std::size_t count) {
    return count * (sizeof(shared::LightTexels) + (features.lightShapes() ? sizeof(shared::LightShapeTexels) : 0) +
                    (features[scenes::LightType::Polygon] ? sizeof(shared::LightCornerTexels) : 0) +
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
        if (features.lightShapes()) addShape(texels, lights, features, i);
        if (features.lightShadowTexels()) texels.push_back(lights.shadows[i].shadow);
    }
    return texels;
}

std::vector<glm::vec4> shapeTexelsOf(const PackedLights& lights, const FeatureSet& features) {
    std::vector<glm::vec4> texels;
    for (std::size_t i = 0; i < lights.shapes.size(); ++i) addShape(texels, lights, features, i);
    return texels;
}

LightBuffer::LightBuffer(const PackedLights& lights, const FeatureSet& features)
    : texels_(gpu::Buffer::of("lights", texelsOf(lights, features))) {}

void LightBuffer::bind() const {
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHTS, texels_.texels(graph::Format::Rgba32Float));
}

} // namespace tessera::frame
