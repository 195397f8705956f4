#pragma once
#include <memory>

#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// How much two pictures differ, amplified: |a - b| of exposed radiance, times a factor, as a display shows it.
class Difference {
public:
    /// Where one of the values is no number the pixel is magenta. The pictures must be of one size.
    void update(shader::ProgramLibrary& programs, const Target& radianceA, const Target& radianceB, float factor);
    const Target* image() const { return image_.get(); }

private:
    std::unique_ptr<Target> image_;
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
