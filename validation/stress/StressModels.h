#pragma once
#include <span>

#include "scenes/Scene.h"
#include "validation/stress/StressRandom.h"

namespace tessera::validation {

/// A lit material model for the stability suite. The table is the suite's only list of models: a new row adds its model
/// to every case.
struct StressModel {
    scenes::MaterialModel model;
    /// Sets every parameter of the model at random over its whole range; the material has the model already.
    void (*randomise)(scenes::Material& material, StressRandom& random);
    /// Sets the roughness, 0 (smoothest) to 1; null where the model has none.
    void (*setRoughness)(scenes::Material& material, double roughness);
    /// The smallest GGX alpha of the material, after the product's clamp; 1 for models without a lobe. Rounding of a
    /// direction shifts a lobe, relative to its width, by 1/alpha of the rounding error.
    double (*sharpness)(const scenes::Material& material);
};
std::span<const StressModel> stressModels();

} // namespace tessera::validation
