#pragma once
#include <memory>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// Redraws the heat colours of an image of counts with a scale that ends at its largest count, which its display pass
/// does not know.
class CountColors {
public:
    /// Redraws the display image with a scale that ends at 2^log2Most - 1. Throws gpu::ShaderError.
    void update(shader::ProgramLibrary& programs, const Target& radiance, const Target& display, float log2Most);

private:
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
