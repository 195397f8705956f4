#pragma once
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera::app {

/// Options of `tessera compare` that affect its figures.
struct ComparisonOptions {
    FrameOptions frame;
    std::string techniques; ///< comma-separated names; empty: all that support the settings
    std::string against = "forward";
};

/// The truth named by the options; an existing image is not read yet. Throws InputError for errors found without the
/// scene, such as both --technique and --techniques.
validation::Truth truthOf(const ComparisonOptions& options);

/// A validated comparison.
struct Comparison {
    validation::CompareRequest request;
    std::vector<validation::LeftOutTechnique> leftOut;
};

/// Makes the comparison of the options and the resolved request. Reads the truth if it is an image. Throws InputError.
Comparison comparisonOf(const ComparisonOptions& options, const Request& request, validation::Truth truth);

/// Warns of settings without effect, missing shadows, undiffused subsurface irradiance, and an integer image as truth.
void warnOfComparison(const ComparisonOptions& options, const Request& request, const Comparison& comparison);
/// Warns of textures dropped because of the driver's limits.
void warnOfDriver(const gpu::Capabilities& gl, const Request& request, const Comparison& comparison);

/// validation::compareTechniques(); its record also lists the left-out techniques.
validation::CompareResult runComparison(engine::Renderer& renderer, const gpu::Capabilities& gl,
                                        const Comparison& comparison);

} // namespace tessera::app
