#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Id.h"
#include "renderer/gpu/Texture.h"

namespace tessera::gpu {

/// The render targets of a pass. A colour without a texture leaves its output location unwritten.
struct Attachments {
    std::vector<graph::Target> colors;
    graph::Target depth = {};
};

class Framebuffer {
public:
    /// Throws std::runtime_error naming the attachments when the driver finds the framebuffer incomplete.
    explicit Framebuffer(const Attachments& attachments);
    ~Framebuffer();
    Framebuffer(Framebuffer&&) noexcept = default;
    Framebuffer& operator=(Framebuffer&&) noexcept = default;

    std::uint32_t id() const { return id_.value(); }
    int width() const { return width_; }   ///< pixels
    int height() const { return height_; } ///< pixels

private:
    Id id_;
    int width_ = 0;
    int height_ = 0;
};

/// A cache of framebuffers, keyed by attachments.
class FramebufferCache {
public:
    /// Creates a framebuffer on first use and keeps it until one of its textures is destroyed. The reference is valid
    /// as long as the textures.
    const Framebuffer& get(const Attachments& attachments);
    const Framebuffer& get(const Texture& color, const Texture* depth = nullptr);
    /// Drops framebuffers of destroyed textures, which keep their memory alive. get() calls it before it creates one.
    void collect();
    std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        std::vector<std::weak_ptr<const std::uint64_t>> textures;
        Framebuffer framebuffer;
    };
    std::map<std::vector<std::uint64_t>, Entry> entries_; ///< by texture serials and parts, depth first; 0: none
};

} // namespace tessera::gpu
