#pragma once
#include "engine/Renderer.h"
#include "validation/compare/CompareRecord.h"

namespace tessera::validation {

/// Measures the light that settings.rangeTolerance drops: renders the final view with it and without, the latter being
/// the truth. The bias is never positive, since ending a light adds irradiance nowhere.
RangeTruncation rangeTruncation(engine::Renderer& renderer, engine::Technique technique, frame::FrameSettings settings);

} // namespace tessera::validation
