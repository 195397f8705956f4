#include "validation/figures/Flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <tbb/parallel_invoke.h>

#include "base/Srgb.h"
#include "validation/figures/FlipColour.h"
#include "validation/figures/FlipFilters.h"

namespace tessera::validation {

namespace {

// Andersson et al. 2020, sections 4.1 and 4.2: exponents that compress large colour and feature differences, and the
// fraction pc of the largest colour difference that is mapped to 0 .. pt.
constexpr double kColourExponent = 0.7;
constexpr double kFeatureExponent = 0.5;
constexpr double kColourKnee = 0.4;
constexpr double kKneeError = 0.95;

/// Colours and features of an image as perceived.
struct Seen {
    std::vector<glm::dvec3> colours; ///< huntLabFromLinear() of the filtered image
    Features features;
};

std::array<Plane, 3> opponentPlanes(const DisplayImage& image) {
    std::array<double, 256> linear;
    for (int code = 0; code < 256; ++code) linear[std::size_t(code)] = linearFromSrgb(code / 255.0);
    const Plane empty(image.width, image.height);
    std::array<Plane, 3> planes{empty, empty, empty};
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const std::uint8_t* rgb = &image.rgb[3 * i];
        const glm::dvec3 opponent = opponentFromLinear({linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]});
        for (int c = 0; c < 3; ++c) planes[std::size_t(c)].values[i] = float(opponent[c]);
    }
    return planes;
}

Seen seenPicture(const DisplayImage& image, double pixelsPerDegree) {
    const std::array<Plane, 3> planes = opponentPlanes(image);
    const Plane y = seenBy(kAchromatic, planes[0], pixelsPerDegree);
    const Plane cx = seenBy(kRedGreen, planes[1], pixelsPerDegree);
    const Plane cz = seenBy(kBlueYellow, planes[2], pixelsPerDegree);
    std::vector<glm::dvec3> colours(image.pixelCount());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const glm::dvec3 linear = linearFromOpponent({y.values[i], cx.values[i], cz.values[i]});
        colours[i] = huntLabFromLinear(glm::clamp(linear, 0.0, 1.0));
    }
    Plane lightness = planes[0];
    for (float& value : lightness.values) value = (value + 16.0f) / 116.0f;
    return {std::move(colours), featuresOf(lightness, pixelsPerDegree)};
}

/// 0..1. The largest possible difference is that of pure green and pure blue.
double colourError(const glm::dvec3& a, const glm::dvec3& b) {
    static const double kLargest =
        std::pow(hyab(huntLabFromLinear({0.0, 1.0, 0.0}), huntLabFromLinear({0.0, 0.0, 1.0})), kColourExponent);
    const double knee = kColourKnee * kLargest;
    const double difference = std::pow(hyab(a, b), kColourExponent);
    if (difference < knee) return kKneeError / knee * difference;
    return std::min(kKneeError + (difference - knee) / (kLargest - knee) * (1.0 - kKneeError), 1.0);
}

/// 0..1.
double featureError(const Features& a, const Features& b, std::size_t pixel) {
    const double edge = std::abs(double(a.edges.values[pixel]) - double(b.edges.values[pixel]));
    const double point = std::abs(double(a.points.values[pixel]) - double(b.points.values[pixel]));
    // A gradient is at most sqrt(2) long: 1 in each direction.
    return std::pow(std::min(std::max(edge, point) / std::numbers::sqrt2, 1.0), kFeatureExponent);
}

} // namespace

std::vector<float> flipErrors(const DisplayImage& a, const DisplayImage& b, double pixelsPerDegree) {
    assert(a.isConsistent() && b.isConsistent() && a.width == b.width && a.height == b.height);
    std::vector<float> errors(a.pixelCount());
    if (a.rgb == b.rgb) return errors;
    Seen seenA, seenB;
    tbb::parallel_invoke([&] { seenA = seenPicture(a, pixelsPerDegree); },
                         [&] { seenB = seenPicture(b, pixelsPerDegree); });
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double colour = colourError(seenA.colours[i], seenB.colours[i]);
        errors[i] = float(std::pow(colour, 1.0 - featureError(seenA.features, seenB.features, i)));
    }
    return errors;
}

} // namespace tessera::validation
