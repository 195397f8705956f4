#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/gpu/Texture.h"

namespace tessera::viewer {

/// The small pictures of the built-in scenes, which the program carries (viewer/thumbnails, drawn by
/// tools/docs_pictures.py), on the GPU.
class SceneThumbnails {
public:
    /// GL's names by scene; made at the first call. Throws as gpu::Texture does.
    const std::map<std::string, std::uint32_t, std::less<>>& textures();

private:
    std::vector<gpu::Texture> made_;
    std::map<std::string, std::uint32_t, std::less<>> textures_;
};

} // namespace tessera::viewer
