#pragma once
#include <memory>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// The amplified difference of two images: |a - b| of exposed radiance, times a factor, encoded for display.
class Difference {
public:
    /// Pixels with NaN or infinite values are magenta. The images must have the same size.
    void update(shader::ProgramLibrary& programs, const Target& radianceA, const Target& radianceB, float factor);
    const Target* image() const { return image_.get(); }

private:
    std::unique_ptr<Target> image_;
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
