#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace tessera::viewer {

/// Sides of moving pictures as shares of the whole one's.
inline constexpr std::array kScales{1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};

/// Chooses how many pixels pictures have while something moves, so that each is drawn within a target time; at rest the
/// picture is drawn whole. It estimates the fixed cost of a frame (geometry and the like) and the cost of a pixel from
/// the times of pictures.
class ResolutionScale {
public:
    explicit ResolutionScale(double targetMs) : targetMs_(targetMs) {}

    /// Side of the next moving picture, one of kScales. Where no scale meets the target, one below which hardly
    /// anything would be gained.
    double next() const { return scale_; }
    /// A picture took so long. What was spent on compiling shaders is to be left out by the caller.
    void drew(double scale, double ms);
    /// What a picture at one of kScales would take.
    double predictedMs(double scale) const;
    /// Another technique, scene or the like: nothing is known of its cost but `guess`, a scale to begin with.
    void restart(double guess);

private:
    /// frameMs + wholeMs x scale^2.
    struct Cost {
        double frameMs = 0.0;
        double wholeMs = 0.0;
    };
    Cost cost() const;
    double predictedMsOf(std::size_t step) const;

    double targetMs_;
    double scale_ = kScales.front();
    struct Sample {
        double ms = 0.0;      ///< smoothed
        double leastMs = 0.0; ///< of any
        int count = 0;        ///< pictures that were so large
        int age = 0;          ///< pictures since
    };
    std::array<std::optional<Sample>, kScales.size()> samples_; ///< by scale
};

} // namespace tessera::viewer
