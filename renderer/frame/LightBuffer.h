#pragma once
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/PackedLights.h"
#include "renderer/gpu/Buffer.h"

namespace tessera::frame {

/// Bytes that `count` lights of these kinds take.
std::size_t lightBytes(const FeatureSet& features, std::size_t count);
/// Such as "1 light" or "257 lights".
std::string lightsText(std::size_t count);

/// Such as "2 transparent surfaces cast none", of shadows.
std::string transparentText(std::size_t surfaces);

/// What the buffer texture of shaders/lib/light/light_store.glsl holds, where shaders have those features.
std::vector<glm::vec4> texelsOf(const PackedLights& lights, const FeatureSet& features);

/// Of them only what types with a shape need besides, of every light: LightShapeTexels, and where the features have
/// polygons LightCornerTexels.
std::vector<glm::vec4> shapeTexelsOf(const PackedLights& lights, const FeatureSet& features);

/// The same as texelsOf() on the GPU, for lighting without a render graph.
class LightBuffer {
public:
    LightBuffer(const PackedLights& lights, const FeatureSet& features);
    void bind() const;

private:
    gpu::Buffer texels_;
};

} // namespace tessera::frame
