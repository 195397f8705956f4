#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/Techniques.h"
#include "validation/stress/StressCase.h"

namespace tessera::validation {

/// One case, by one technique where pictures are drawn.
struct StressResult {
    std::string name;
    std::optional<engine::Technique> technique; ///< none: shader functions alone, which all techniques share
    StressFigures figures;
    StressBound bound = StressBound::WorstRel;
    double tolerance = 0.0;
    std::string reason;

    /// The figure that the tolerance is for.
    double held() const { return bound == StressBound::WorstRel ? figures.worstRel : figures.worstRelMse; }
    bool ok() const { return missed().empty(); }
    /// What did not hold, one sentence each.
    std::vector<std::string> missed() const;
};

struct StressRequest {
    std::vector<const StressCase*> cases;
    std::vector<engine::Technique> techniques;
    StressEffort effort = StressEffort::Full;
    shader::SourceTree shaders; ///< under test
    /// All that is measured is multiplied by it before it is compared: every case must miss when it is halved.
    float measuredTimes = 1.0f;
    /// Called with the share 0..1 of all cases done.
    std::function<void(double)> progress = [](double) {};
    std::function<void(const StressResult&)> found = [](const StressResult&) {}; ///< called for each result
};

/// Runs the cases on the current context. Throws std::runtime_error when GL fails.
std::vector<StressResult> runStress(gpu::Context& context, const StressRequest& request);

/// The cases of this name, or those of this group when a name ends before its '/'. Throws InputError naming the nearest
/// ones when there is none.
std::vector<const StressCase*> stressCasesNamed(const std::string& name);

} // namespace tessera::validation
