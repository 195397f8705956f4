#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/BenchMatrix.h"
#include "validation/FloorBench.h"
#include "validation/FrameTimer.h"

namespace tessera::validation {

/// What a frame does, counted, beside what it costs. A figure that could not be had is none, and `why` says why.
struct BenchCounters {
    std::optional<std::uint64_t> lightEvaluations;     ///< lights visited, summed over the shaded pixels
    std::optional<std::uint64_t> neededEvaluations;    ///< pairs of a covered pixel and a light that reaches it
    std::optional<std::uint64_t> neededLitEvaluations; ///< those that also lie in front of the surface
    std::optional<double> tightness;                   ///< evaluated / needed, of the lights that end somewhere
    std::optional<double> evaluatedMean;               ///< a covered pixel
    std::optional<std::uint64_t> evaluatedP99, evaluatedMax;
    std::uint64_t listEntries = 0, listBytes = 0;
    std::uint64_t gbufferBytes = 0; ///< written, and read again
    /// That are lit: each covered pixel, or in forward each that passes the depth test.
    std::optional<std::uint64_t> fragments;
    std::uint64_t triangles = 0, draws = 0;
    std::uint64_t falseNegatives = 0; ///< needed pairs that were not visited; a fault where it is not 0
};

struct BenchResult {
    BenchPoint point;
    std::string technique, layout;
    culling::Choice culling; ///< what the frame did
    PointTimes times;
    BenchCounters counters;
    std::optional<double> floorMs, ratioToFloor;
    std::map<std::string, std::string> why; ///< of figures that are none
};

/// Points of one scene, light count and size, measured in turn with the floor.
struct BenchGroup {
    std::string scene;
    int lights = 0; ///< of the scene
    glm::ivec2 sizePixels{0};
    FloorFigures floor;
    std::vector<BenchResult> results;
};

struct BenchOptions {
    int frames = 20;                        ///< of each point
    std::function<void()> progress = [] {}; ///< called after each round of frames
};

/// Rounds of frames that measuring `groups` groups takes, for progress.
std::size_t benchRounds(const BenchOptions& options, std::size_t groups);

/// The end of the group that begins at `first`.
std::size_t groupEnd(const std::vector<BenchPoint>& points, std::size_t first);

/// Measures points of one group. The scene is loaded already, with the group's number of lights.
BenchGroup benchGroup(gpu::Context& context, const scenes::Scene& scene, std::span<const BenchPoint> points,
                      const BenchOptions& options);

} // namespace tessera::validation
