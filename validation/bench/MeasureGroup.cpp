#include "validation/bench/MeasureGroup.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/Rendering.h"
#include "scenes/InUse.h"
#include "validation/bench/Attribution.h"
#include "validation/bench/CountPoint.h"
#include "validation/pictures/HeatMap.h"
#include "validation/reference/Settings.h"

namespace tessera::validation {

namespace {

// Estimated costs in frames of a point, for the remaining time that progress shows.
constexpr std::size_t kStepsOfAPoint = 12; // its profiled frames, the oracle and its picture
constexpr std::size_t kStepsOfTheTruth = 20;
constexpr std::size_t kStepsOfTheCauses = 12;

/// 64-bit FNV-1a hash (Fowler, Noll, Vo) of the radiance.
std::uint64_t hashOf(const Picture& picture) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const float value : picture.rgba) {
        std::uint32_t bits = 0;
        static_assert(sizeof(bits) == sizeof(value));
        std::memcpy(&bits, &value, sizeof(bits));
        for (int byte = 0; byte < 4; ++byte) {
            hash ^= (bits >> (8 * byte)) & 0xffu;
            hash *= 1099511628211ull;
        }
    }
    return hash;
}

/// The measurement of one group.
class Measurement {
public:
    Measurement(gpu::Context& context, const scenes::Scene& scene, const PlannedGroup& planned,
                const BenchOptions& options, GroupState& state)
        : context_(context), planned_(planned), options_(options), state_(state), group_(state.group),
          renderer_(context, scene),
          variesSubsurface_(std::ranges::any_of(planned.points,
                                                [&](const BenchPoint& point) {
                                                    return point.key.method(MethodKind::Subsurface) !=
                                                           planned.points.front().key.method(MethodKind::Subsurface);
                                                })),
          lowerBound_(renderer_, planned.points.front().settings) {
        group_.scene = planned.scene;
        group_.lights = planned.lights;
        group_.sizePixels = planned.sizePixels;
        group_.triangles = planned.triangles;
        for (const BenchPoint& point : planned.points)
            timed_.push_back({&rendererOf(point, scene), point.technique, point.settings});
    }

    void run() {
        timeRounds();
        const frame::FrameSettings& settings = planned_.settings;
        const BenchTruth kind = chooseTruth(options_.against, settings, lightsAPixel(), group_.whyTruth);
        group_.truth = kind == BenchTruth::Reference ? "reference" : "forward";
        const GroupTruth truth(renderer_, kind, settings, options_.errorFilter.value_or(frame::TextureFilter::Exact),
                               [] {});
        options_.progress(kStepsOfTheTruth);
        if (planned_.keepsPictures && options_.keepPicture && group_.pictures.empty())
            group_.pictures.push_back({group_.truth, {}, options_.keepPicture("truth", shown(truth)), "", 0});
        for (std::size_t i = group_.results.size(); i < planned_.points.size(); ++i) {
            group_.results.push_back(resultOf(i, truth));
            options_.progress(kStepsOfAPoint);
            options_.keep(state_);
        }
        group_.attribution = attributeErrors(context_, truth, group_.truth, planned_.points);
        options_.progress(kStepsOfTheCauses);
        state_.isDone = true;
        options_.keep(state_);
    }

private:
    /// The renderer of a point. A renderer keeps one shadow atlas between frames: points with other maps would
    /// overwrite its faces, and their times would depend on each other, so each kind of map has its own renderer. So
    /// does each subsurface diffusion method if the points differ in it; its renderer diffuses in every frame, else the
    /// compared work would be done once before the first one.
    engine::Renderer& rendererOf(const BenchPoint& point, const scenes::Scene& scene) {
        const std::optional<MethodKey>&shadows = point.key.method(MethodKind::Shadows),
              &subsurface = point.key.method(MethodKind::Subsurface);
        const bool diffuses = variesSubsurface_ && subsurface && !subsurface->values.empty();
        const std::string kept = (shadows && usesMaps(*shadows) ? methodText(MethodKind::Shadows, *shadows) : "") +
                                 (diffuses ? "; " + methodText(MethodKind::Subsurface, *subsurface) : "");
        if (kept.empty()) return renderer_;
        std::unique_ptr<engine::Renderer>& renderer = otherRenderers_[kept];
        if (!renderer) {
            renderer = std::make_unique<engine::Renderer>(context_, scene);
            renderer->keepDiffusedLight(!diffuses);
        }
        return *renderer;
    }

    /// Lights per pixel that the reference evaluates; with subsurface diffusion, at each of its surface points.
    double lightsAPixel() const {
        const bool diffuses = scenes::anyDiffuses(renderer_.scene(), planned_.settings.subsurface);
        return double(planned_.lights) * (diffuses ? double(reference::Settings{}.diffusionPoints) : 1.0);
    }

    void timeRounds() {
        const std::vector<TimedFrame> lowerBoundFrames = lowerBound_.frames();
        const std::size_t kinds = timed_.size() + lowerBoundFrames.size();
        InterleaveOptions interleave;
        interleave.rounds = options_.frames;
        if (!state_.roundsMs.empty() && state_.roundsMs.front().size() != kinds)
            throw InputError(
                fmt::format("{}: the output folder keeps rounds of {} frames, and this run has rounds of {}; "
                            "name another output folder",
                            groupName(group_), state_.roundsMs.front().size(), kinds));
        interleave.earlierMs = state_.roundsMs;
        interleave.measured = [&](std::span<const double> roundMs) {
            state_.roundsMs.emplace_back(roundMs.begin(), roundMs.end());
            options_.keep(state_);
        };
        interleave.progress = [&](int, int) { options_.progress(kinds); };
        timesMs_ = timeInTurn(timed_, lowerBoundFrames, interleave);
        // Finished points keep the lower bound that they were compared with.
        if (group_.results.empty())
            group_.lowerBound =
                lowerBound_.figuresOf({timesMs_.begin() + std::ptrdiff_t(timed_.size()), timesMs_.end()});
    }

    BenchResult resultOf(std::size_t index, const GroupTruth& truth) {
        const BenchPoint& point = planned_.points[index];
        BenchResult result;
        result.key = point.key;
        result.times.cpuMs = spreadOf(timesMs_[index]);
        profilePoint(result.times, timed_[index]);
        countPoint(*timed_[index].renderer, point, result);
        compareWithLowerBound(result);
        result.why.insert(result.times.why.begin(), result.times.why.end());
        const Picture picture = truth.pictureOf(point.technique, point.settings);
        result.error = truth.errorOf(picture, result.why);
        if (planned_.keepsPictures && options_.keepPicture) keepPicture(index, picture, truth);
        return result;
    }

    /// The truth after display mapping. The reference renders no blurred backdrop, so forward's is put behind it: the
    /// images then differ only where they are compared.
    DisplayImage shown(const GroupTruth& truth) const {
        Picture picture = truth.picture();
        if (group_.truth == "reference" && planned_.settings.environment.backdrop == frame::Backdrop::Blurred) {
            const Picture forward = truth.pictureOf(engine::Technique::Forward, planned_.settings);
            for (std::size_t i = 0; i < picture.covered.size(); ++i)
                if (!picture.covered[i]) std::copy_n(forward.pixel(i), 3, &picture.rgba[4 * i]);
        }
        return engine::toDisplayImage(picture, planned_.settings);
    }

    void compareWithLowerBound(BenchResult& result) const {
        const auto compare = [&](std::optional<std::uint64_t> evaluations, const char* evaluationsName,
                                 std::optional<double>& floorMs, const char* lowerBoundName,
                                 std::optional<double>& ratio, const char* ratioName) {
            if (evaluations) floorMs = group_.lowerBound.lowerBoundMs(double(*evaluations));
            if (floorMs)
                ratio = result.times.cpuMs.median / *floorMs;
            else
                result.why[lowerBoundName] = result.why[ratioName] =
                    evaluations ? group_.lowerBound.whyNoStores : result.why[evaluationsName];
        };
        compare(result.counters.neededEvaluations, "neededEvaluations", result.floorMs, "floorMs", result.ratioToFloor,
                "ratioToFloor");
        compare(result.counters.neededLitEvaluations, "neededLitEvaluations", result.floorLitMs, "floorLitMs",
                result.ratioToLitFloor, "ratioToLitFloor");
    }

    /// Keeps the image of a point. Most points of a group render the same image, bit for bit: it is stored once.
    void keepPicture(std::size_t index, const Picture& picture, const GroupTruth& truth) {
        const BenchPoint& point = planned_.points[index];
        const std::string name = pointName(point.key);
        const std::uint64_t hash = hashOf(picture);
        for (std::size_t i = 1; i < group_.pictures.size(); ++i) {
            if (group_.pictures[i].hash != hash) continue;
            group_.pictures[i].points.push_back(name);
            return;
        }
        const std::string number = fmt::format("{:03}", index);
        const Picture right = truth.pictureFor(picture);
        std::string map;
        if (!showsNoError(radianceFigures(picture, right, truth.excluded())))
            map = options_.keepPicture(
                number + "-error",
                errorHeatMap(picture, right, fmt::format("{} vs {}", name, group_.truth), truth.excluded()));
        group_.pictures.push_back(
            {name, {name}, options_.keepPicture(number, engine::toDisplayImage(picture, point.settings)), map, hash});
    }

    gpu::Context& context_;
    const PlannedGroup& planned_;
    const BenchOptions& options_;
    GroupState& state_;
    BenchGroup& group_;
    engine::Renderer renderer_;
    bool variesSubsurface_ = false;
    std::map<std::string, std::unique_ptr<engine::Renderer>> otherRenderers_; ///< by shadow maps and diffusion method
    LowerBoundBench lowerBound_;
    std::vector<TimedPoint> timed_;
    std::vector<std::vector<double>> timesMs_; ///< by kind of frame
};

} // namespace

std::size_t stepsOf(const gpu::Capabilities& gl, const PlannedGroup& group, const GroupState& state,
                    const BenchOptions& options) {
    if (state.isDone) return 0;
    const std::size_t kinds = group.points.size() + LowerBoundBench::kindsOf(lightStores(gl));
    const int left = options.frames - int(state.roundsMs.size());
    const std::size_t rounds = left > 0 ? std::size_t(left + InterleaveOptions{}.warmUpRounds) : 0;
    return rounds * kinds + kStepsOfTheTruth + kStepsOfTheCauses +
           (group.points.size() - std::min(group.points.size(), state.group.results.size())) * kStepsOfAPoint;
}

void measureGroup(gpu::Context& context, const scenes::Scene& scene, const PlannedGroup& group,
                  const BenchOptions& options, GroupState& state) {
    if (!state.isDone) Measurement(context, scene, group, options, state).run();
}

} // namespace tessera::validation
