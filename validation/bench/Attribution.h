#pragma once
#include <span>
#include <vector>

#include "renderer/gpu/Context.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/GroupTruth.h"

namespace tessera::validation {

/// The causes of error in a group's points: fp32 arithmetic of an exact layout, filtering by hardware, each way to
/// find shadows, each range tolerance, and each channel of each packed layout. Draws some frames per cause. Throws what
/// drawing throws.
std::vector<AttributionLine> attributeErrors(const gpu::Capabilities& gl, const GroupTruth& truth,
                                             const std::string& truthName, std::span<const BenchPoint> points);

} // namespace tessera::validation
