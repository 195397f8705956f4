#include <algorithm>
#include <cmath>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/bust/BustField.h"
#include "scenes/builtin/bust/BustHair.h"

namespace tessera::scenes::builtin {
namespace {

constexpr std::uint32_t kReliefSeed = 71;

double bump(double x, double width) {
    return std::exp(-(x * x) / (width * width));
}

double hairRelief(const glm::dvec3& p) {
    const BustCurl curl = bustCurl({std::abs(p.x), p.y, p.z});
    const double strand = gradientNoise(38.0 * p, kReliefSeed);
    return curl.inside * 0.009 * curl.groove + 0.003 * strand;
}

/// Traces of the chisel and of weathering: pits and a low-frequency unevenness.
double stoneRelief(const glm::dvec3& p) {
    return 0.0011 * gradientNoise(46.0 * p, kReliefSeed + 1) + 0.0025 * fractalNoise(8.0 * p, 2, kReliefSeed + 2);
}

/// Creases across the forehead and at the outer corners of the eyes; <= 0.
double creases(const glm::dvec3& p) {
    if (p.z < 0.2 || p.y < -0.2) return 0.0;
    const double x = std::abs(p.x);
    const double waver = 0.02 * gradientNoise({6.0 * p.x, 0.5, 0.5}, kReliefSeed + 3) + 0.12 * p.x * p.x;
    const double forehead = bump(x, 0.4) * (bump(p.y - 0.44 + waver, 0.012) + 0.8 * bump(p.y - 0.53 + waver, 0.012));
    const double corner = bump(x - 0.53, 0.06) * bump(p.y, 0.07);
    return -0.005 * forehead - 0.003 * corner * (0.5 + 0.5 * std::cos(110.0 * p.y * (1.0 - 2.0 * (x - 0.5))));
}

} // namespace

double bustRelief(const glm::dvec3& pointBU, double grain) {
    const glm::dvec3& p = pointBU;
    const BustRegions regions = bustRegions(p);
    if (regions.hair >= 1.0) return hairRelief(p);
    const double x = std::abs(p.x);
    double height = (1.0 - regions.eye) * (grain * stoneRelief(p) + creases(p));
    if (regions.hair > 0.0) height = glm::mix(height, hairRelief(p), regions.hair);
    if (regions.brow > 0.0) { // hairs that lie outwards and a little up
        const double phase = 75.0 * (p.y - 0.9 * x) + 2.0 * gradientNoise(9.0 * p, kReliefSeed + 4);
        height += regions.brow * (0.012 + 0.005 * std::sin(phase));
    }
    if (regions.lips > 0.0) { // fine furrows from top to bottom
        height += 0.0016 * regions.lips * std::sin(95.0 * x + 4.0 * gradientNoise(10.0 * p, kReliefSeed + 5));
    }
    // The iris is outlined and the pupil cut in.
    return height - 0.010 * regions.irisRim - 0.02 * regions.pupil;
}

} // namespace tessera::scenes::builtin
