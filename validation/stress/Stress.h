#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/Techniques.h"
#include "validation/stress/StressCase.h"

namespace tessera::validation {

/// The result of one case, per technique if it draws images.
struct StressResult {
    std::string name;
    std::optional<engine::Technique> technique; ///< unset: shader functions alone, which all techniques share
    StressFigures figures;
    StressBound bound = StressBound::WorstRel;
    double tolerance = 0.0;
    std::string reason;

    /// The figure that the tolerance applies to.
    double held() const { return bound == StressBound::WorstRel ? figures.worstRel : figures.worstRelMse; }
    bool ok() const { return missed().empty(); }
    /// The missed requirements, one sentence each.
    std::vector<std::string> missed() const;
};

struct StressRequest {
    std::vector<const StressCase*> cases;
    std::vector<engine::Technique> techniques;
    StressEffort effort = StressEffort::Full;
    shader::SourceTree shaders; ///< under test
    /// Factor on everything measured, applied before comparison: every case must miss when it is 0.5.
    float measuredTimes = 1.0f;
    /// Called with the fraction 0..1 of all cases done.
    std::function<void(double)> progress = [](double) {};
    std::function<void(const StressResult&)> found = [](const StressResult&) {}; ///< called for each result
};

/// Runs the cases on the current context. Throws std::runtime_error when GL fails.
std::vector<StressResult> runStress(gpu::Context& context, const StressRequest& request);

/// The case of this name, or all cases of the group of this name. Throws InputError with the nearest names if there is
/// none.
std::vector<const StressCase*> stressCasesNamed(const std::string& name);

} // namespace tessera::validation
