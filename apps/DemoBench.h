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
    std::string folder; ///< output folder of the demo
    const Outputs& outputs;
    bool quiet = false;
};

/// Measures error against run time for the demo's scene: the techniques in two layouts, at a small image size to stay
/// short. Writes into demoBenchFolder().
validation::BenchRecord demoBench(gpu::Context& context, const DemoBenchRequest& demo);

std::string demoBenchFolder(const std::string& folder);

} // namespace tessera::app
