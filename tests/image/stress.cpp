// The stability suite itself: in its short form every day, in full where slow tests run.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/support/GlContext.h"
#include "validation/stress/StressRecord.h"

namespace tessera {
namespace {

class Stress : public test::GlTest {
protected:
    /// Of these cases those that draw pictures are drawn with `techniques` techniques, for each case the next ones in
    /// turn.
    validation::StressRecord run(const std::vector<validation::StressCase>& cases, validation::StressEffort effort,
                                 std::size_t techniques) {
        validation::StressRecord record{context().capabilities().renderer, effort, {}};
        const auto all = engine::techniqueTable();
        for (std::size_t first = 0; first < all.size(); first += techniques) {
            validation::StressRequest request;
            request.effort = effort;
            for (std::size_t i = 0; i < techniques; ++i) request.techniques.push_back(all[first + i].technique);
            std::size_t turn = 0;
            for (const validation::StressCase& row : cases)
                if (turn++ % (all.size() / techniques) == first / techniques) request.cases.push_back(&row);
            std::ranges::move(runOne(request), std::back_inserter(record.results));
        }
        EXPECT_GE(record.results.size(), cases.size());
        return record;
    }

    std::vector<validation::StressResult> runOne(validation::StressRequest& request) {
        double last = 0.0;
        request.progress = [&last](double share) {
            EXPECT_GE(share, last);
            EXPECT_LE(share, 1.0);
            last = share;
        };
        std::vector<validation::StressResult> results = validation::runStress(context(), request);
        EXPECT_EQ(last, 1.0);
        for (const validation::StressResult& result : results)
            EXPECT_TRUE(result.ok()) << result.name << ": " << testing::PrintToString(result.missed());
        return results;
    }

    /// With every eighth picture of its short form, and those that these are compared with.
    static validation::StressCase withFewerPictures(validation::StressCase row) {
        if (!row.pictures) return row;
        std::vector<validation::StressPicture> all = row.pictures(validation::StressEffort::Quick), some;
        std::vector<bool> isTaken(all.size());
        for (std::size_t i = all.size(); i-- > 0;) {
            isTaken[i] = isTaken[i] || i % 8 == 0;
            if (isTaken[i] && all[i].sameAs) isTaken[*all[i].sameAs] = true;
        }
        std::vector<std::size_t> places(all.size()); // in `some`
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!isTaken[i]) continue;
            if (all[i].sameAs) all[i].sameAs = places[*all[i].sameAs];
            places[i] = some.size();
            some.push_back(std::move(all[i]));
        }
        row.pictures = [some](validation::StressEffort) { return some; };
        return row;
    }

    static std::uint64_t brdfSamples(const validation::StressRecord& record) {
        std::uint64_t samples = 0;
        for (const validation::StressResult& result : record.results)
            if (result.name.starts_with("brdf/")) samples += result.figures.samples;
        return samples;
    }
};

TEST_F(Stress, everyCaseHoldsInItsShortForm) {
    std::vector<validation::StressCase> cases;
    for (const validation::StressCase& row : validation::stressCases()) cases.push_back(withFewerPictures(row));
    run(cases, validation::StressEffort::Quick, 1);
}

class StressSlow : public Stress {};

TEST_F(StressSlow, everyCaseHoldsOverTenMillionSamplesOfMaterials) {
    const validation::StressRecord record =
        run(validation::stressCases(), validation::StressEffort::Full, engine::techniqueTable().size());
    EXPECT_GE(brdfSamples(record), 10'000'000u);
    fmt::print("{}", validation::stressTable(record));
}

} // namespace
} // namespace tessera
