#pragma once
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera::app {

/// What of the options of `tessera compare` its figures depend on.
struct ComparisonOptions {
    FrameOptions frame;
    std::string techniques; ///< names, with commas between; empty: all that take the settings
    std::string against = "forward";
};

/// The truth that the options name; a picture that exists is not read yet. Throws InputError, also where the techniques
/// are named twice: what can be found without the scene.
validation::Truth truthOf(const ComparisonOptions& options);

/// A comparison of which everything is checked.
struct Comparison {
    validation::CompareRequest request;
    std::vector<validation::LeftOutTechnique> leftOut;
};

/// The comparison that the options ask for, with the resolved request; reads the truth where it is a picture. Throws
/// InputError.
Comparison comparisonOf(const ComparisonOptions& options, const Request& request, validation::Truth truth);

/// Warns of what the pictures lack by the settings and the scene alone, and of a truth that means little.
void warnOfComparison(const ComparisonOptions& options, const Request& request, const Comparison& comparison);
/// Warns of what they lack on that driver.
void warnOfDriver(const gpu::Capabilities& gl, const Request& request, const Comparison& comparison);

/// validation::compareTechniques(), with what was left out.
validation::CompareResult runComparison(engine::Renderer& renderer, const gpu::Capabilities& gl,
                                        const Comparison& comparison);

} // namespace tessera::app
