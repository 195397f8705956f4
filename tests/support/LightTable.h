#pragma once
#include <span>
#include <string>
#include <vector>

#include "validation/culling/LightOracle.h"

namespace tessera::validation {

/// A method of light culling at one tile side, judged by the oracle.
struct LightTableRow {
    culling::Method method = culling::Method::None;
    int tilePixels = 0; ///< 0: the method has no tiles
    LightOracleFigures figures;
};

/// Judges every method at every tile side, and first `none`, all with deferred techniques. Of `settings`, only those of
/// culling are not used. Throws what drawing throws.
std::vector<LightTableRow> judgeCulling(engine::Renderer& renderer, const frame::FrameSettings& settings,
                                        std::span<const int> tileSides = culling::kTileSides);

/// The rows as a table of ASCII characters under a line on the lights that the frame needs, each line ending in a
/// newline. Visited lights, mean, p99 and max, include those that reach everywhere; the ratios leave them out.
std::string lightTable(std::span<const LightTableRow> rows);

} // namespace tessera::validation
