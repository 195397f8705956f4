#include "validation/figures/FlipColour.h"

#include <cmath>

namespace tessera::validation {

namespace {

/// CIE XYZ from linear RGB by the chromaticities of Rec.709's primaries and of D65 (ITU-R BT.709-6, table 1).
glm::dmat3 makeXyzFromLinear() {
    const auto xyzOf = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
    const glm::dmat3 primaries(xyzOf(0.64, 0.33), xyzOf(0.30, 0.60), xyzOf(0.15, 0.06));
    const glm::dvec3 strengths = glm::inverse(primaries) * xyzOf(0.3127, 0.3290);
    return {primaries[0] * strengths[0], primaries[1] * strengths[1], primaries[2] * strengths[2]};
}

const glm::dmat3 kXyzFromLinear = makeXyzFromLinear();
const glm::dmat3 kLinearFromXyz = glm::inverse(kXyzFromLinear);
const glm::dvec3 kWhite = kXyzFromLinear * glm::dvec3(1.0);

/// The cube root of CIE 1976, linear below (6/29)^3.
double lightnessCurve(double share) {
    constexpr double kDelta = 6.0 / 29.0;
    return share > kDelta * kDelta * kDelta ? std::cbrt(share) : share / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

} // namespace

glm::dvec3 opponentFromLinear(const glm::dvec3& linearRgb) {
    const glm::dvec3 share = kXyzFromLinear * linearRgb / kWhite;
    return {116.0 * share.y - 16.0, 500.0 * (share.x - share.y), 200.0 * (share.y - share.z)};
}

glm::dvec3 linearFromOpponent(const glm::dvec3& opponent) {
    const double y = (opponent.x + 16.0) / 116.0;
    return kLinearFromXyz * (kWhite * glm::dvec3(y + opponent.y / 500.0, y, y - opponent.z / 200.0));
}

glm::dvec3 huntLabFromLinear(const glm::dvec3& linearRgb) {
    const glm::dvec3 share = kXyzFromLinear * linearRgb / kWhite;
    const glm::dvec3 curved(lightnessCurve(share.x), lightnessCurve(share.y), lightnessCurve(share.z));
    const double lightness = 116.0 * curved.y - 16.0;
    const double hunt = 0.01 * lightness;
    return {lightness, hunt * 500.0 * (curved.x - curved.y), hunt * 200.0 * (curved.y - curved.z)};
}

double hyab(const glm::dvec3& labA, const glm::dvec3& labB) {
    const glm::dvec3 d = labA - labB;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

} // namespace tessera::validation
