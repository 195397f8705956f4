#include "scenes/builtin/bust/BustField.h"

#include <algorithm>
#include <cmath>

#include "scenes/builtin/bust/BustHair.h"

namespace tessera::scenes::builtin {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Distance to an ellipsoid, right to first order near its surface (the value over its gradient's length).
double ellipsoid(const dvec3& p, const dvec3& center, const dvec3& radii) {
    const dvec3 perRadius = 1.0 / radii; // a compile-time constant; products are faster than quotients
    const dvec3 q = (p - center) * perRadius;
    const double k0 = glm::length(q);
    const double k1 = glm::length(q * perRadius);
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// Distance to a rod with round ends of radii `ra` at `a` and `rb` at `b`, for radii that differ little.
double rod(const dvec3& p, const dvec3& a, const dvec3& b, double ra, double rb) {
    const dvec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::distance(p, a + t * ab) - glm::mix(ra, rb, t);
}

/// Union with a fillet of about `blend` (the polynomial smooth minimum of Quilez, "Smooth minimum", 2013).
double join(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - h * h * blend * 0.25;
}

double carve(double a, double b, double blend) {
    return -join(-a, b, blend);
}

double common(double a, double b, double blend) {
    return -join(-a, -b, blend);
}

double smoothBetween(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// The bust is symmetric: features are given for its left side (x > 0) and `p` is mirrored onto it.

double neckAndChest(const dvec3& p) {
    double d = rod(p, {0.0, -0.6, -0.28}, {0.0, -1.6, -0.38}, 0.47, 0.5);
    // Sterno-mastoid: from behind the ear to the pit of the throat.
    d = join(d, rod(p, {0.5, -0.72, -0.35}, {0.1, -1.55, 0.12}, 0.1, 0.08), 0.2);
    d = join(d, rod(p, {0.0, -1.02, 0.1}, {0.0, -1.15, 0.1}, 0.08, 0.07), 0.16); // larynx
    // Trapezius and shoulders.
    d = join(d, rod(p, {0.18, -1.05, -0.55}, {1.22, -1.76, -0.5}, 0.26, 0.3), 0.35);
    d = join(d, ellipsoid(p, {0.0, -2.05, -0.32}, {1.6, 0.72, 0.7}), 0.4);
    d = join(d, ellipsoid(p, {0.5, -2.0, 0.12}, {0.5, 0.34, 0.24}), 0.3);            // breast
    d = join(d, rod(p, {0.14, -1.66, 0.2}, {1.15, -1.64, -0.12}, 0.06, 0.07), 0.16); // clavicle
    // The turned foot the bust stands on.
    const dvec2 ring(glm::length(dvec2(p.x, p.z + 0.32)), p.y);
    const auto disc = [&](double radius, double low, double high) {
        return std::max({ring.x - radius, low - ring.y, ring.y - high});
    };
    d = join(d, disc(0.4, kBustBottomY, -2.6), 0.12);
    d = join(d, disc(0.62, kBustBottomY - 1.0, -2.96), 0.1);
    return join(d, disc(0.5, -2.84, -2.76), 0.05);
}

double skull(const dvec3& p) {
    double d = ellipsoid(p, {0.0, 0.3, -0.16}, {0.755, 0.82, 0.94});
    d = join(d, ellipsoid(p, {0.0, 0.33, 0.3}, {0.6, 0.56, 0.52}), 0.2);             // forehead
    d = join(d, ellipsoid(p, {0.0, -0.35, 0.2}, {0.56, 0.74, 0.58}), 0.25);          // mid face
    d = join(d, rod(p, {0.57, -0.35, -0.12}, {0.46, -0.72, 0.05}, 0.13, 0.12), 0.3); // angle of the jaw
    d = join(d, rod(p, {0.46, -0.72, 0.05}, {0.13, -0.99, 0.55}, 0.11, 0.14), 0.22); // jaw line
    d = join(d, ellipsoid(p, {0.0, -0.98, 0.6}, {0.2, 0.16, 0.16}), 0.14);           // chin
    d = join(d, ellipsoid(p, {0.4, -0.2, 0.52}, {0.19, 0.13, 0.19}), 0.22);          // cheek bone
    d = join(d, ellipsoid(p, {0.3, -0.52, 0.55}, {0.18, 0.22, 0.17}), 0.22);         // cheek
    d = join(d, ellipsoid(p, {0.0, -0.62, 0.55}, {0.36, 0.28, 0.23}), 0.18);         // muzzle
    return d;
}

double eyes(const dvec3& p, double d) {
    d = carve(d, ellipsoid(p, {0.275, 0.03, 0.9}, {0.2, 0.13, 0.2}), 0.14);        // socket
    d = carve(d, ellipsoid(p, {0.115, 0.02, 0.84}, {0.075, 0.1, 0.1}), 0.1);       // inner corner
    d = join(d, rod(p, {0.13, 0.185, 0.8}, {0.46, 0.2, 0.62}, 0.055, 0.05), 0.12); // brow
    const dvec3 center(0.275, 0.015, 0.615);
    const double ball = glm::distance(p, center) - 0.172;
    // Lids: shells a little larger than the eyeball, open between two slanted planes.
    const double shell = glm::distance(p, center) - 0.198;
    const double curve = 0.9 * (p.x - center.x) * (p.x - center.x);
    const double upper = common(shell, -(p.y - (center.y + 0.058 - curve)), 0.02);
    const double lower = common(shell, (p.y - (center.y - 0.062 + curve)), 0.02);
    d = join(d, ball, 0.02);
    d = join(d, upper, 0.025);
    return join(d, lower, 0.03);
}

// Each lip from its middle to the mouth's corner, with the radii there.
double upperLip(const dvec3& p) {
    return rod(p, {0.05, -0.562, 0.775}, {0.27, -0.606, 0.675}, 0.045, 0.022);
}
double lowerLip(const dvec3& p) {
    return rod(p, {0.0, -0.658, 0.772}, {0.24, -0.63, 0.675}, 0.056, 0.026);
}

double noseAndMouth(const dvec3& p, double d) {
    d = join(d, rod(p, {0.0, 0.14, 0.77}, {0.0, -0.26, 0.94}, 0.06, 0.085), 0.13);
    d = join(d, ellipsoid(p, {0.0, -0.285, 0.955}, {0.092, 0.078, 0.085}), 0.06);    // tip
    d = join(d, ellipsoid(p, {0.1, -0.32, 0.85}, {0.066, 0.066, 0.1}), 0.05);        // wing
    d = carve(d, ellipsoid(p, {0.05, -0.385, 0.89}, {0.032, 0.04, 0.05}), 0.03);     // nostril
    d = carve(d, rod(p, {0.0, -0.42, 0.865}, {0.0, -0.49, 0.85}, 0.03, 0.03), 0.05); // philtrum
    d = join(d, upperLip(p), 0.05);
    d = join(d, lowerLip(p), 0.05);
    d = carve(d, rod(p, {0.0, -0.607, 0.84}, {0.32, -0.618, 0.69}, 0.014, 0.012), 0.03);
    return carve(d, ellipsoid(p, {0.0, -0.8, 0.82}, {0.16, 0.06, 0.09}), 0.12); // hollow above the chin
}

double ears(const dvec3& p, double d) {
    // In the ear's local frame: turned out from the head and leaning back.
    const dvec3 q = p - dvec3(0.74, -0.08, -0.2);
    const double c = 0.9;
    const double s = 0.436;
    const dvec3 e(c * q.x + s * q.z, q.y + 0.15 * q.z, c * q.z - s * q.x);
    double ear = ellipsoid(e, dvec3(0.02, 0.0, 0.0), {0.07, 0.27, 0.17});
    ear = carve(ear, ellipsoid(e, dvec3(0.085, 0.02, 0.015), {0.06, 0.19, 0.1}), 0.04);
    ear = join(ear, ellipsoid(e, dvec3(0.03, -0.03, 0.11), {0.045, 0.06, 0.04}), 0.03); // tragus
    return join(d, ear, 0.05);
}

/// Positive where hair grows: above a line from the forehead over the temple and behind the ear to the nape.
double hairSide(const dvec3& p) {
    const double line = 0.66 * p.y - 0.75 * p.z + 0.06;
    const double temple = -0.22 * std::exp(-18.0 * ((p.y - 0.02) * (p.y - 0.02) + (p.z - 0.25) * (p.z - 0.25)));
    return line + temple - 0.1 * p.x * p.x + 0.05;
}

double hairBody(const dvec3& p) {
    return ellipsoid(p, {0.0, 0.3, -0.19}, {0.815, 0.885, 0.985});
}

double hairCap(const dvec3& p) {
    const double body = hairBody(p);
    if (body > 0.3) return body; // too far off for its curls to matter
    return common(body - bustCurl(p).height, -0.9 * hairSide(p), 0.08);
}

dvec3 mirrored(const dvec3& p) {
    return {std::abs(p.x), p.y, p.z};
}

} // namespace

double bustField(const glm::dvec3& pointBU) {
    const dvec3 p = mirrored(pointBU);
    // Parts beyond the extent of their fillets are skipped.
    if (p.y < -1.6) return neckAndChest(p);
    double d = skull(p);
    if (p.y < 0.0) d = join(d, neckAndChest(p), 0.22);
    if (p.z > 0.2 && p.y > -1.4 && p.y < 0.7) {
        d = eyes(p, d);
        d = noseAndMouth(p, d);
    }
    if (p.y > -1.3) d = join(d, hairCap(p), 0.05);
    return p.x > 0.3 && std::abs(p.y) < 0.8 ? ears(p, d) : d;
}

BustRegions bustRegions(const glm::dvec3& pointBU) {
    const dvec3 p = mirrored(pointBU);
    BustRegions regions;
    const double earMask = smoothBetween(0.0, 0.05, ears(p, 1.0));
    regions.hair = smoothBetween(-0.03, 0.05, hairSide(p)) * smoothBetween(0.16, 0.07, hairBody(p)) * earMask;
    const double alongBrow = std::clamp((p.x - 0.09) / 0.42, 0.0, 1.0);
    const double browY = 0.2 + 0.085 * std::sin(2.3 * alongBrow);
    const double browHalf = 0.05 * (1.0 - 0.6 * alongBrow);
    regions.brow = smoothBetween(browHalf, 0.3 * browHalf, std::abs(p.y - browY)) * smoothBetween(0.06, 0.11, p.x) *
                   smoothBetween(0.54, 0.44, p.x) * smoothBetween(0.4, 0.5, p.z);
    regions.lips = smoothBetween(0.022, 0.004, std::min(upperLip(p), lowerLip(p)));
    const dvec3 gaze = p - dvec3(0.275, 0.015, 0.615);
    regions.eye = smoothBetween(0.188, 0.178, glm::length(gaze)) * smoothBetween(0.05, 0.1, gaze.z);
    const double fromPupil = std::hypot(gaze.x + 0.01, gaze.y - 0.006);
    regions.iris = regions.eye * smoothBetween(0.074, 0.064, fromPupil);
    regions.irisRim = regions.eye * smoothBetween(0.013, 0.004, std::abs(fromPupil - 0.072));
    regions.pupil = regions.eye * smoothBetween(0.034, 0.02, fromPupil);
    return regions;
}

} // namespace tessera::scenes::builtin
