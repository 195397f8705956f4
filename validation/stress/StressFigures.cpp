#include "validation/stress/StressFigures.h"

#include <cmath>

#include <fmt/format.h>

#include "validation/figures/Tolerance.h"

namespace tessera::validation {

void StressFigures::count(std::span<const float> values) {
    bool isNan = false, isInfinite = false, isNegative = false;
    for (const float value : values) {
        isNan |= std::isnan(value);
        isInfinite |= std::isinf(value);
        isNegative |= value < 0.0f;
    }
    ++samples;
    nan += isNan;
    infinite += isInfinite;
    negative += isNegative;
}

void StressFigures::add(const StressFigures& other) {
    samples += other.samples;
    nan += other.nan;
    infinite += other.infinite;
    negative += other.negative;
    undecided += other.undecided;
    error(other.worstRel, [&] { return other.where; });
    if (other.worstRelMse > worstRelMse) {
        worstRelMse = other.worstRelMse;
        whereRelMse = other.whereRelMse;
    }
    if (fault.empty()) fault = other.fault;
}

void StressFigures::addPicture(const RadianceFigures& picture, const std::string& what, double allowed) {
    samples += picture.covered;
    nan += picture.badA.nan + picture.badOutside.nan;
    infinite += picture.badA.infinite + picture.badOutside.infinite;
    negative += picture.badA.negative + picture.badOutside.negative;
    error(picture.maxRel / allowed,
          [&] { return fmt::format("{}, pixel {},{}", what, picture.worstX, picture.worstY); });
    const double relMse = picture.relMse / allowed;
    if (!(relMse <= worstRelMse)) {
        worstRelMse = std::isnan(relMse) ? std::numeric_limits<double>::infinity() : relMse;
        whereRelMse = what;
    }
    // An empty tolerance checks that the image has light and that enough of it was compared.
    const Verdict signal = checkTolerance(picture, {});
    if (fault.empty() && !signal.ok) fault = fmt::format("{}: {}", what, signal.missed.front());
}

void StressFigures::geometryLost(const std::string& what, const LostGeometry& lost) {
    if (fault.empty()) fault = fmt::format("{}: {}", what, lostText(lost));
}

} // namespace tessera::validation
