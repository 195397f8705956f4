#pragma once
#include <span>
#include <vector>

#include "renderer/gpu/Context.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/GroupTruth.h"

namespace tessera::validation {

/// The causes of error in a group's points, each with all others absent: fp32 arithmetic; light, and what changes it,
/// that only the reference finds exactly; filtering by hardware; each way to find shadows, each range tolerance, and
/// each channel of each packed layout. Then the error of a point of each set of causes, and its cross term: what the
/// products of its causes' errors add to the sum of their relMse. Draws some frames per cause, and the reference one
/// per part of the light. Throws what drawing throws.
std::vector<AttributionLine> attributeErrors(gpu::Context& context, const GroupTruth& truth,
                                             const std::string& truthName, std::span<const BenchPoint> points);

} // namespace tessera::validation
