#include "validation/reference/Slots.h"

#include "validation/reference/Texels.h"

namespace tessera::reference {

glm::dvec4 texelOf(scenes::TextureSlot slot, const Hit& hit, const std::vector<scenes::Image>& images) {
    const scenes::TextureUse& use = hit.object->material->texture(slot);
    if (use.image == scenes::kNone) return glm::dvec4(1.0);
    const std::vector<glm::vec2>& texCoords = hit.object->mesh->texCoords[std::size_t(use.texCoordSet)];
    const glm::dvec2 uv = texCoords.empty() ? glm::dvec2(0.0) : hit.at<glm::dvec2>(texCoords);
    return sampleBilinear(images[std::size_t(use.image)], transferOf(slot), use.sampler,
                          transformed(use.transform, uv));
}

} // namespace tessera::reference
