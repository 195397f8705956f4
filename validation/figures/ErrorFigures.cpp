#include "validation/figures/ErrorFigures.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/Rendering.h"
#include "validation/figures/Flip.h"
#include "validation/figures/Percentile.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

struct Kinds {
    bool nan = false, infinite = false, negative = false;
    Kinds operator|(Kinds other) const {
        return {nan || other.nan, infinite || other.infinite, negative || other.negative};
    }
};

Kinds kindsOf(const float* rgb) {
    Kinds kinds;
    for (int c = 0; c < 3; ++c) {
        kinds.nan |= std::isnan(rgb[c]);
        kinds.infinite |= std::isinf(rgb[c]);
        kinds.negative |= rgb[c] < 0.f;
    }
    return kinds;
}

void count(BadPixels& bad, Kinds kinds) {
    bad.nan += kinds.nan;
    bad.infinite += kinds.infinite;
    bad.negative += kinds.negative;
}

bool hasEqualBits(const float* a, const float* b) {
    for (int c = 0; c < 3; ++c) {
        const bool areZeros = a[c] == 0.f && b[c] == 0.f;
        if (!areZeros && std::bit_cast<std::uint32_t>(a[c]) != std::bit_cast<std::uint32_t>(b[c])) return false;
    }
    return true;
}

/// Mean magnitude of luminance over the finite pixels, and the fraction of all pixels with more than the threshold.
struct Signal {
    double meanLuminance = kNotMeasured;
    double litShare = 0.0;
};

Signal signalOf(const Picture& picture, double litThreshold) {
    double sum = 0.0;
    std::size_t finite = 0, lit = 0;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        if (!isFinite(picture.pixel(i))) continue;
        const double value = std::abs(luminance(picture.pixel(i)));
        sum += value;
        ++finite;
        lit += value > litThreshold; // false for every pixel if the threshold is NaN
    }
    return {finite > 0 ? sum / double(finite) : kNotMeasured, double(lit) / double(picture.pixelCount())};
}

/// The figures that are sums or maxima over the compared pixels.
void addDifferences(RadianceFigures& figures, const Picture& a, const Picture& b, const PixelErrors& errors) {
    const double floorOfSquare = 1e-2 * errors.typicalLuminance * errors.typicalLuminance;
    double squares = 0.0, relSquares = 0.0, luminanceA = 0.0, luminanceB = 0.0, luminanceSquares = 0.0;
    double maxAbs = 0.0, maxRel = 0.0;
    std::vector<double> rels;
    rels.reserve(errors.rel.size());
    for (std::size_t i = 0; i < errors.rel.size(); ++i) {
        if (errors.state[i] != PixelState::Compared) continue;
        const float* valueA = a.pixel(i);
        const float* valueB = b.pixel(i);
        for (int c = 0; c < 3; ++c) {
            const double truth = double(valueB[c]);
            const double difference = double(valueA[c]) - truth;
            maxAbs = std::max(maxAbs, std::abs(difference));
            squares += difference * difference;
            relSquares += difference * difference / (truth * truth + floorOfSquare);
        }
        if (errors.rel[i] > maxRel) {
            maxRel = errors.rel[i];
            figures.worstX = i % std::size_t(a.width);
            figures.worstY = i / std::size_t(a.width);
        }
        luminanceA += luminance(valueA);
        luminanceB += luminance(valueB);
        luminanceSquares += std::pow(luminance(valueA) - luminance(valueB), 2.0);
        figures.litCoveredA += std::abs(luminance(valueA)) > errors.litThreshold;
        figures.litCovered += std::abs(luminance(valueB)) > errors.litThreshold;
        rels.push_back(errors.rel[i]);
    }

    figures.compared = rels.size();
    const bool any = !rels.empty();
    const double values = 3.0 * double(rels.size());
    figures.maxAbs = any ? maxAbs : kNotMeasured;
    figures.maxRel = any ? maxRel : kNotMeasured;
    figures.rmse = any ? std::sqrt(squares / values) : kNotMeasured;
    figures.relMse = any ? relSquares / values : kNotMeasured;
    figures.p50Rel = nearestRank(rels, 500);
    figures.p99Rel = nearestRank(rels, 990);
    figures.p999Rel = nearestRank(rels, 999);
    figures.bias = luminanceB != 0.0 ? (luminanceA - luminanceB) / luminanceB : kNotMeasured;
    figures.biasNoise = luminanceB != 0.0 ? std::sqrt(luminanceSquares) / std::abs(luminanceB) : kNotMeasured;
}

RadianceFigures figuresOf(const Picture& a, const Picture& b, const PixelErrors& errors) {
    RadianceFigures figures;
    std::size_t excludedPixels = 0, equalPixels = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        const Kinds kindsA = kindsOf(a.pixel(i)), kindsB = kindsOf(b.pixel(i));
        const PixelState state = errors.state[i];
        excludedPixels += state == PixelState::Excluded;
        if (state == PixelState::Excluded || state == PixelState::Uncovered) {
            count(figures.badOutside, kindsA | kindsB);
            continue;
        }
        ++figures.covered;
        equalPixels += hasEqualBits(a.pixel(i), b.pixel(i));
        count(figures.bad, kindsA | kindsB);
        count(figures.badA, kindsA);
        count(figures.badB, kindsB);
    }
    figures.bitEqual = figures.covered > 0 ? double(equalPixels) / double(figures.covered) : kNotMeasured;
    const std::size_t drawn = figures.covered + excludedPixels;
    figures.excluded = drawn > 0 ? double(excludedPixels) / double(drawn) : 0.0;
    figures.typicalLuminance = errors.typicalLuminance;
    addDifferences(figures, a, b, errors);

    const Signal signalA = signalOf(a, errors.litThreshold), signalB = signalOf(b, errors.litThreshold);
    figures.meanLuminance = signalB.meanLuminance;
    figures.litShare = signalB.litShare;
    figures.meanLuminanceA = signalA.meanLuminance;
    return figures;
}

} // namespace

RadianceFigures radianceFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded) {
    return figuresOf(a, b, pixelErrors(a, b, excluded));
}

ErrorFigures errorFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded,
                          const ShownPair& shown) {
    const PixelErrors errors = pixelErrors(a, b, excluded);
    return {figuresOf(a, b, errors), shown.a && shown.b
                                         ? displayFigures(*shown.a, *shown.b, errors.state)
                                         : displayFigures(toDisplayImage(a), toDisplayImage(b), errors.state)};
}

void requireSameSize(const Picture& a, const std::string& nameA, const Picture& b, const std::string& nameB) {
    if (a.width == b.width && a.height == b.height) return;
    throw InputError(fmt::format("{} is {}x{} but {} is {}x{}; pictures that are compared must be of one size", nameA,
                                 a.width, a.height, nameB, b.width, b.height));
}

DisplayFigures displayFigures(const DisplayImage& a, const DisplayImage& b, std::span<const PixelState> state) {
    assert(state.size() == a.pixelCount() && state.size() == b.pixelCount());
    DisplayFigures figures;
    const auto compared = double(std::count(state.begin(), state.end(), PixelState::Compared));
    if (compared == 0.0) {
        figures.psnrReason = figures.flipReason = "no pixel could be compared";
        return figures;
    }
    const std::vector<float> errors = flipErrors(a, b);
    double squares = 0.0, flip = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (state[i] != PixelState::Compared) continue;
        flip += double(errors[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference = double(a.rgb[3 * i + c]) - double(b.rgb[3 * i + c]);
            squares += difference * difference;
        }
    }
    figures.flip = flip / compared;
    if (squares == 0.0)
        figures.psnrReason = "infinite: the pictures are identical on an 8 bit display";
    else
        figures.psnr = 10.0 * std::log10(255.0 * 255.0 / (squares / (3.0 * compared)));
    return figures;
}

} // namespace tessera::validation
