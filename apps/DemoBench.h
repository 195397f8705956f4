#pragma once
#include <string>
#include <vector>

#include "apps/Outputs.h"
#include "apps/Request.h"
#include "validation/bench/BenchRecord.h"

namespace tessera::app {

struct DemoBenchRequest {
    const FrameOptions& options;
    const Request& request;
    std::vector<engine::Technique> techniques;
    std::string folder; ///< of the demonstration
    const Outputs& outputs;
    bool quiet = false;
};

/// Measures error against run time of the demonstration's scene: the techniques in two layouts, in a small picture, so
/// that it stays short. Writes into demoBenchFolder().
validation::BenchRecord demoBench(gpu::Context& context, const DemoBenchRequest& demo);

std::string demoBenchFolder(const std::string& folder);

} // namespace tessera::app
