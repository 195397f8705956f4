#pragma once
#include <optional>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// The slot whose texture a material's tangents follow: its normal map in tangent space, else its anisotropy, else its
/// coat's normal map. Empty if the material needs no tangents.
std::optional<scenes::TextureSlot> tangentSlot(const scenes::Material& material);

/// A slot's transform of texture coordinates, without the offset. Identity for slots without vectors: empty ones, and
/// that of the number in microfacet_anisotropic.
glm::dmat2 textureFromUv(const scenes::Material& material, scenes::TextureSlot slot);

/// The u axis of a texture, as a unit vector along the tangent and bitangent of the untransformed coordinates (x along
/// u, y against v), and on which side of it v shrinks: 1 on the left, -1 on the right.
struct Axis {
    glm::dvec2 alongU{1.0, 0.0};
    double side = 1.0;
};
Axis axisOf(const glm::dmat2& textureFromUv);

/// A vector of a slot's texture, along the tangent and the bitangent that follow tangentSlot().
glm::dvec2 alongTangents(const scenes::Material& material, scenes::TextureSlot slot, const glm::dvec2& texel);

} // namespace tessera::reference
