#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "engine/ChooseSamples.h"

namespace tessera::test {

/// Whether the running test goes through every case of its sweep: in suites whose names end in Slow, which only
/// ./test --all runs. Elsewhere a part that holds every value of every axis is enough.
inline bool isWholeSweep() {
    return std::string_view(testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()).ends_with("Slow");
}

/// Every other technique that takes so many samples a pixel, but forward: these in even turns, those in odd ones. All
/// in a whole sweep.
inline std::vector<engine::Technique> techniquesInTurn(std::size_t turn, int samples = 1) {
    std::vector<engine::Technique> techniques;
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        if (info.technique == engine::Technique::Forward || !engine::takesSamples(info, samples)) continue;
        if (isWholeSweep() || turn++ % 2 == 0) techniques.push_back(info.technique);
    }
    return techniques;
}

} // namespace tessera::test
