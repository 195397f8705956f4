#pragma once
#include <span>

#include "scenes/Scene.h"
#include "validation/stress/StressRandom.h"

namespace tessera::validation {

/// A lit material model as the stability suite exercises it. The table is the suite's only list of models: a new one
/// joins every case by a row.
struct StressModel {
    scenes::MaterialModel model;
    /// Sets every parameter of the model at random over its whole range; the material has the model already.
    void (*randomise)(scenes::Material& material, StressRandom& random);
    /// Sets the roughness, 0 (smoothest) to 1; null where the model has none.
    void (*setRoughness)(scenes::Material& material, double roughness);
    /// The smallest GGX alpha that the material has, after the product's clamp; 1 where the model has no lobe. Rounding
    /// of a direction moves a lobe by 1/alpha of its width.
    double (*sharpness)(const scenes::Material& material);
};
std::span<const StressModel> stressModels();

} // namespace tessera::validation
