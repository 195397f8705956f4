#pragma once
#include <vector>

/// The separable filters of FLIP (Flip.h): every kernel is the product of a row and a column kernel, or the sum of two
/// such products.
namespace tessera::validation {

/// One number per pixel, rows from the top.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;
    explicit Plane(int w = 0, int h = 0) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
};

/// Weights at -radius .. +radius.
using Kernel = std::vector<float>;

/// Filters a plane by the product of two kernels. Beyond the edges the outermost pixels repeat.
Plane filtered(const Plane& plane, const Kernel& alongRow, const Kernel& alongColumn);

/// Contrast sensitivity of the eye to one opponent channel: its spatial kernel is the sum of
/// a sqrt(pi / b) exp(-pi^2 x^2 / b) over two terms, x in degrees. Source: Andersson et al. 2020, table 1.
struct ContrastSensitivity {
    double a1, b1, a2, b2;
};
inline constexpr ContrastSensitivity kAchromatic{1.0, 0.0047, 0.0, 1e-5};
inline constexpr ContrastSensitivity kRedGreen{1.0, 0.0053, 0.0, 1e-5};
inline constexpr ContrastSensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

/// Filters a channel by the eye's contrast sensitivity; the kernel's weights add up to 1.
Plane seenBy(const ContrastSensitivity& eye, const Plane& channel, double pixelsPerDegree);

/// Strength of the edges and the points (thin lines too) of a lightness plane: gradient lengths by first and second
/// derivatives of a Gaussian of 0.082 degrees, half that as its standard deviation.
struct Features {
    Plane edges, points;
};
Features featuresOf(const Plane& lightness, double pixelsPerDegree);

} // namespace tessera::validation
