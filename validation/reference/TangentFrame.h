#pragma once
#include <optional>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// The slot whose texture the tangents follow that a material needs, empty where it needs none: that of its normal map
/// in tangent space, else of its anisotropy, else of its coat's normal map.
std::optional<scenes::TextureSlot> tangentSlot(const scenes::Material& material);

/// What a slot's texture does to texture coordinates, without the offset. Slots without vectors leave them alone: empty
/// ones, and that of the number in microfacet_anisotropic.
glm::dmat2 textureFromUv(const scenes::Material& material, scenes::TextureSlot slot);

/// The axis in which u grows in a texture, as a unit vector along the tangent and bitangent of the coordinates as they
/// are (x along u, y against v), and on which side of it v shrinks: 1 on the left, -1 on the right.
struct Axis {
    glm::dvec2 alongU{1.0, 0.0};
    double side = 1.0;
};
Axis axisOf(const glm::dmat2& textureFromUv);

/// A vector that a slot's texture holds, along the tangent and the bitangent that follow tangentSlot().
glm::dvec2 alongTangents(const scenes::Material& material, scenes::TextureSlot slot, const glm::dvec2& texel);

} // namespace tessera::reference
