#pragma once
#include "scenes/Scene.h"

namespace tessera::viewer {

/// Changes a material's model, and resets values that the new model cannot have: masking-shadowing by direction, unless
/// anisotropic, becomes masking by the angle to the normal.
inline void changeModel(scenes::Material& material, scenes::MaterialModel model) {
    material.model = model;
    if (model == scenes::MaterialModel::Microfacet && material.masking == scenes::Masking::Directional)
        material.masking = scenes::Masking::Walter;
}

} // namespace tessera::viewer
