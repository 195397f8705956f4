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

/// Whether the running test goes through every case of its sweep: in suites whose names end in Slow, which only
/// ./test --all runs. Elsewhere a part that holds every value of every axis is enough.
inline bool isWholeSweep() {
    return std::string_view(testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()).ends_with("Slow");
}

/// The one element of `all` whose turn it is, by turns from 0. All in a whole sweep.
template <std::ranges::borrowed_range Range>
auto inTurn(Range&& all, std::size_t turn) {
    const std::span elements(all);
    return isWholeSweep() ? elements.subspan(0) : elements.subspan(turn % elements.size(), 1);
}

/// The technique whose turn it is, of those that take so many samples a pixel, but forward, with which the tests
/// compare them. All in a whole sweep. Techniques differ in how they store surfaces, in their light lists and in the
/// pass that lights, and share what they light with. So the first turns have one that differs from forward in each of
/// these; the others follow in the order of their table.
inline std::vector<engine::Technique> techniquesInTurn(std::size_t turn, int samples = 1) {
    using engine::Technique;
    std::vector<Technique> techniques{Technique::ClusteredDeferred, Technique::ForwardPlus, Technique::DeferredVolumes,
                                      Technique::TiledDeferred};
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (info.technique != Technique::Forward && std::ranges::find(techniques, info.technique) == techniques.end())
            techniques.push_back(info.technique);
    std::erase_if(techniques,
                  [&](Technique technique) { return !engine::takesSamples(engine::infoOf(technique), samples); });
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

/// A test of two suites: a part of its sweep in the fixture's own, all of it in the one whose name ends in Slow.
#define TEST_SWEEP(fixture, name) TEST_SWEEP_AS(fixture, name, fixture##Slow, name)
/// The same where the whole sweep has another suite or name.
#define TEST_SWEEP_AS(fixture, name, slowSuite, slowName)                                                              \
    class fixture##_##name##_Sweep : public fixture {                                                                  \
        void TestBody() override;                                                                                      \
    };                                                                                                                 \
    [[maybe_unused]] const bool kIsRegistered_##fixture##_##name =                                                     \
        ::tessera::test::registerSweep<fixture, fixture##_##name##_Sweep>(                                             \
            {{#fixture, #name}, {#slowSuite, #slowName}}, __FILE__, __LINE__);                                         \
    void fixture##_##name##_Sweep::TestBody()

} // namespace tessera::test
