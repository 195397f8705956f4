#pragma once
#include "scenes/Scene.h"
#include "shaders/shared/material.h"

namespace tessera::frame {

/// A material as the shaders read it.
shared::MaterialConstants packMaterial(const scenes::Material& material);

/// KHR_texture_transform without its offset: rotation x scale.
glm::dmat2 linearPart(const scenes::TextureTransform& transform);

} // namespace tessera::frame
