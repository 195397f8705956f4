#include "validation/figures/FlipFilters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::validation {

namespace {

using std::numbers::pi;
/// The widest Gaussian of all channels, whose radius is used for all of them.
constexpr double kWidestB = 0.04;
/// Width of the feature detector in degrees. Source: Andersson et al. 2020, section 4.2.
constexpr double kFeatureDegrees = 0.082;

template <class Weight>
Kernel kernelOf(int radius, Weight weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(float(weight(double(i))));
    return kernel;
}

double sumOf(const Kernel& kernel) {
    double sum = 0.0;
    for (const float weight : kernel) sum += double(weight);
    return sum;
}

/// Scales positive weights to a sum of 1 and negative ones to -1, so that a step or a dot of height 1 gives about 1.
void normaliseSides(Kernel& kernel) {
    double positive = 0.0, negative = 0.0;
    for (const float weight : kernel) (weight > 0.0f ? positive : negative) += double(weight);
    for (float& weight : kernel) weight = float(double(weight) / (weight > 0.0f ? positive : -negative));
}

Plane alongRows(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = int(kernel.size()) / 2;
    std::vector<float> padded(std::size_t(plane.width) + 2 * std::size_t(radius));
    for (int y = 0; y < plane.height; ++y) {
        const float* row = &plane.values[std::size_t(y) * std::size_t(plane.width)];
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, plane.width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, row[plane.width - 1]);
        float* sums = &result.values[std::size_t(y) * std::size_t(plane.width)];
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const float weight = kernel[k];
            const float* from = &padded[k];
            for (int x = 0; x < plane.width; ++x) sums[x] += weight * from[x];
        }
    }
    return result;
}

Plane alongColumns(const Plane& plane, const Kernel& kernel) {
    Plane result(plane.width, plane.height);
    const int radius = int(kernel.size()) / 2;
    for (int y = 0; y < plane.height; ++y) {
        float* sums = &result.values[std::size_t(y) * std::size_t(plane.width)];
        for (int k = -radius; k <= radius; ++k) {
            const float weight = kernel[std::size_t(k + radius)];
            const int from = std::clamp(y + k, 0, plane.height - 1);
            const float* row = &plane.values[std::size_t(from) * std::size_t(plane.width)];
            for (int x = 0; x < plane.width; ++x) sums[x] += weight * row[x];
        }
    }
    return result;
}

Plane lengths(const Plane& x, const Plane& y) {
    Plane result(x.width, x.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = std::hypot(x.values[i], y.values[i]);
    return result;
}

} // namespace

Plane filtered(const Plane& plane, const Kernel& alongRow, const Kernel& alongColumn) {
    return alongColumns(alongRows(plane, alongRow), alongColumn);
}

Plane seenBy(const ContrastSensitivity& eye, const Plane& channel, double pixelsPerDegree) {
    const int radius = int(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * pi * pi)) * pixelsPerDegree));
    const auto gaussian = [&](double b) {
        return kernelOf(radius, [&](double pixels) {
            const double degrees = pixels / pixelsPerDegree;
            return std::exp(-pi * pi * degrees * degrees / b);
        });
    };
    const Kernel first = gaussian(eye.b1), second = gaussian(eye.b2);
    // Weight of each 2D product kernel, whose sum is the square of the 1D sum.
    const double weight1 = eye.a1 * std::sqrt(pi / eye.b1), weight2 = eye.a2 * std::sqrt(pi / eye.b2);
    const double sum1 = sumOf(first), sum2 = sumOf(second);
    const double whole = weight1 * sum1 * sum1 + weight2 * sum2 * sum2;
    Plane seen = filtered(channel, first, first);
    for (float& value : seen.values) value = float(double(value) * weight1 / whole);
    if (eye.a2 == 0.0) return seen;
    const Plane more = filtered(channel, second, second);
    for (std::size_t i = 0; i < seen.values.size(); ++i)
        seen.values[i] += float(double(more.values[i]) * weight2 / whole);
    return seen;
}

Features featuresOf(const Plane& lightness, double pixelsPerDegree) {
    const double deviation = 0.5 * kFeatureDegrees * pixelsPerDegree;
    const int radius = int(std::ceil(3.0 * deviation));
    const auto bell = [&](double x) { return std::exp(-x * x / (2.0 * deviation * deviation)); };
    Kernel smooth = kernelOf(radius, bell);
    const double sum = sumOf(smooth);
    for (float& weight : smooth) weight = float(double(weight) / sum);
    Kernel slope = kernelOf(radius, [&](double x) { return -x * bell(x); });
    Kernel curvature = kernelOf(radius, [&](double x) { return (x * x / (deviation * deviation) - 1.0) * bell(x); });
    normaliseSides(slope);
    normaliseSides(curvature);
    return {lengths(filtered(lightness, slope, smooth), filtered(lightness, smooth, slope)),
            lengths(filtered(lightness, curvature, smooth), filtered(lightness, smooth, curvature))};
}

} // namespace tessera::validation
