#pragma once
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Context.h"
#include "renderer/shader/ProgramLibrary.h"
#include "renderer/shader/SourceTree.h"

namespace tessera::validation {

/// Effort of a run. Quick: a quarter to a 64th of the random samples, and at most 1024 lights.
enum class StressEffort { Quick, Full };

/// Tools of a case: the context, the shaders under test, and shader functions run on given numbers.
class StressBench {
public:
    /// The context must be current and outlive the object. `progress` receives the completed fraction 0..1 of the case.
    StressBench(
        gpu::Context& context, const shader::SourceTree& shaders, StressEffort effort,
        std::function<void(double)> progress = [](double) {}, float measuredTimes = 1.0f)
        : context_(context), shaders_(shaders), effort_(effort), progress_(std::move(progress)), programs_(shaders),
          measuredTimes_(measuredTimes) {}

    /// Runs a compute shader of shaders/stress, one invocation per record. It reads vec4 inputs[] and writes vec4
    /// outputs[] (shaders/shared/slots.h), as many of each per record as it defines. Other bindings are the caller's.
    std::vector<glm::vec4> run(const std::string& shader, const shader::Defines& defines,
                               const std::vector<glm::vec4>& inputs, std::size_t records, std::size_t outputsPerRecord);

    gpu::Context& context() { return context_; }
    const shader::SourceTree& shaders() const { return shaders_; }
    StressEffort effort() const { return effort_; }
    /// Factor on everything measured; run() applies it.
    float measuredTimes() const { return measuredTimes_; }
    void progress(double share) const { progress_(share); }

private:
    gpu::Context& context_;
    shader::SourceTree shaders_;
    StressEffort effort_;
    std::function<void(double)> progress_;
    shader::ProgramLibrary programs_;
    float measuredTimes_;
};

} // namespace tessera::validation
