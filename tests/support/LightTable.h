#pragma once
#include <span>
#include <string>
#include <vector>

#include "validation/culling/LightOracle.h"

namespace tessera::validation {

/// The oracle's results for a method of light culling at one tile side.
struct LightTableRow {
    culling::Method method = culling::Method::None;
    int tilePixels = 0; ///< 0: the method has no tiles
    LightOracleFigures figures;
};

/// Judges `none`, then every method at every tile side, all with deferred techniques. Of `settings.culling` only
/// `normals` is used. Throws what drawing throws.
std::vector<LightTableRow> judgeCulling(engine::Renderer& renderer, const frame::FrameSettings& settings,
                                        std::span<const int> tileSides = culling::kTileSides);

/// The rows as an ASCII table, below a line about the lights that the frame needs; each line ends in a newline. Mean,
/// p99 and max of visited lights include lights of unlimited range; the ratios exclude them.
std::string lightTable(std::span<const LightTableRow> rows);

} // namespace tessera::validation
