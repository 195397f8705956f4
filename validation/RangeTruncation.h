#pragma once
#include "passes/recipes/Renderer.h"
#include "validation/CompareRecord.h"

namespace tessera::validation {

/// Measures the light that settings.rangeTolerance drops: renders the final view with it and without, the latter being
/// the truth. The bias is never positive, since ending a light adds irradiance nowhere.
RangeTruncation rangeTruncation(recipes::Renderer& renderer, recipes::Technique technique,
                                frame::FrameSettings settings);

} // namespace tessera::validation
