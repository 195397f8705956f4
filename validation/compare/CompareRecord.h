#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/figures/ErrorFigures.h"
#include "validation/figures/LostGeometry.h"
#include "validation/figures/ShadowFigures.h"
#include "validation/figures/Tolerance.h"

namespace tessera::validation {

/// The error that the encoding of a G-buffer channel, or of two coupled ones, adds to a pair.
struct ChannelShare {
    std::string channel;  ///< "albedo", "microsurface and tangent"
    double relMseWithout; ///< the pair's relMse when this alone is stored in fp32
    double share;         ///< the pair's relMse minus relMseWithout
};

/// Subsurface diffusion in the reference, as means over the pixels that show it. Images with diffusion along the
/// surface must differ from it where these figures deviate from a plane's.
struct DiffusedLight {
    std::size_t pixels = 0;
    double integral = 1.0;   ///< integral of the profile over the surface, by which the reference divides; 1 on a plane
    double facingAway = 0.0; ///< fraction of it where the surface faces away, as across thin parts
};

/// One comparison: picture a against the truth b.
struct ComparePair {
    std::string a, b; ///< technique names, "reference", or a picture's file name
    ErrorFigures figures;
    Tolerance tolerance;
    Verdict verdict;
    std::vector<ChannelShare> channels = {};   ///< empty where no channel is packed
    std::string culling = {};                  ///< culling method of a; empty if it visits all lights
    std::optional<ShadowFigures> shadows = {}; ///< against the reference, for traced shadows
};

/// A technique that was not compared.
struct LeftOutTechnique {
    std::string technique;
    std::string why;
};

/// The light that a range tolerance drops: a technique's picture with it against the same without.
struct RangeTruncation {
    double tolerance; ///< FrameSettings::rangeTolerance
    std::string technique;
    ErrorFigures figures; ///< of the final view, whatever view is compared
};

/// The results of `tessera compare`.
struct CompareRecord {
    std::string scene;
    int width = 0, height = 0;
    std::string renderer; ///< as GL reports it
    std::vector<ComparePair> pairs;
    int samples = 1;                     ///< per pixel, as the driver provides them
    bool excludesPixels = false;         ///< pixels that show different triangles were left out
    std::vector<LostGeometry> lost = {}; ///< differences that rounding does not explain, with either filter
    std::vector<LeftOutTechnique> leftOut = {};
    std::optional<RangeTruncation> rangeTruncation = {}; ///< where a tolerance is set
    std::optional<DiffusedLight> diffusedLight = {};     ///< against the reference, if light is diffused

    /// Whether there is a pair and every verdict is ok. Without a tolerance only the requirements of all pairs count.
    bool ok() const;
};

/// Measures and judges one pair. `excluded` and `shown` are as errorFigures() takes them.
ComparePair comparePair(std::string nameA, const Picture& a, std::string nameB, const Picture& b, Tolerance tolerance,
                        std::span<const std::uint8_t> excluded = {}, const ShownPair& shown = {});

/// Makes a verdict fail if geometry was lost, and names it.
void missLostGeometry(Verdict& verdict, std::span<const LostGeometry> lost);

/// The record as JSON, schema 1, indented and ending in a newline. Figures that could not be measured or are infinite
/// are null, with the reason under `why`, and so is `ok` of a pair that is not judged; `missed` names in words the
/// tolerances that a pair missed.
std::string compareJson(const CompareRecord& record);

/// The record for a terminal: a table of ASCII characters, then what was missed and what was dropped, each line ending
/// in a newline.
std::string compareTable(const CompareRecord& record);

/// What was dropped, in one line: "bias -1.2e-03, relMSE 3.4e-05, p99 rel 2.0e-02".
std::string droppedText(const ErrorFigures& figures);

} // namespace tessera::validation
