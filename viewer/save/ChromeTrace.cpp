#include "viewer/save/ChromeTrace.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace tessera::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProcess = 1;
constexpr int kCpuRow = 1;
constexpr int kGpuRow = 2;
constexpr double kMicroseconds = 1000.0; ///< per millisecond

Json rowName(int row, const std::string& name) {
    return {{"name", "thread_name"}, {"ph", "M"}, {"pid", kProcess}, {"tid", row}, {"args", {{"name", name}}}};
}

/// A complete event.
Json stretch(const std::string& name, const char* category, int row, double startUs, double durationUs,
             std::uint64_t frame) {
    return {{"name", name},      {"cat", category}, {"ph", "X"},  {"ts", startUs},
            {"dur", durationUs}, {"pid", kProcess}, {"tid", row}, {"args", {{"frame", frame}}}};
}

double passesUs(const TraceFrame& frame) {
    double sumMs = 0.0;
    for (const TracePass& pass : frame.passes) sumMs += pass.cpuMs;
    return sumMs * kMicroseconds;
}

} // namespace

std::string chromeTrace(std::span<const TraceFrame> frames, const std::string& renderer) {
    Json events = Json::array();
    events.push_back({{"name", "process_name"}, {"ph", "M"}, {"pid", kProcess}, {"args", {{"name", "tessera"}}}});
    events.push_back(rowName(kCpuRow, "CPU"));
    events.push_back(rowName(kGpuRow, "GPU: " + renderer));
    double cpuFreeUs = 0.0, gpuFreeUs = 0.0; // events of a row may nest, but never overlap
    for (const TraceFrame& frame : frames) {
        const double startUs = std::max(frame.startSeconds * 1000.0 * kMicroseconds, cpuFreeUs);
        const double durationUs = std::max(frame.cpuMs * kMicroseconds, passesUs(frame));
        events.push_back(stretch("frame", "frame", kCpuRow, startUs, durationUs, frame.number));
        double cpuUs = startUs, gpuUs = std::max(startUs, gpuFreeUs);
        for (const TracePass& pass : frame.passes) {
            events.push_back(stretch(pass.name, "cpu", kCpuRow, cpuUs, pass.cpuMs * kMicroseconds, frame.number));
            cpuUs += pass.cpuMs * kMicroseconds;
            if (!pass.gpuMs) continue;
            events.push_back(stretch(pass.name, "gpu", kGpuRow, gpuUs, *pass.gpuMs * kMicroseconds, frame.number));
            gpuUs += *pass.gpuMs * kMicroseconds;
        }
        cpuFreeUs = startUs + durationUs;
        gpuFreeUs = gpuUs;
    }
    const Json trace = {{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}};
    // The driver's name may contain any bytes.
    return trace.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tessera::viewer
