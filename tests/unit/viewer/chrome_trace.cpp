#include "viewer/save/ChromeTrace.h"

#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::viewer {
namespace {

using Json = nlohmann::json;

std::vector<TraceFrame> twoFrames() {
    return {{7, 1.0, 3.0, {{"gbuffer", 1.0, 5.0}, {"display \"final\"", 0.5, std::nullopt}}},
            {8, 1.004, 2.0, {{"gbuffer", 1.5, 4.0}, {"lighting", 0.25, 1.0}}}};
}

Json eventsOf(const std::vector<TraceFrame>& frames) {
    return Json::parse(chromeTrace(frames, "llvmpipe"))["traceEvents"];
}

TEST(ChromeTrace, everyEventHasTheFieldsOfTheTraceEventFormat) {
    const Json document = Json::parse(chromeTrace(twoFrames(), "llvmpipe"));
    EXPECT_EQ(document["displayTimeUnit"], "ms");
    std::set<std::string> rows;
    for (const Json& event : document["traceEvents"]) {
        EXPECT_TRUE(event["name"].is_string() && event["pid"].is_number_integer()) << event;
        if (event["ph"] == "M") {
            rows.insert(event["args"]["name"].get<std::string>());
            continue;
        }
        EXPECT_EQ(event["ph"], "X");
        EXPECT_TRUE(event["tid"].is_number_integer() && event["ts"].is_number() && event["dur"].is_number()) << event;
        EXPECT_GE(event["dur"].get<double>(), 0.0);
    }
    EXPECT_EQ(rows, (std::set<std::string>{"tessera", "CPU", "GPU: llvmpipe"}));
}

TEST(ChromeTrace, timesAreMicrosecondsAndPassesLieEndToEndInTheirFrame) {
    std::vector<std::vector<double>> cpu, gpu;
    for (const Json& event : eventsOf(twoFrames())) {
        if (event["ph"] != "X" || event["name"] == "frame") continue;
        (event["cat"] == "cpu" ? cpu : gpu).push_back({event["ts"], event["dur"]});
    }
    using Rows = std::vector<std::vector<double>>;
    EXPECT_EQ(cpu, (Rows{{1e6, 1000}, {1001e3, 500}, {1004e3, 1500}, {1005.5e3, 250}}));
    EXPECT_EQ(gpu, (Rows{{1e6, 5000}, {1005e3, 4000}, {1009e3, 1000}})) << "the second frame waits for the first";
}

TEST(ChromeTrace, stretchesOfARowNeverOverlapWithoutOneContainingTheOther) {
    std::vector<TraceFrame> frames = twoFrames();
    frames[1].startSeconds = 1.0005; // before the first is over
    std::map<int, std::vector<std::pair<double, double>>> rows;
    for (const Json& event : eventsOf(frames))
        if (event["ph"] == "X")
            rows[event["tid"]].push_back({event["ts"], event["ts"].get<double>() + event["dur"].get<double>()});
    for (const auto& [row, stretches] : rows)
        for (const auto& a : stretches)
            for (const auto& b : stretches) {
                const bool apart = a.second <= b.first || b.second <= a.first;
                const bool within =
                    (a.first >= b.first && a.second <= b.second) || (b.first >= a.first && b.second <= a.second);
                EXPECT_TRUE(apart || within) << a.first << ' ' << b.first;
            }
}

TEST(ChromeTrace, aPassWithoutAGpuTimeIsNotOnTheGpusRow) {
    for (const Json& event : eventsOf(twoFrames()))
        EXPECT_FALSE(event.value("cat", "") == "gpu" && event["name"] == "display \"final\"");
}

} // namespace
} // namespace tessera::viewer
