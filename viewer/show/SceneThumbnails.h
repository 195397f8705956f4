#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/gpu/Texture.h"

namespace tessera::viewer {

/// Thumbnails of the built-in scenes as GPU textures. The program embeds their images (viewer/thumbnails, drawn by
/// tools/docs_pictures.py).
class SceneThumbnails {
public:
    /// GL texture names by scene, created at the first call. Throws as gpu::Texture does.
    const std::map<std::string, std::uint32_t, std::less<>>& textures();

private:
    std::vector<gpu::Texture> made_;
    std::map<std::string, std::uint32_t, std::less<>> textures_;
};

} // namespace tessera::viewer
