#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/lower_bound/LowerBoundGeometry.h"
#include "validation/lower_bound/LowerBoundLighting.h"
#include "validation/timing/Interleave.h"

namespace tessera::validation {

/// A measured lower bound of the time of a scene's frame: lowerBoundMs = R + E r.
struct LowerBoundFigures {
    struct Store {
        std::string_view name;
        double nsPerPair = 0.0;    ///< nanoseconds per pair of a pixel and a light that reaches it, median over rounds
        double nsPerPairP95 = 0.0; ///< the same, 95th percentile
    };
    double geometryMs = 0.0;   ///< R: all geometry, depth-tested, into one constant target, median over rounds
    std::vector<Store> stores; ///< r by light store; empty if the scene lights nothing, or if it could not be measured
    std::string whyNoStores;
    double geometryMsP95 = 0.0;
    int rounds = 0; ///< that the medians are of

    /// r, the store with the smallest; none where there is none.
    std::optional<Store> fastestStore() const;
    /// `evaluations`: pairs of a covered pixel and a light that reaches it (E), or of those the ones whose light lies
    /// in front of the surface. None where these cannot be priced.
    std::optional<double> lowerBoundMs(double evaluations) const;
};

/// Measures the lower bound for a scene with a renderer's settings of camera, size, filter, specular and pruning,
/// regardless of culling and debug view. Its frames run in turn with the frames that are compared with it (timeFrames).
///
/// r is the slope of the time between 32 and 96 lights per pixel, so that the rest of the shader's cost cancels:
/// rounds of both follow each other.
class LowerBoundBench {
public:
    static constexpr int kFewLights = 32;
    static constexpr int kManyLights = 96;
    /// The least number of rounds for a bound's medians, even if fewer frames of the points are requested.
    static constexpr int kLeastRounds = 5;

    /// The renderer must outlive the object. Throws InputError as Renderer::draw does.
    LowerBoundBench(engine::Renderer& renderer, const frame::FrameSettings& settings);

    /// The number of kinds of frame for the bound of a lit scene: the geometry, and two numbers of lights in each
    /// store.
    static std::size_t kindsOf(std::span<const LightStoreInfo> stores);

    /// The frames to time; they refer to the object.
    std::vector<TimedFrame> frames();
    /// `timesMs`: one time per round of each of frames(). With fewer than kLeastRounds of them, the others are timed
    /// now.
    LowerBoundFigures figuresOf(std::vector<std::vector<double>> timesMs);
    /// The same of the times alone.
    LowerBoundFigures figures(std::span<const std::vector<double>> timesMs) const;

    LowerBoundFigures measure(const InterleaveOptions& options = {});

private:
    glm::ivec2 sizePixels_;
    std::span<const LightStoreInfo> stores_;
    LowerBoundGeometry geometry_;
    std::optional<LowerBoundLighting> lighting_; ///< where anything is lit
    frame::PackedLights few_, many_;
};

} // namespace tessera::validation
