#pragma once
#include "scenes/Scene.h"

namespace tessera::viewer {

/// Changes a material's model. A masking-shadowing option that the new model lacks becomes masking by the angle to the
/// normal.
inline void changeModel(scenes::Material& material, scenes::MaterialModel model) {
    material.model = model;
    if (!scenes::supportsMasking(model, material.masking)) material.masking = scenes::Masking::Walter;
}

} // namespace tessera::viewer
