#pragma once
#include <span>
#include <vector>

#include "renderer/gpu/Context.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/GroupTruth.h"

namespace tessera::validation {

/// Measures the causes of error in a group's points, each with all others absent: fp32 arithmetic; approximated effects
/// (noise, area lights, environment, subsurface, glass); hardware filtering; each shadow method, each range tolerance,
/// and each channel of each packed layout. Then adds, per set of causes, a point's total error and its cross term: what
/// products of the causes' errors add to the sum of their relMse. Draws some frames per cause, and reference frames per
/// effect. Throws what drawing throws.
std::vector<AttributionLine> attributeErrors(gpu::Context& context, const GroupTruth& truth,
                                             const std::string& truthName, std::span<const BenchPoint> points);

} // namespace tessera::validation
