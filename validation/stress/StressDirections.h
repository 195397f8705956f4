#pragma once
#include <span>

#include "validation/stress/StressRandom.h"

namespace tessera::validation {

/// A surface's frame with a light and a viewer, in the fp32 precision of shader inputs.
struct StressView {
    glm::vec3 normal, tangent, toLight, toViewer;
};

/// A placement of light and viewer.
struct StressDirection {
    const char* name; ///< as part of a case's name
    const char* holds;
    /// `alpha` is that of the lobe to hit.
    void (*place)(StressView& view, double alpha, StressRandom& random);
};
/// The first is random; the others break naive code.
std::span<const StressDirection> stressDirections();

/// A random frame with light and viewer placed.
StressView stressView(const StressDirection& direction, double alpha, StressRandom& random);

} // namespace tessera::validation
