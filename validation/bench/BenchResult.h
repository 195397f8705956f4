#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/bench/MethodKey.h"
#include "validation/lower_bound/LowerBoundBench.h"
#include "validation/timing/FrameTimer.h"

/// What a benchmark knows of its points: plain values, as they are measured, kept in files and shown.
namespace tessera::validation {

/// Which point it is, in names of the command line, after defaults are resolved.
struct PointKey {
    std::string technique;
    std::string culling = "none";
    std::optional<int> tilePixels; ///< none without light lists
    std::string layout;            ///< of the G-buffer; "exact" for techniques without one
    double rangeTolerance = 0.0;
    MethodKeys methods{}; ///< none where the settings of the command line leave a kind nothing to change
    /// What lights the G-buffer, a name of frame::lightingStageTable(); none of techniques without the choice.
    std::optional<std::string> lightOn{};

    /// Whether compute shaders light the G-buffer: fragment shaders are usual.
    bool isLitByCompute() const { return lightOn == infoOf(frame::LightingStage::Compute).name; }
    std::optional<MethodKey>& method(MethodKind kind) { return methods[std::size_t(kind)]; }
    const std::optional<MethodKey>& method(MethodKind kind) const { return methods[std::size_t(kind)]; }
    bool operator==(const PointKey&) const = default;
};

/// "tiled_deferred, tile_2.5d 16, packed", with ", compute" behind it where that lights the G-buffer, ", range 0.01"
/// behind it where lights are ended, and methodTexts().
std::string pointName(const PointKey& key);

/// Counters of a frame's work, beside its times. A figure that could not be measured is none, and `why` says why.
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

/// A point's picture against the truth of its group. What could not be measured is none, with the reason in
/// BenchResult::why under "error.<figure>".
struct BenchError {
    std::optional<double> relMse, maxRel, p99Rel, p999Rel, bias, flip;
    double excluded = 0.0; ///< share of the covered pixels that show other triangles in the truth
};

struct BenchResult {
    PointKey key;
    std::optional<std::string> builder, normalTest; ///< of light lists
    PointTimes times;
    BenchCounters counters;
    std::optional<double> floorMs, ratioToFloor;       ///< of all needed evaluations
    std::optional<double> floorLitMs, ratioToLitFloor; ///< of those whose light lies in front of the surface
    std::optional<BenchError> error;
    std::map<std::string, std::string> why; ///< of figures that are none
};

/// AttributionLine::cause of a difference that is no error.
inline constexpr const char* kFilterCause = "filter";
/// Of a point's error by all its causes, and of what products of their errors add to the sum of theirs.
inline constexpr const char *kWholeCause = "whole", *kCrossCause = "cross";

/// How much one cause adds to the error, with all others absent. "filter" is no error but a choice: how far a picture
/// whose textures are filtered with their smaller levels is from one of the finest level alone.
struct AttributionLine {
    /// "arithmetic", "noise", "area", "environment", "subsurface", "glass", "filter", "shadow", "range", "layout",
    /// "whole" or "cross"
    std::string cause;
    std::string what; ///< "range tolerance 0.01", "packed: albedo", "shadow filter pcf"
    std::string against;
    std::optional<double> relMse, p99Rel, bias;
};

/// A picture that one or more points show, bit for bit, with its error as colours.
struct BenchPicture {
    std::string name;                ///< the first point's, or the truth's
    std::vector<std::string> points; ///< names of all that show it; empty for the truth
    std::string file, heatMapFile;   ///< in the folder of the run; no heat map of the truth
    std::uint64_t hash = 0;          ///< of its radiance
};

/// Points of one scene, light count and size, measured in turn with the lower bound.
struct BenchGroup {
    std::string scene;
    int lights = 0;
    glm::ivec2 sizePixels{0};
    std::size_t triangles = 0;
    std::string truth, whyTruth; ///< what the errors are against, and why that
    LowerBoundFigures lowerBound;
    std::vector<BenchResult> results;
    std::vector<AttributionLine> attribution;
    std::vector<BenchPicture> pictures;
};

/// "hall with 257 lights at 1280x720".
std::string groupName(const BenchGroup& group);

struct SkippedPoint {
    std::string what;
    std::string why;
};

} // namespace tessera::validation
