#pragma once
#include <memory>

#include "renderer/gpu/Sampler.h"
#include "renderer/gpu/Texture.h"

namespace tessera::frame {

/// The tables of lobes on the GPU. Each is created on first use, which throws std::runtime_error when memory runs out.
class LobesGpu {
public:
    LobesGpu();
    static graph::TextureDesc tableDesc();
    static graph::TextureDesc shapesDesc();
    const gpu::Texture& table();                           ///< as makeLobeTable()
    const gpu::Texture& shapes();                          ///< as lobeShapes()
    const gpu::Sampler& smooth() const { return smooth_; } ///< bilinear, clamped

private:
    std::unique_ptr<gpu::Texture> table_, shapes_;
    gpu::Sampler smooth_;
};

} // namespace tessera::frame
