#include "validation/figures/ShadowFigures.h"

#include <cmath>

#include <fmt/format.h>

#include "validation/figures/FigureText.h"

namespace tessera::validation {

namespace {

constexpr double kMostUndecidedShare = 0.05;
constexpr double kReferenceBias = 1e-3;

} // namespace

std::vector<std::string> missedByShadows(const ShadowFigures& figures, const std::string& longest) {
    std::vector<std::string> missed;
    if (figures.undecided > kMostUndecidedShare)
        missed.push_back(
            fmt::format("rounding decides the shadows of {:.3g} % of the pixels, at most 5 % may be so; a triangle or "
                        "light far longer or farther away than others takes their digits{}",
                        100.0 * figures.undecided, longest.empty() ? "" : ", farthest " + longest));
    if (!figures.mostNoise) return missed;
    if (!(figures.noise <= *figures.mostNoise))
        missed.push_back(fmt::format("soft shadows have {:.3g} times the noise of independent rays, at most {:.3g} is "
                                     "required",
                                     figures.noise, *figures.mostNoise));
    const double mostBias = kReferenceBias + kShadowNoises * figures.biasNoise;
    if (!(std::abs(figures.bias) <= mostBias))
        missed.push_back(fmt::format("bias (magnitude) of soft shadows is {:.3g}, at most {:.3g} is required",
                                     std::abs(figures.bias), mostBias));
    return missed;
}

std::string shadowText(const ShadowFigures& figures) {
    std::string text =
        fmt::format("{} of the pixels are undecided, where rounding hides a light", shareText(figures.undecided));
    if (figures.noisyPixels > 0)
        text += fmt::format("; {} see part of one, with {:.2g} times the noise of independent rays{}, bias {}; the "
                            "reference's own error is "
                            "{:.2g} of that",
                            figures.noisyPixels, figures.noise,
                            figures.mostNoise ? "" : " (other errors included, so not judged)",
                            figureText(figures.bias), figures.ofReference);
    return text;
}

} // namespace tessera::validation
