#pragma once
#include <optional>
#include <span>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// The drawn fraction of an image, 0 to 1, estimated from the pass times of an earlier one of its kind; none without
/// times. `before` may be of another size: relative pass times change less than absolute ones.
std::optional<double> drawnShare(std::span<const gpu::PassTiming> before, const gpu::BandProgress& progress);

} // namespace tessera::viewer
