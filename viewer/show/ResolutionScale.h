#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace tessera::viewer {

/// Scales of images drawn while something moves: sides relative to the full-resolution image.
inline constexpr std::array kScales{1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};

/// Chooses the resolution while something moves, so that each image is drawn within a target time; idle images have
/// full resolution. Estimates the fixed cost of a frame (geometry and the like) and the cost per pixel from measured
/// times.
class ResolutionScale {
public:
    explicit ResolutionScale(double targetMs) : targetMs_(targetMs) {}

    /// Scale of the next image while something moves, one of kScales. If no scale meets the target, one below which
    /// hardly anything would be gained.
    double next() const { return scale_; }
    /// Records the time of an image. The caller must exclude compiling shaders.
    void drew(double scale, double ms);
    /// Predicted time of an image at one of kScales.
    double predictedMs(double scale) const;
    /// Forgets all costs, for another technique, scene or the like. `guess` is the initial scale.
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
        double leastMs = 0.0; ///< the shortest
        int count = 0;        ///< images at this scale
        int age = 0;          ///< images since the latest of them
    };
    std::array<std::optional<Sample>, kScales.size()> samples_; ///< by scale
};

} // namespace tessera::viewer
