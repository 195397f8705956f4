#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "engine/Renderer.h"
#include "renderer/gpu/Framebuffer.h"
#include "viewer/session/Look.h"
#include "viewer/show/PictureLights.h"

namespace tessera::viewer {

/// A texture with a framebuffer, to copy into and from.
class Target {
public:
    Target(const char* label, graph::Format format, glm::ivec2 sizePixels);
    const gpu::Texture& texture() const { return texture_; }
    const gpu::Framebuffer& framebuffer() const { return framebuffer_; }
    glm::ivec2 sizePixels() const { return {framebuffer_.width(), framebuffer_.height()}; }
    void copyFrom(const gpu::Texture& source);

private:
    gpu::Texture texture_;
    gpu::Framebuffer framebuffer_;
};

/// The latest complete image of one side of the window. It stays unchanged while the next one is drawn, or fails.
class DrawnPicture {
public:
    /// What is kept of an image besides its display colours.
    struct Kept {
        bool radiance = false;
        bool lights = false; ///< if its view has them; waits for the GPU
    };
    /// Copies the renderer's latest image.
    void take(const engine::Renderer& renderer, const Look& look, Kept kept);
    void clear();

    bool isThere() const { return display_ != nullptr; }
    const Look& look() const { return look_; } ///< with the size it was drawn at
    const Target& display() const { return *display_; }
    const Target* radiance() const { return hasRadiance_ ? radiance_.get() : nullptr; }
    /// Null if they were not kept.
    const PictureLights* lights() const { return lights_ ? &*lights_ : nullptr; }
    /// For views of counts: end of the display image's colour scale, as a power of two.
    float countScaleLog2() const { return countScaleLog2_; }
    void setCountScale(float log2Most) { countScaleLog2_ = log2Most; }

private:
    Look look_;
    std::unique_ptr<Target> display_, radiance_;
    bool hasRadiance_ = false; ///< of the displayed image
    std::optional<PictureLights> lights_;
    float countScaleLog2_ = 0.0f;
};

} // namespace tessera::viewer
