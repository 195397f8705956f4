#pragma once
#include "engine/Renderer.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// Fills in a result's counters, list builder and normal test, from the light oracle and rendered frames. Throws what
/// drawing throws.
void countPoint(engine::Renderer& renderer, const BenchPoint& point, BenchResult& result);

} // namespace tessera::validation
