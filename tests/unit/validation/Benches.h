#pragma once
#include <filesystem>
#include <string>

#include "base/Error.h"
#include "validation/bench/BenchRecord.h"
#include "validation/bench/BenchStore.h"

/// Benchmarks made up for tests, without a GL context.
namespace tessera::validation {

inline BenchResult madeUpResult(const std::string& technique, double ms, std::optional<double> relMse,
                                const std::string& layout = "exact") {
    BenchResult result;
    result.key = {technique, "none", {}, layout, 0.0};
    result.times.cpuMs = {ms, ms * 1.1};
    result.times.passes = {{"lighting", 0.7 * ms}, {"culling", {}}};
    result.why = {{"gpuMs", "made up"}, {"error.flip", "made up"}};
    result.counters.lightEvaluations = 1000;
    result.counters.triangles = 12;
    result.floorMs = 1.0 / 3.0; // its digits must survive
    result.ratioToFloor = 3.0 * ms;
    result.floorLitMs = 1.0 / 6.0;
    result.ratioToLitFloor = 6.0 * ms;
    if (relMse) result.error = BenchError{relMse, 2e-3, 1e-3, 1.5e-3, -1e-5, {}, 0.01};
    return result;
}

inline BenchGroup madeUpGroup(int lights, std::vector<BenchResult> results) {
    BenchGroup group;
    group.scene = "hall";
    group.lights = lights;
    group.sizePixels = {64, 32};
    group.triangles = 12;
    group.truth = "reference";
    group.lowerBound.geometryMs = 0.1;
    group.lowerBound.stores = {{lightStoreTable()[0].name, 1.0 / 7.0, 1.0 / 6.0}};
    group.lowerBound.geometryMsP95 = 0.3;
    group.lowerBound.rounds = 5;
    group.results = std::move(results);
    group.attribution = {{"layout", "packed: albedo", "that channel in fp32", 1e-7, {}, {}}};
    return group;
}

inline BenchPlan madeUpPlan(int groups) {
    BenchPlan plan;
    for (int i = 0; i < groups; ++i) {
        PlannedGroup group;
        group.scene = "hall";
        group.lights = 10 << i;
        group.fingerprint = 0xfedcba9876543210ull + std::uint64_t(i);
        group.sizePixels = {64, 32};
        BenchPoint point;
        point.key = {"forward", "none", {}, "exact", 0.0};
        group.points = {point};
        plan.groups.push_back(group);
    }
    plan.skipped = {{"forward, packed", "no G-buffer"}};
    return plan;
}

inline RunIdentity madeUpIdentity(int shard = 1, int shards = 1) {
    return {"2 x Chip", "llvmpipe", "4.5 Mesa", "abc",  " --size 64x32",
            "",         5,          shard,      shards, "tessera bench hall -o out"};
}

} // namespace tessera::validation
