#pragma once
#include <vector>

#include "scenes/Scene.h"
#include "shaders/shared/material.h"
#include "shaders/shared/subsurface.h"

namespace tessera::frame {

/// A material as the shaders read it; `subsurfaceRow` is that of its SubsurfaceConstants.
shared::MaterialConstants packMaterial(const scenes::Material& material, std::size_t subsurfaceRow = 0);

/// Subsurface constants that lighting reads.
struct PackedSubsurfaces {
    std::vector<shared::SubsurfaceConstants> rows; ///< the first is for surfaces without subsurface scattering
    std::vector<std::size_t> rowOf;                ///< by material
    std::vector<std::size_t> passed;               ///< row of materials that transmit light, else 0
};
PackedSubsurfaces packSubsurfaces(const scenes::Scene& scene, scenes::SubsurfaceRequest request);

/// KHR_texture_transform without its offset: rotation x scale.
glm::dmat2 linearPart(const scenes::TextureTransform& transform);

} // namespace tessera::frame
