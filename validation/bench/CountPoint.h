#pragma once
#include "engine/Renderer.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// Fills the counters of a point's result and how its lists are built, by the oracle and by drawing. Throws what
/// drawing throws.
void countPoint(engine::Renderer& renderer, const BenchPoint& point, BenchResult& result);

} // namespace tessera::validation
