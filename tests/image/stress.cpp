// The stability suite itself: in its short form every day, in full where slow tests run.
#include <fmt/format.h>

#include "tests/support/GlContext.h"
#include "validation/stress/StressRecord.h"

namespace tessera {
namespace {

class Stress : public test::GlTest {
protected:
    validation::StressRecord run(validation::StressEffort effort) {
        validation::StressRequest request;
        for (const validation::StressCase& row : validation::stressCases()) request.cases.push_back(&row);
        for (const engine::TechniqueInfo& info : engine::techniqueTable()) request.techniques.push_back(info.technique);
        request.effort = effort;
        double last = 0.0;
        request.progress = [&last](double share) {
            EXPECT_GE(share, last);
            EXPECT_LE(share, 1.0);
            last = share;
        };
        validation::StressRecord record{context().capabilities().renderer, effort,
                                        validation::runStress(context(), request)};
        EXPECT_EQ(last, 1.0);
        for (const validation::StressResult& result : record.results)
            EXPECT_TRUE(result.ok()) << result.name << ": " << testing::PrintToString(result.missed());
        return record;
    }

    static std::uint64_t brdfSamples(const validation::StressRecord& record) {
        std::uint64_t samples = 0;
        for (const validation::StressResult& result : record.results)
            if (result.name.starts_with("brdf/")) samples += result.figures.samples;
        return samples;
    }
};

TEST_F(Stress, everyCaseHoldsInItsShortForm) {
    run(validation::StressEffort::Quick);
}

class StressSlow : public Stress {};

TEST_F(StressSlow, everyCaseHoldsOverTenMillionSamplesOfMaterials) {
    const validation::StressRecord record = run(validation::StressEffort::Full);
    EXPECT_GE(brdfSamples(record), 10'000'000u);
    fmt::print("{}", validation::stressTable(record));
}

} // namespace
} // namespace tessera
