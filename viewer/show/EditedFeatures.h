#pragma once
#include "renderer/frame/Features.h"

namespace tessera::viewer {

/// The features that a scene's materials, lights and environment ask programs for, wherever it is looked at from: those
/// of all lights that shine, in view or not. An edit that changes them may need programs that are yet to be compiled.
frame::FeatureSet editedFeatures(const scenes::Scene& scene);

} // namespace tessera::viewer
