#pragma once
#include <optional>
#include <span>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// How much of a picture is drawn, 0 to 1, by what its passes took in an earlier one of its kind; none where that had
/// none. `before` may be of another size: passes' shares change less than their times.
std::optional<double> drawnShare(std::span<const gpu::PassTiming> before, const gpu::BandProgress& progress);

} // namespace tessera::viewer
