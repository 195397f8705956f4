#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"
#include "validation/stress/StressBench.h"
#include "validation/stress/StressFigures.h"

namespace tessera::validation {

/// The figure that a case's tolerance applies to.
enum class StressBound { WorstRel, RelMse };

/// An image that every technique draws.
struct StressPicture {
    std::string what; ///< such as "257 lights in one tile"
    scenes::Scene scene;
    frame::FrameSettings settings;
    /// Index of an earlier picture of the case, whose image by the same technique is the truth. Unset: the reference
    /// renderer's image is.
    std::optional<std::size_t> sameAs = {};
    double allowed = 1.0; ///< multiple of the case's tolerance; errors are divided by it
};

/// One row of the suite. It either measures shader functions alone, which all techniques share, or draws images with
/// every technique.
struct StressCase {
    std::string name;  ///< "group/what"
    std::string holds; ///< what must hold, one line
    StressBound bound = StressBound::WorstRel;
    double tolerance = 0.0;
    std::string reason; ///< for the tolerance
    std::function<void(StressBench&, StressFigures&)> measure = {};
    std::function<std::vector<StressPicture>(StressEffort)> pictures = {};
};

/// Every case, in the order in which they run.
const std::vector<StressCase>& stressCases();

/// The rows by group; stressCases() is all of them.
void addBrdfCases(std::vector<StressCase>& cases);
void addTermCases(std::vector<StressCase>& cases);
void addLightCases(std::vector<StressCase>& cases);
void addManyLightCases(std::vector<StressCase>& cases);
void addPlaceCases(std::vector<StressCase>& cases);
void addGeometryCases(std::vector<StressCase>& cases);
void addTargetCases(std::vector<StressCase>& cases);
void addShadowCases(std::vector<StressCase>& cases);
void addSubsurfaceCases(std::vector<StressCase>& cases);
void addEnvironmentCases(std::vector<StressCase>& cases);

} // namespace tessera::validation
