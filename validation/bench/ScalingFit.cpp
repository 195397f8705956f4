#include "validation/bench/ScalingFit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "renderer/frame/LightBuffer.h"

namespace tessera::validation {

namespace {

/// The axis of a curve: the x of a point, and the key that is equal along a curve.
struct Quantity {
    const char* name;
    std::function<std::optional<double>(const BenchGroup&, const BenchResult&)> x;
    std::function<std::string(const BenchGroup&)> held;
};

std::string sizeText(const BenchGroup& group) {
    return fmt::format("{}x{}", group.sizePixels.x, group.sizePixels.y);
}

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> table{
        {"lights", [](const BenchGroup& group, const BenchResult&) { return std::optional(double(group.lights)); },
         sizeText},
        {"pixels",
         [](const BenchGroup& group, const BenchResult&) {
             return std::optional(double(group.sizePixels.x) * double(group.sizePixels.y));
         },
         [](const BenchGroup& group) { return frame::lightsText(std::size_t(group.lights)); }},
        {"evaluations",
         [](const BenchGroup&, const BenchResult& result) {
             const std::optional<std::uint64_t>& evaluations = result.counters.lightEvaluations;
             return evaluations ? std::optional(double(*evaluations)) : std::nullopt;
         },
         [](const BenchGroup&) { return std::string(); }},
    };
    return table;
}

void addTo(std::vector<ScalingCurve>& curves, const Quantity& quantity, const BenchGroup& group,
           const BenchResult& result) {
    const std::optional<double> x = quantity.x(group, result);
    if (!x || *x <= 0.0) return; // no logarithm
    const std::string held = quantity.held(group);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const ScalingCurve& other) {
        return other.scene == group.scene && other.key == result.key && other.held == held &&
               other.quantity == quantity.name;
    });
    if (curve == curves.end())
        curve = curves.insert(curves.end(), {group.scene, result.key, quantity.name, held, {}, {}, {}});
    curve->x.push_back(*x);
    curve->timeMs.push_back(result.times.cpuMs.median);
}

void sortByX(ScalingCurve& curve) {
    std::vector<std::pair<double, double>> pairs;
    for (std::size_t i = 0; i < curve.x.size(); ++i) pairs.emplace_back(curve.x[i], curve.timeMs[i]);
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        curve.x[i] = pairs[i].first;
        curve.timeMs[i] = pairs[i].second;
    }
}

std::size_t differentOf(const std::vector<double>& values) {
    return std::set<double>(values.begin(), values.end()).size();
}

} // namespace

std::optional<PowerFit> fitPower(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size());
    std::vector<double> logX, logY;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0) || !(y[i] > 0.0)) continue;
        logX.push_back(std::log(x[i]));
        logY.push_back(std::log(y[i]));
    }
    if (differentOf(logX) < 3) return {};
    const double count = double(logX.size());
    double meanX = 0.0, meanY = 0.0;
    for (std::size_t i = 0; i < logX.size(); ++i) {
        meanX += logX[i] / count;
        meanY += logY[i] / count;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < logX.size(); ++i) {
        xx += (logX[i] - meanX) * (logX[i] - meanX);
        xy += (logX[i] - meanX) * (logY[i] - meanY);
        yy += (logY[i] - meanY) * (logY[i] - meanY);
    }
    PowerFit fit;
    fit.exponent = xy / xx;
    fit.factor = std::exp(meanY - fit.exponent * meanX);
    fit.points = logX.size();
    double unexplained = 0.0;
    for (std::size_t i = 0; i < logX.size(); ++i) {
        const double off = logY[i] - meanY - fit.exponent * (logX[i] - meanX);
        unexplained += off * off;
        fit.mostOff = std::max(fit.mostOff, std::abs(std::expm1(off)));
    }
    fit.r2 = yy > 0.0 ? std::max(0.0, 1.0 - unexplained / yy) : 1.0;
    return fit;
}

std::vector<ScalingCurve> scalingCurves(std::span<const BenchGroup> groups) {
    std::vector<ScalingCurve> curves;
    for (const Quantity& quantity : quantities()) {
        for (const BenchGroup& group : groups)
            for (const BenchResult& result : group.results) addTo(curves, quantity, group, result);
    }
    std::erase_if(curves, [](const ScalingCurve& curve) { return differentOf(curve.x) < 2; });
    for (ScalingCurve& curve : curves) {
        sortByX(curve);
        curve.fit = fitPower(curve.x, curve.timeMs);
    }
    return curves;
}

} // namespace tessera::validation
