#include "viewer/show/SceneThumbnails.h"

#include <filesystem>
#include <span>

#include "sceneThumbnails.gen.h"
#include "scenes/import/Importers.h"

namespace tessera::viewer {

const std::map<std::string, std::uint32_t, std::less<>>& SceneThumbnails::textures() {
    if (!made_.empty()) return textures_;
    scenes::LoadLedger ledger;
    for (const EmbeddedFile& file : sceneThumbnails()) {
        const std::string path(file.path);
        const scenes::Image image =
            scenes::decodeImage(std::as_bytes(std::span(file.text.data(), file.text.size())), path, ledger);
        const graph::TextureDesc desc{graph::Format::Rgba8Unorm, image.width, image.height};
        const gpu::Texture& texture = made_.emplace_back("thumbnail " + path, desc);
        texture.upload(0, image.texels);
        textures_[std::filesystem::path(path).stem().string()] = texture.id();
    }
    return textures_;
}

} // namespace tessera::viewer
