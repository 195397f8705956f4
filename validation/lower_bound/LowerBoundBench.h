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

/// A measured lower bound of a scene's frame time: lowerBoundMs = R + E r.
struct LowerBoundFigures {
    struct Store {
        std::string_view name;
        double nsPerPair = 0.0;    ///< nanoseconds per pair of a pixel and a light that reaches it, median over rounds
        double nsPerPairP95 = 0.0; ///< the same, 95th percentile
    };
    double geometryMs = 0.0;   ///< R: all geometry, depth-tested, into one constant target, median over rounds
    std::vector<Store> stores; ///< r by light store; empty if nothing is lit, or r could not be measured
    std::string whyNoStores;
    double geometryMsP95 = 0.0;
    int rounds = 0; ///< number of rounds behind the medians

    /// The store with the smallest r; empty if there is none.
    std::optional<Store> fastestStore() const;
    /// `evaluations` (E): pairs of a covered pixel and a light that reaches it, or only those whose light lies in front
    /// of the surface. Empty if there is no r for them.
    std::optional<double> lowerBoundMs(double evaluations) const;
};

/// Measures the lower bound of a scene for a renderer's camera, size, filter, specular and pruning settings; ignores
/// culling and debug view. Its frames take turns with the frames that are compared with it (timeFrames).
///
/// r is the slope of the time between 32 and 96 lights per pixel, so that the shader's other costs cancel. Rounds of
/// both alternate.
class LowerBoundBench {
public:
    static constexpr int kFewLights = 32;
    static constexpr int kManyLights = 96;
    /// The least number of rounds for a bound's medians, even if fewer frames of the timed points are requested.
    static constexpr int kLeastRounds = 5;

    /// The renderer must outlive the object. Throws InputError as Renderer::draw does.
    LowerBoundBench(engine::Renderer& renderer, const frame::FrameSettings& settings);

    /// The number of frame kinds for the bound of a lit scene: the geometry, and two light counts per store.
    static std::size_t kindsOf(std::span<const LightStoreInfo> stores);

    /// The frames to time; they refer to the object.
    std::vector<TimedFrame> frames();
    /// `timesMs`: per frame of frames(), one time per round. Times further rounds if there are fewer than kLeastRounds.
    LowerBoundFigures figuresOf(std::vector<std::vector<double>> timesMs);
    /// As figuresOf(), without timing further rounds.
    LowerBoundFigures figures(std::span<const std::vector<double>> timesMs) const;

    LowerBoundFigures measure(const InterleaveOptions& options = {});

private:
    glm::ivec2 sizePixels_;
    std::span<const LightStoreInfo> stores_;
    LowerBoundGeometry geometry_;
    std::optional<LowerBoundLighting> lighting_; ///< empty if nothing is lit
    frame::PackedLights few_, many_;
};

} // namespace tessera::validation
