#pragma once
#include "renderer/frame/GrowingTexelBuffer.h"
#include "renderer/frame/PackedLights.h"

namespace tessera::frame {

/// Bytes that `count` lights of these kinds take.
std::size_t lightBytes(const FeatureSet& features, std::size_t count);

/// The frame's lights on the GPU, as shaders/lib/light.glsl reads them.
class LightBuffers {
public:
    /// Shapes are uploaded only where a light has one.
    void upload(const PackedLights& lights);
    void bind() const;

private:
    GrowingTexelBuffer lights_{"lights", graph::Format::Rgba32Float};
    GrowingTexelBuffer shapes_{"light shapes", graph::Format::Rgba32Float};
};

} // namespace tessera::frame
