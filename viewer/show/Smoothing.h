#pragma once
#include <array>
#include <memory>

#include "renderer/frame/FrameSettings.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/show/DrawnPicture.h"

namespace tessera::viewer {

/// The mean of pictures that are shifted by parts of a pixel, in linear radiance: the edges of what is drawn get the
/// share of each pixel that they cover, as if it had so many samples, whatever the technique.
class Smoothing {
public:
    static constexpr int kPictures = 32;
    /// By how much one of them is shifted, at most half a pixel either way; they spread evenly, the first few too.
    static glm::vec2 offsetPixels(int number);

    void restart();
    /// Adds the next picture: RGBA32F, of the size of those before. Throws gpu::ShaderError.
    void add(shader::ProgramLibrary& programs, const gpu::Texture& radiance);
    int count() const { return count_; } ///< of pictures that were added
    bool isDone() const { return count_ == kPictures; }
    /// The sum of all that were added; null: none was.
    const Target* sum() const { return count_ > 0 ? sums_[std::size_t(count_ % 2)].get() : nullptr; }
    /// Makes the picture of their mean as a display shows the lit picture. Throws gpu::ShaderError.
    void showMean(shader::ProgramLibrary& programs, const frame::FrameSettings& settings);
    /// The one that was made last; null: none since restart().
    const Target* shown() const { return isShown_ ? display_.get() : nullptr; }

private:
    int count_ = 0;
    bool isShown_ = false;
    std::array<std::unique_ptr<Target>, 2> sums_; ///< the latest, and the one before
    std::unique_ptr<Target> display_;
    std::unique_ptr<gpu::Buffer> constants_;
};

} // namespace tessera::viewer
