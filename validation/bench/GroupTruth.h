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

/// What errors are measured against: the double-precision renderer, or the technique forward with every fp32 channel,
/// no range tolerance and traced shadows.
enum class BenchTruth : std::uint8_t { Reference, Forward };

/// Pairs of a point and a light beyond which the reference takes minutes, not seconds: on 2 cores it does some 10^7 a
/// second.
inline constexpr double kAffordablePairs = 1.5e9;

/// What was asked for; else the reference where it takes one sample of the final view and is affordable. `why` says why
/// it is not, and is empty where it is.
BenchTruth chooseTruth(std::optional<BenchTruth> asked, const frame::FrameSettings& settings, double lightsAPixel,
                       std::string& why);

/// Settings with every fp32 channel, every light, no range tolerance, traced shadows and this filter: what the truth is
/// made with, and what one cause of error at a time is put into.
frame::FrameSettings exactSettings(frame::FrameSettings settings, frame::TextureFilter filter);

/// Rays of forward, where it is the truth, to a light with a size. Their noise is a quarter of that of 16 rays or less:
/// the root mean square of a share's error is 0.003 in a penumbra.
inline constexpr int kTruthShadowSamples = 256;

/// The truth of one group, made once, and points held against it.
class GroupTruth {
public:
    /// `settings` are those of the group, whose lights cast the truth's shadows. Errors are of frames with `filter`,
    /// the reference's picture too; the noise of rays is an error. `rowDone` as referencePicture().
    GroupTruth(engine::Renderer& renderer, BenchTruth truth, const frame::FrameSettings& settings,
               frame::TextureFilter filter, const std::function<void()>& rowDone);

    /// The point's picture, as it is compared.
    Picture pictureOf(engine::Technique technique, const frame::FrameSettings& settings) const;
    /// Its error; what could not be measured is none with the reason in `why` under "error.<figure>".
    BenchError errorOf(const Picture& picture, std::map<std::string, std::string>& why) const;

    /// exactSettings() of the group, with rays enough for a truth.
    const frame::FrameSettings& settings() const { return settings_; }
    const Picture& picture() const { return picture_; }
    /// Of the pictures that the truth allows the one nearest to `shown`.
    Picture pictureFor(const Picture& shown) const;
    /// The truth of another scene or other settings that show the same triangles: of the pictures that it allows the
    /// one nearest to `shown`.
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
