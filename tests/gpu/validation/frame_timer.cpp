// Timing of interleaved frames.
#include <chrono>
#include <numeric>
#include <optional>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "engine/ChooseSamples.h"
#include "scenes/Load.h"
#include "tests/support/GlContext.h"
#include "validation/timing/FrameTimer.h"

namespace tessera {
namespace {

using engine::Technique;

class FrameTimerTest : public test::GlTest {
protected:
    static scenes::Scene lattice(int lights) {
        scenes::LoadOptions options;
        options.lights = lights;
        return scenes::loadScene("lattice", options);
    }
    static frame::FrameSettings settings() {
        frame::FrameSettings result;
        result.sizePixels = {320, 180};
        return result;
    }
};

TEST_F(FrameTimerTest, everyPointAndEveryPassHasATimeOrAReason) {
    const scenes::Scene few = lattice(16), many = lattice(256);
    engine::Renderer fewRenderer(context(), few), manyRenderer(context(), many);
    std::vector<validation::TimedPoint> points;
    for (engine::Renderer* renderer : {&fewRenderer, &manyRenderer})
        for (const Technique technique : {Technique::Forward, Technique::TiledDeferred})
            points.push_back({renderer, technique, settings()});
    validation::FrameTimerOptions options;
    options.interleave.rounds = 3;
    options.profiledFrames = 3;
    const validation::FrameTimes times = validation::timeFrames(points, {}, options);
    ASSERT_EQ(times.points.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const validation::PointTimes& point = times.points[i];
        EXPECT_GT(point.cpuMs.median, 0.0);
        EXPECT_GE(point.cpuMs.p95, point.cpuMs.median);
        const std::vector<graph::Plan::Pass> planned =
            engine::planFrame(points[i].renderer->scene(), points[i].technique,
                              engine::settingsOn(context().capabilities(), settings()))
                .passes;
        ASSERT_EQ(point.passes.size(), planned.size());
        for (std::size_t p = 0; p < planned.size(); ++p) {
            EXPECT_EQ(point.passes[p].name, planned[p].name);
            EXPECT_EQ(point.passes[p].gpuMs.has_value(), !point.why.contains("passes.gpuMs"));
        }
        EXPECT_EQ(point.gpuMs.has_value(), !point.why.contains("gpuMs"));
    }
}

TEST_F(FrameTimerTest, kindsOfFramesTakeTurnsWhileTheEyeMovesAMillimetre) {
    const scenes::Scene scene = lattice(4);
    engine::Renderer renderer(context(), scene);
    std::string order;
    std::vector<double> places;
    const auto noting = [&](char name) {
        return [&order, &places, name](const glm::dvec3& eyeOffsetWS) {
            order += name;
            places.push_back(eyeOffsetWS.x);
        };
    };
    const std::vector<validation::TimedFrame> others{noting('a'), noting('b')};
    validation::FrameTimerOptions options;
    options.interleave = {.warmUpRounds = 1, .rounds = 2};
    options.profiledFrames = 1;
    int reports = 0;
    options.interleave.progress = [&](int done, int total) {
        EXPECT_EQ(done, ++reports);
        EXPECT_EQ(total, 3);
    };
    const std::vector<validation::TimedPoint> points{{&renderer, Technique::Deferred, settings()}};
    const validation::FrameTimes times = validation::timeFrames(points, others, options);
    EXPECT_EQ(order, "ababab");
    EXPECT_EQ(places, (std::vector<double>{0.0, 0.0, 1e-3, 1e-3, 0.0, 0.0}));
    EXPECT_EQ(reports, 3);
    ASSERT_EQ(times.othersMs.size(), 2u);
    EXPECT_EQ(times.othersMs[0].size(), 2u);
}

TEST_F(FrameTimerTest, roundsOfTheWarmUpAreNotTimed) {
    constexpr double kFrameMs = 20.0; // a frame sleeps at least that long, except while warming up
    const validation::InterleaveOptions options{.warmUpRounds = 3, .rounds = 4};
    int drawn = 0;
    const std::vector<validation::TimedFrame> kinds{[&](const glm::dvec3&) {
        if (drawn++ >= options.warmUpRounds)
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(kFrameMs));
    }};
    const std::vector<std::vector<double>> timesMs = validation::timeInterleaved(kinds, options);
    ASSERT_EQ(timesMs.at(0).size(), 4u);
    for (const double ms : timesMs[0]) EXPECT_GE(ms, kFrameMs);
}

TEST_F(FrameTimerTest, theWarmUpSeesEveryPlaceOfTheEye) {
    // The work of a frame, such as the lights in view, may depend on the eye's position.
    const auto placesOf = [](int rounds) {
        std::set<double> places;
        for (int i = 0; i < rounds; ++i) places.insert(validation::eyeOffsetOfFrame(i).x);
        return places;
    };
    EXPECT_EQ(placesOf(validation::InterleaveOptions{}.warmUpRounds), placesOf(100));
}

TEST_F(FrameTimerTest, programsAreNotCompiledInFramesThatAreTimed) {
    const scenes::Scene scene = lattice(16);
    engine::Renderer renderer(context(), scene);
    std::vector<validation::TimedPoint> points;
    const auto add = [&](Technique technique, std::optional<culling::Builder> builder) {
        points.push_back({&renderer, technique, settings()});
        points.back().settings.sizePixels = {64, 36};
        points.back().settings.culling.builder = builder;
    };
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) add(technique.technique, {});
    for (const culling::BuilderInfo& builder : culling::builderTable())
        add(Technique::ClusteredDeferred, builder.builder);
    std::vector<std::size_t> programsByRound{renderer.programs().size()};
    validation::FrameTimerOptions options;
    options.interleave.rounds = 2;
    options.interleave.progress = [&](int, int) { programsByRound.push_back(renderer.programs().size()); };
    validation::timeFrames(points, {}, options);
    const std::size_t warm = programsByRound.at(std::size_t(options.interleave.warmUpRounds));
    EXPECT_GT(warm, programsByRound.front());
    EXPECT_EQ(programsByRound.back(), warm);
    EXPECT_EQ(renderer.programs().size(), warm) << "frames profiled afterwards are measured too";
}

TEST_F(FrameTimerTest, theBackendIsLeftAsItWas) {
    const scenes::Scene scene = lattice(4);
    engine::Renderer renderer(context(), scene);
    renderer.backend().setProfiling(true);
    const int idle = renderer.backend().mostIdleFrames();
    validation::FrameTimerOptions options;
    options.interleave = {.warmUpRounds = 1, .rounds = 2};
    options.interleave.progress = [](int done, int) {
        if (done == 2) throw std::runtime_error("interrupted");
    };
    const std::vector<validation::TimedPoint> points(std::size_t(idle + 2),
                                                     {&renderer, Technique::Deferred, settings()});
    EXPECT_THROW(validation::timeFrames(points, {}, options), std::runtime_error);
    EXPECT_TRUE(renderer.backend().profiling());
    EXPECT_EQ(renderer.backend().mostIdleFrames(), idle);
}

TEST_F(FrameTimerTest, anEyeOffsetEqualsAMovedCamera) {
    scenes::Scene scene = lattice(16);
    frame::FrameSettings moved = settings();
    moved.eyeOffsetWS = {0.25, -0.5, 0.125};
    engine::Renderer renderer(context(), scene);
    const std::vector<float> still = renderer.render(Technique::Forward, settings()).radiance;
    const std::vector<float> bySetting = renderer.render(Technique::Forward, moved).radiance;
    scene.cameras[0].worldFromCamera[3] += glm::dvec4(moved.eyeOffsetWS, 0.0);
    EXPECT_EQ(renderer.render(Technique::Forward, settings()).radiance, bySetting);
    EXPECT_NE(bySetting, still);
}

} // namespace
} // namespace tessera
