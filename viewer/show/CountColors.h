#pragma once
#include <memory>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// The heat colours of a picture of counts, made again from what it counts: its display pass does not know the largest
/// count, which ends the scale.
class CountColors {
public:
    /// Draws the display picture anew, by a scale that ends at 2^log2Most - 1. Throws gpu::ShaderError.
    void update(shader::ProgramLibrary& programs, const Target& radiance, const Target& display, float log2Most);

private:
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
