#include "validation/stress/StressCase.h"

namespace tessera::validation {

const std::vector<StressCase>& stressCases() {
    static const std::vector<StressCase> kCases = [] {
        std::vector<StressCase> cases;
        addBrdfCases(cases);
        addTermCases(cases);
        addLightCases(cases);
        addManyLightCases(cases);
        addPlaceCases(cases);
        addGeometryCases(cases);
        addTargetCases(cases);
        addShadowCases(cases);
        addSubsurfaceCases(cases);
        addEnvironmentCases(cases);
        return cases;
    }();
    return kCases;
}

} // namespace tessera::validation
