#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/bench/MethodKey.h"
#include "validation/lower_bound/LowerBoundBench.h"
#include "validation/timing/FrameTimer.h"

/// Results of a benchmark's points: plain values that are measured, stored in files and displayed.
namespace tessera::validation {

/// The identity of a point, in names of the command line, with defaults resolved.
struct PointKey {
    std::string technique;
    std::string culling = "none";
    std::optional<int> tilePixels; ///< none without light lists
    std::string layout;            ///< of the G-buffer; "exact" for techniques without one
    double rangeTolerance = 0.0;
    MethodKeys methods{}; ///< unset for kinds that would not change the frame
    /// The stage that lights the G-buffer, from frame::lightingStageTable(); unset for techniques without the choice.
    std::optional<std::string> lightOn{};

    /// Whether compute shaders, not the usual fragment shaders, light the G-buffer.
    bool isLitByCompute() const { return lightOn == infoOf(frame::LightingStage::Compute).name; }
    std::optional<MethodKey>& method(MethodKind kind) { return methods[std::size_t(kind)]; }
    const std::optional<MethodKey>& method(MethodKind kind) const { return methods[std::size_t(kind)]; }
    bool operator==(const PointKey&) const = default;
};

/// "tiled_deferred, tile_2.5d 16, packed", followed by ", compute" if compute shaders light the G-buffer, ", range
/// 0.01" if a range tolerance is set, and methodTexts().
std::string pointName(const PointKey& key);

/// Work counters of a frame. A figure that could not be measured is unset, with the reason in BenchResult::why.
struct BenchCounters {
    std::optional<std::uint64_t> lightEvaluations;     ///< lights visited, summed over the shaded pixels
    std::optional<std::uint64_t> neededEvaluations;    ///< pairs of a covered pixel and a light that reaches it
    std::optional<std::uint64_t> neededLitEvaluations; ///< pairs whose light is also in front of the surface
    std::optional<double> tightness;                   ///< evaluated / needed, over lights with a finite range
    std::optional<double> evaluatedMean;               ///< mean over covered pixels
    std::optional<std::uint64_t> evaluatedP99, evaluatedMax;
    std::uint64_t listEntries = 0, listBytes = 0;
    std::uint64_t gbufferBytes = 0; ///< written, and read again
    /// Shaded fragments: the covered pixels, or in forward all fragments that pass the depth test.
    std::optional<std::uint64_t> fragments;
    std::uint64_t triangles = 0, draws = 0;
    std::uint64_t falseNegatives = 0; ///< needed pairs that were not visited; an error unless 0
};

/// The error of a point's image against its group's truth. Figures that could not be measured are unset, with the
/// reason in BenchResult::why under "error.<figure>".
struct BenchError {
    std::optional<double> relMse, maxRel, p99Rel, p999Rel, bias, flip;
    double excluded = 0.0; ///< fraction of the covered pixels that show other triangles in the truth
};

struct BenchResult {
    PointKey key;
    std::optional<std::string> builder, normalTest; ///< of the light lists, if any
    PointTimes times;
    BenchCounters counters;
    std::optional<double> floorMs, ratioToFloor;       ///< for all needed evaluations
    std::optional<double> floorLitMs, ratioToLitFloor; ///< for those whose light is in front of the surface
    std::optional<BenchError> error;
    std::map<std::string, std::string> why; ///< by unset figure
};

/// AttributionLine::cause of the texture filter, a difference that is not an error.
inline constexpr const char* kFilterCause = "filter";
/// AttributionLine::cause of a point's total error, and of the cross term: what products of errors add to their sum.
inline constexpr const char *kWholeCause = "whole", *kCrossCause = "cross";

/// The error that one cause adds with all others absent. "filter" is not an error but a choice: the difference between
/// textures filtered with mipmaps and with the finest level alone.
struct AttributionLine {
    /// "arithmetic", "noise", "area", "environment", "subsurface", "glass", "filter", "shadow", "range", "layout",
    /// "whole" or "cross"
    std::string cause;
    std::string what; ///< "range tolerance 0.01", "packed: albedo", "shadow filter pcf"
    std::string against;
    std::optional<double> relMse, p99Rel, bias;
};

/// An image that one or more points render bit for bit, with its error as a heat map.
struct BenchPicture {
    std::string name;                ///< the first point's, or the truth's
    std::vector<std::string> points; ///< names of all that render it; empty for the truth
    std::string file, heatMapFile;   ///< in the run's folder; the truth has no heat map
    std::uint64_t hash = 0;          ///< of its radiance
};

/// Points of one scene, light count and size, measured in turn with the lower bound.
struct BenchGroup {
    std::string scene;
    int lights = 0;
    glm::ivec2 sizePixels{0};
    std::size_t triangles = 0;
    std::string truth, whyTruth; ///< name of the truth, and why it was chosen
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
