#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/Picture.h"
#include "engine/Renderer.h"
#include "validation/bench/BenchResult.h"
#include "validation/compare/ReferencePicture.h"

namespace tessera::validation {

/// The truth for errors: the double-precision renderer, or the technique forward with every channel in fp32, no range
/// tolerance and traced shadows.
enum class BenchTruth : std::uint8_t { Reference, Forward };

/// Number of point-light pairs above which the reference takes minutes, not seconds: 2 cores do some 10^7 per second.
inline constexpr double kAffordablePairs = 1.5e9;

/// The requested truth; else the reference if the view is final and the cost affordable. `why` is the reason for not
/// choosing the reference, else empty.
BenchTruth chooseTruth(std::optional<BenchTruth> requested, const frame::FrameSettings& settings, double lightsAPixel,
                       std::string& why);

/// Settings of the truth: every channel in fp32, every light, no range tolerance, traced shadows and this filter.
/// Attribution enables one cause of error at a time in them.
frame::FrameSettings exactSettings(frame::FrameSettings settings, frame::TextureFilter filter);

/// Minimum rays per light with a size where forward is the truth. Their noise is at most a quarter of that of 16 rays:
/// the RMS error of a light's visible fraction is 0.003 in a penumbra.
inline constexpr int kTruthShadowSamples = 256;

/// The truth of one group, rendered once, and the errors of points against it.
class GroupTruth {
public:
    /// `settings` are the group's, including the lights that cast the truth's shadows. Points and truth are both
    /// rendered with `filter`; the noise of rays counts as error. `rowDone` as in referencePicture().
    GroupTruth(engine::Renderer& renderer, BenchTruth truth, const frame::FrameSettings& settings,
               frame::TextureFilter filter, const std::function<void()>& rowDone);

    /// Renders a point for comparison: with the truth's filter, without display mapping.
    Picture pictureOf(engine::Technique technique, const frame::FrameSettings& settings) const;
    /// The error of an image. Figures that could not be measured are unset, with the reason in `why` under
    /// "error.<figure>".
    BenchError errorOf(const Picture& picture, std::map<std::string, std::string>& why) const;

    /// exactSettings() of the group, with at least kTruthShadowSamples rays.
    const frame::FrameSettings& settings() const { return settings_; }
    const Picture& picture() const { return picture_; }
    /// The image nearest to `shown` among those that the truth allows.
    Picture pictureFor(const Picture& shown) const;
    /// The same, for the truth of another scene or other settings that show the same triangles.
    Picture pictureOn(engine::Renderer& renderer, const frame::FrameSettings& settings, const Picture& shown) const;
    const std::vector<std::uint8_t>& excluded() const { return excluded_; }
    frame::TextureFilter filter() const { return filter_; }
    engine::Renderer& renderer() const { return renderer_; }

private:
    engine::Renderer& renderer_;
    frame::TextureFilter filter_;
    frame::FrameSettings settings_;
    Picture picture_;
    std::optional<ReferencePicture> reference_;
    std::vector<std::uint8_t> excluded_;
};

} // namespace tessera::validation
