#pragma once
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <ranges>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/ChooseSamples.h"

namespace tessera::test {

/// Whether the running test covers its whole sweep: in suites whose names end in Slow, which only ./test --all runs.
/// Other suites cover a part that contains every value of every axis.
inline bool isWholeSweep() {
    return std::string_view(testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()).ends_with("Slow");
}

/// The element of `all` that `turn`, counted from 0, selects. All elements in a whole sweep.
template <std::ranges::borrowed_range Range>
auto inTurn(Range&& all, std::size_t turn) {
    const std::span elements(all);
    return isWholeSweep() ? elements.subspan(0) : elements.subspan(turn % elements.size(), 1);
}

/// The technique that `turn` selects of those that support this number of samples per pixel, except forward, with which
/// the tests compare them. All in a whole sweep. Techniques differ in how they store surfaces, in their light lists and
/// in their lighting pass, and share the lighting code. So the first turns select one that differs from forward in each
/// of these; the others follow in table order.
inline std::vector<engine::Technique> techniquesInTurn(std::size_t turn, int samples = 1) {
    using engine::Technique;
    std::vector<Technique> techniques{Technique::ClusteredDeferred, Technique::ForwardPlus, Technique::DeferredVolumes,
                                      Technique::TiledDeferred};
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (info.technique != Technique::Forward && std::ranges::find(techniques, info.technique) == techniques.end())
            techniques.push_back(info.technique);
    std::erase_if(techniques,
                  [&](Technique technique) { return !engine::supportsSamples(engine::infoOf(technique), samples); });
    if (!isWholeSweep()) techniques = {techniques[turn % techniques.size()]};
    return techniques;
}

/// The first of `values` and every `n`th after it. All in a whole sweep.
template <typename Value>
std::vector<Value> everyNth(std::vector<Value> values, std::size_t n) {
    std::vector<Value> taken;
    for (std::size_t i = 0; i < values.size(); i += isWholeSweep() ? 1 : n) taken.push_back(std::move(values[i]));
    return taken;
}

/// A test of a fixture, by suite and name.
struct SweepName {
    const char *suite, *name;
};

template <typename Fixture, typename Test>
bool registerSweep(std::initializer_list<SweepName> names, const char* file, int line) {
    for (const auto& [suite, name] : names)
        testing::RegisterTest(suite, name, nullptr, nullptr, file, line, []() -> Fixture* { return new Test; });
    return true;
}

/// Defines a test in two suites: part of its sweep in the fixture's, all of it in the one whose name ends in Slow.
#define TEST_SWEEP(fixture, name) TEST_SWEEP_AS(fixture, name, fixture##Slow, name)
/// The same with another suite or name for the whole sweep.
#define TEST_SWEEP_AS(fixture, name, slowSuite, slowName)                                                              \
    class fixture##_##name##_Sweep : public fixture {                                                                  \
        void TestBody() override;                                                                                      \
    };                                                                                                                 \
    [[maybe_unused]] const bool kIsRegistered_##fixture##_##name =                                                     \
        ::tessera::test::registerSweep<fixture, fixture##_##name##_Sweep>(                                             \
            {{#fixture, #name}, {#slowSuite, #slowName}}, __FILE__, __LINE__);                                         \
    void fixture##_##name##_Sweep::TestBody()

} // namespace tessera::test
