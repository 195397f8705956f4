#pragma once
#include "renderer/frame/Features.h"
#include "renderer/shader/Preprocess.h"

namespace tessera::frame {

using shader::Defines;

/// The defines of shaders: HAS_* of every feature as 0 or 1, and of groups of features (litModels(), glossyModels() and
/// so on); the number MODEL_<NAME> of each model, and MODEL_COUNT; SOLE_MODEL if the scene has one model only.
/// LIT_MODELS lists the numbers of the scene's lit models, and macros classify a model: IS_UNLIT(model),
/// IS_GLOSSY(model) and so on.
Defines featureDefines(const FeatureSet& features);

} // namespace tessera::frame
