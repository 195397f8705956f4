#pragma once
#include "scenes/Scene.h"
#include "shaders/shared/material.h"

namespace tessera::frame {

/// A material as the shaders read it.
shared::MaterialConstants packMaterial(const scenes::Material& material);

/// KHR_texture_transform without its offset: rotation x scale.
glm::dmat2 linearPart(const scenes::TextureTransform& transform);

/// True where the slot's texels are sRGB-encoded colours.
bool slotIsSrgb(scenes::TextureSlot slot);

} // namespace tessera::frame
