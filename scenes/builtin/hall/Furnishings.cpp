#include <cmath>
#include <numbers>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;
constexpr double kCarpetHalf = 1.2;

} // namespace

Mesh floor() {
    constexpr double kThreshold = 0.5; // extends into the portal; the apse has its own floor
    Mesh mesh;
    appendFloor(mesh, {0.0, 0.0, 0.5 * kThreshold}, {2.0 * kAisleOuterX, 2.0 * kHalfLength + kThreshold}, {8, 20});
    return mesh;
}

Mesh carpet() {
    constexpr double kThickness = 0.015;
    constexpr double kFromZ = -kHalfLength + 1.0;
    constexpr double kToZ = kHalfLength - 1.5;
    Mesh mesh;
    // u spans the image once and v repeats it every 2 m, so that the border runs along both edges.
    appendPatch(mesh, 2, 36, [&](double u, double v) {
        const double z = glm::mix(kFromZ, kToZ, v);
        return SurfacePoint{{kCarpetHalf * (2.0 * u - 1.0), kThickness, z}, {0.0, 1.0, 0.0}, {u, 0.5 * z}};
    });
    return mesh;
}

Mesh dais() {
    Mesh mesh;
    Profile steps({2.7, 0.0});
    double y = 0.0;
    for (const double radius : {2.35, 2.0, 0.0}) {
        const double edge = steps.runs().empty() ? 2.7 : steps.runs().back().points.back().x;
        steps.lineTo({edge, y + 0.13}).arcAround({edge - 0.03, y + 0.13}, 0.5 * pi, 3);
        y += 0.16;
        steps.lineTo({radius, y});
    }
    appendLathe(mesh, steps, 64);
    return mesh;
}

Mesh banner() {
    constexpr double kHalfWidth = 0.42;
    constexpr double kTopY = kCorniceY - 0.2;
    constexpr double kLength = 2.05;
    // Cloth hangs in folds that grow downwards; its lower edge is a point.
    const auto cloth = [](double u, double v) {
        const double across = 2.0 * u - 1.0;
        const double point = 0.16 * (1.0 - std::abs(across));
        const double fold = (0.012 + 0.03 * v) * std::sin(3.0 * pi * across + 1.2 * v) + 0.05 * v * v;
        return glm::dvec3(-kNaveHalf + 0.12 + fold, kTopY - v * (kLength - 0.16 + point), -kHalfWidth * across);
    };
    constexpr double kStep = 1e-4;
    Mesh mesh;
    appendPatch(mesh, 18, 12, [&](double u, double v) {
        // Central differences average the slopes at the lower edge's corner in the middle.
        const glm::dvec3 across = cloth(u + kStep, v) - cloth(u - kStep, v);
        const glm::dvec3 down = cloth(u, v - kStep) - cloth(u, v + kStep);
        return SurfacePoint{cloth(u, v), glm::cross(across, down), {u, v}};
    });
    return mesh;
}

Mesh vase() {
    const Profile amphora = Profile({0.0, 0.0})
                                .lineTo({0.17, 0.0})
                                .arcAround({0.17, 0.025}, pi, 4)
                                .curveThrough({{0.09, 0.1},
                                               {0.14, 0.2},
                                               {0.29, 0.45},
                                               {0.31, 0.62},
                                               {0.2, 0.84},
                                               {0.105, 0.95},
                                               {0.1, 1.03},
                                               {0.17, 1.12}},
                                              3)
                                .arcAround({0.165, 1.135}, pi, 4)
                                .curveThrough({{0.08, 1.05}, {0.07, 0.95}}, 3);
    Mesh mesh;
    appendLathe(mesh, amphora, 28);
    // Two handles from the shoulder to the neck.
    for (const double side : {-1.0, 1.0}) {
        const auto spine = [&](double t) {
            const double a = pi * (0.5 - t) + 0.25;
            return glm::dvec3(side * (0.14 + 0.16 * std::cos(a)), 0.88 + 0.17 * std::sin(a), 0.0);
        };
        appendPatch(mesh, 10, 12, [&](double u, double v) {
            const glm::dvec3 tangent = glm::normalize(spine(v + 1e-4) - spine(v - 1e-4));
            const glm::dvec3 binormal(0.0, 0.0, 1.0);
            const glm::dvec3 normal = glm::cross(binormal, tangent);
            const glm::dvec3 out = std::cos(2.0 * pi * u) * normal + std::sin(2.0 * pi * u) * binormal;
            return SurfacePoint{spine(v) + 0.022 * out, out, {0.14 * u, 0.5 * v}};
        });
    }
    return mesh;
}

Mesh pedestal() {
    Mesh mesh;
    const auto slab = [&](double half, double low, double high) {
        appendBox(mesh, {-half, low, -half}, {half, high, half});
    };
    slab(0.30, 0.0, 0.07);
    slab(0.27, 0.07, 0.1);
    slab(0.23, 0.1, 0.36);
    slab(0.26, 0.36, 0.39);
    slab(0.29, 0.39, 0.45);
    return mesh;
}

} // namespace tessera::scenes::builtin::hall
