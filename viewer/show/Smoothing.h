#pragma once
#include <array>
#include <memory>

#include "renderer/frame/FrameSettings.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// Antialiasing by accumulation: the mean of images shifted by sub-pixel offsets, in linear radiance. Edges get their
/// coverage of each pixel as with that many samples, for every technique.
class Smoothing {
public:
    static constexpr int kPictures = 32;
    /// Offset of one of them, at most half a pixel either way; evenly distributed, even the first few.
    static glm::vec2 offsetPixels(int number);

    void restart();
    /// Adds the next image: RGBA32F, of the same size as the previous ones. Throws gpu::ShaderError.
    void add(shader::ProgramLibrary& programs, const gpu::Texture& radiance);
    int count() const { return count_; } ///< of added images
    bool isDone() const { return count_ == kPictures; }
    /// The sum of all added images; null if there are none.
    const Target* sum() const { return count_ > 0 ? sums_[std::size_t(count_ % 2)].get() : nullptr; }
    /// Computes the mean image, encoded for display as the lit image is. Throws gpu::ShaderError.
    void showMean(shader::ProgramLibrary& programs, const frame::FrameSettings& settings);
    /// The latest mean image; null if there is none since restart().
    const Target* shown() const { return isShown_ ? display_.get() : nullptr; }

private:
    int count_ = 0;
    bool isShown_ = false;
    std::array<std::unique_ptr<Target>, 2> sums_; ///< the latest, and the previous one
    std::unique_ptr<Target> display_;
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
