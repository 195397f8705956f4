#pragma once

namespace tessera::viewer {

/// Chooses how many pixels pictures have while something moves, so that each is drawn within a target time; at rest the
/// picture is drawn whole. It knows of a frame what the latest one took: a fixed share for geometry, the rest by pixel.
class ResolutionScale {
public:
    explicit ResolutionScale(double targetMs) : targetMs_(targetMs) {}

    /// Side of the next moving picture as a share of the whole one's, one of a few steps from 1 down to 1/16.
    double next() const { return scale_; }
    /// A picture of this scale took so long. What was spent on compiling shaders is to be left out by the caller.
    void drew(double scale, double ms);
    /// Another technique, scene or the like: nothing is known of its cost but by `guess`, a scale to begin with.
    void restart(double guess);

private:
    double targetMs_;
    double scale_ = 1.0;
    int quickFrames_ = 0; ///< in a row that would allow a larger scale
};

} // namespace tessera::viewer
