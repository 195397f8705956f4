#pragma once
#include "renderer/frame/Features.h"
#include "renderer/shader/Preprocess.h"

namespace tessera::frame {

using shader::Defines;

/// Shader defines: HAS_* as 0 or 1 for every feature and for groups of features (litModels(), glossyModels() and so
/// on); MODEL_<NAME>, the number of each model, and MODEL_COUNT; SOLE_MODEL if the scene has only one model. LIT_MODELS
/// lists the numbers of the scene's lit models, and macros classify a model: IS_UNLIT(model), IS_GLOSSY(model) and so
/// on.
Defines featureDefines(const FeatureSet& features);

} // namespace tessera::frame
