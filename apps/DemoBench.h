#pragma once
#include <string>
#include <vector>

#include "apps/Options.h"
#include "apps/Outputs.h"
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

/// Error against run time of the demonstration's scene: the techniques in two layouts, in a small picture,
/// so that it stays short. What is measured lies in the folder's own folder `bench`,
/// demoBenchFolder().
validation::BenchRecord demoBench(gpu::Context& context, const DemoBenchRequest& demo);

std::string demoBenchFolder(const std::string& folder);

} // namespace tessera::app
