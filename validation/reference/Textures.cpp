#include "validation/reference/Textures.h"

#include "scenes/InUse.h"

namespace tessera::reference {

Textures::Textures(const scenes::Scene& scene, Filtering filtering)
    : filtering_(filtering), pyramids_(2 * scene.images.size()) {
    for (const scenes::Material* material : scenes::materialsInUse(scene)) {
        for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
            const int image = material->textures[slot].image;
            if (image == scenes::kNone) continue;
            const Transfer transfer = transferOf(scenes::TextureSlot(slot));
            std::optional<Pyramid>& pyramid = pyramids_[2 * std::size_t(image) + std::size_t(transfer)];
            if (!pyramid) pyramid.emplace(scene.images[std::size_t(image)], transfer, filtering == Filtering::Hardware);
        }
    }
}

} // namespace tessera::reference
