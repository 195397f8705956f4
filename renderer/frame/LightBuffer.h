#pragma once
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/PackedLights.h"
#include "renderer/gpu/Buffer.h"

namespace tessera::frame {

/// Bytes of `count` lights with these features.
std::size_t lightBytes(const FeatureSet& features, std::size_t count);
/// Text such as "1 light" or "257 lights".
std::string lightsText(std::size_t count);

/// Text on shadows such as "2 transparent surfaces cast none".
std::string transparentText(std::size_t surfaces);

/// The buffer texture of shaders/lib/light/light_store.glsl, for shaders with these features.
std::vector<glm::vec4> texelsOf(const PackedLights& lights, const FeatureSet& features);

/// Only the shape part of texelsOf(), for every light: LightShapeTexels and, if the features include polygons,
/// LightCornerTexels.
std::vector<glm::vec4> shapeTexelsOf(const PackedLights& lights, const FeatureSet& features);

/// texelsOf() on the GPU, for lighting without a render graph.
class LightBuffer {
public:
    LightBuffer(const PackedLights& lights, const FeatureSet& features);
    void bind() const;

private:
    gpu::Buffer texels_;
};

} // namespace tessera::frame
