#pragma once
#include <memory>
#include <string>

#include "renderer/frame/PackedLights.h"
#include "renderer/gpu/Buffer.h"

namespace tessera::frame {

/// Bytes that `count` lights of these kinds take.
std::size_t lightBytes(const FeatureSet& features, std::size_t count);
/// Such as "1 light" or "257 lights".
std::string lightsText(std::size_t count);

/// Lights on the GPU, as shaders/lib/light/light.glsl reads them, for lighting without a render graph.
class LightBuffers {
public:
    explicit LightBuffers(const PackedLights& lights);
    void bind() const;

private:
    gpu::Buffer lights_, shapes_;
};

} // namespace tessera::frame
