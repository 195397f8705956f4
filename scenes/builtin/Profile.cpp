#include "scenes/builtin/Profile.h"

#include <cassert>
#include <cmath>

namespace tessera::scenes::builtin {
namespace {

glm::dvec2 rightOf(const glm::dvec2& direction) {
    return glm::normalize(glm::dvec2(direction.y, -direction.x));
}

} // namespace

Profile& Profile::lineTo(const glm::dvec2& end) {
    assert(end != pen_);
    const glm::dvec2 normal = rightOf(end - pen_);
    runs_.push_back({{pen_, end}, {normal, normal}});
    pen_ = end;
    return *this;
}

Profile& Profile::arcAround(const glm::dvec2& center, double turnRadians, int steps) {
    const glm::dvec2 arm = pen_ - center;
    Run run;
    for (int i = 0; i <= steps; ++i) {
        const double angleRadians = turnRadians * i / steps;
        const double c = std::cos(angleRadians);
        const double s = std::sin(angleRadians);
        const glm::dvec2 turned(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
        run.points.push_back(center + turned);
        run.normals.push_back(glm::normalize(turnRadians > 0.0 ? turned : -turned));
    }
    pen_ = run.points.back();
    runs_.push_back(std::move(run));
    return *this;
}

Profile& Profile::curveThrough(const std::vector<glm::dvec2>& points, int steps) {
    std::vector<glm::dvec2> knots = {pen_};
    knots.insert(knots.end(), points.begin(), points.end());
    // Beyond the ends the curve is continued by reflection.
    const auto knot = [&](std::ptrdiff_t i) {
        const auto last = static_cast<std::ptrdiff_t>(knots.size()) - 1;
        if (i < 0) return 2.0 * knots[0] - knots[1];
        if (i > last) return 2.0 * knots[static_cast<std::size_t>(last)] - knots[static_cast<std::size_t>(last - 1)];
        return knots[static_cast<std::size_t>(i)];
    };
    Run run;
    const auto spans = static_cast<std::ptrdiff_t>(knots.size()) - 1;
    for (std::ptrdiff_t span = 0; span < spans; ++span) {
        const glm::dvec2 p0 = knot(span - 1);
        const glm::dvec2 p1 = knot(span);
        const glm::dvec2 p2 = knot(span + 1);
        const glm::dvec2 p3 = knot(span + 2);
        const glm::dvec2 b = 0.5 * (p2 - p0);
        const glm::dvec2 c = p0 - 2.5 * p1 + 2.0 * p2 - 0.5 * p3;
        const glm::dvec2 d = 0.5 * (p3 - p0) + 1.5 * (p1 - p2);
        for (int i = span == 0 ? 0 : 1; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            run.points.push_back(p1 + t * (b + t * (c + t * d)));
            run.normals.push_back(rightOf(b + t * (2.0 * c + t * 3.0 * d)));
        }
    }
    pen_ = run.points.back();
    runs_.push_back(std::move(run));
    return *this;
}

} // namespace tessera::scenes::builtin
