#include "scenes/builtin/studio/Products.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin::studio {
namespace {

using std::numbers::pi;

/// Adds a surface (u, v) -> position with normals from finite differences. The normals face away from `insideOS`.
void appendSmooth(Mesh& mesh, int stepsU, int stepsV, const glm::dvec3& insideOS,
                  const std::function<glm::dvec3(double, double)>& placeOS) {
    constexpr double kStep = 1e-4;
    appendPatch(mesh, stepsU, stepsV, [&](double u, double v) {
        const glm::dvec3 alongU = placeOS(u + kStep, v) - placeOS(u - kStep, v);
        const glm::dvec3 alongV = placeOS(u, v + kStep) - placeOS(u, v - kStep);
        const glm::dvec3 pointOS = placeOS(u, v);
        glm::dvec3 normalOS = glm::normalize(glm::cross(alongU, alongV));
        if (glm::dot(normalOS, pointOS - insideOS) < 0.0) normalOS = -normalOS;
        return SurfacePoint{pointOS, normalOS, {u, v}};
    });
}

/// Rises smoothly from 0 at `low` to 1 at `high`.
double rampBetween(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace

Mesh paperSweep() {
    constexpr double kHalfWidth = 10.0, kFrontZ = 7.0, kBendZ = -1.6, kBendRadius = 1.6, kWallMetres = 5.0;
    constexpr double kFloorMetres = kFrontZ - kBendZ, kBendMetres = 0.5 * pi * kBendRadius;
    Mesh mesh;
    const auto strip = [&](int steps, double from, double to) {
        appendPatch(mesh, 8, steps, [&](double u, double v) {
            const double way = glm::mix(from, to, v), x = glm::mix(-kHalfWidth, kHalfWidth, u);
            const double bend = std::clamp((way - kFloorMetres) / kBendRadius, 0.0, 0.5 * pi);
            const double onFloor = std::min(way, kFloorMetres);
            const double onWall = std::max(way - kFloorMetres - kBendMetres, 0.0);
            const glm::dvec3 normalOS(0.0, std::cos(bend), std::sin(bend));
            const glm::dvec3 pointOS(x, kBendRadius * (1.0 - std::cos(bend)) + onWall,
                                     kFrontZ - onFloor - kBendRadius * std::sin(bend));
            return SurfacePoint{pointOS, normalOS, {x, way}};
        });
    };
    strip(10, 0.0, kFloorMetres);
    strip(40, kFloorMetres, kFloorMetres + kBendMetres);
    strip(6, kFloorMetres + kBendMetres, kFloorMetres + kBendMetres + kWallMetres);
    return mesh;
}

Mesh ball(double radiusMetres) {
    Mesh mesh;
    appendSphere(mesh, {0.0, radiusMetres, 0.0}, radiusMetres, 80, 48);
    return mesh;
}

Mesh drapedCloth() {
    constexpr double kTopY = 0.62, kTopRadius = 0.27, kEdge = 0.05;
    constexpr int kFolds = 9;
    Mesh mesh;
    // v runs from near the middle of the top over its edge to the hem; a small disc closes the middle.
    constexpr double kInner = 0.02;
    const auto placeOS = [&](double u, double v) {
        const double angle = 2.0 * pi * u;
        constexpr double kTopMetres = kTopRadius - kEdge - kInner, kEdgeMetres = 0.5 * pi * kEdge;
        constexpr double kFallMetres = kTopY - kEdge - 0.006;
        const double way = v * (kTopMetres + kEdgeMetres + kFallMetres);
        const double bend = std::clamp((way - kTopMetres) / kEdge, 0.0, 0.5 * pi);
        const double fall = std::max(way - kTopMetres - kEdgeMetres, 0.0);
        const double depth = rampBetween(0.0, kFallMetres, fall + 0.4 * kEdge * bend);
        const double fold = std::cos(kFolds * angle + 0.9 * std::sin(2.0 * angle)) + 0.35 * std::cos(4.0 * angle + 1.0);
        const double radius =
            kInner + std::min(way, kTopMetres) + kEdge * std::sin(bend) + depth * (0.045 + 0.05 * fold);
        return glm::dvec3(radius * std::cos(angle), kTopY - kEdge * (1.0 - std::cos(bend)) - fall,
                          -radius * std::sin(angle));
    };
    appendSmooth(mesh, 144, 40, {0.0, 0.3, 0.0}, placeOS);
    appendPatch(mesh, 24, 1, [&](double u, double v) {
        const double angle = 2.0 * pi * u;
        return SurfacePoint{
            {v * kInner * std::cos(angle), kTopY, -v * kInner * std::sin(angle)}, {0.0, 1.0, 0.0}, {u, 0.0}};
    });
    return mesh;
}

Mesh vase() {
    Profile profile({0.11, 0.0});
    profile
        .curveThrough({{0.125, 0.02},
                       {0.19, 0.16},
                       {0.225, 0.31},
                       {0.19, 0.46},
                       {0.10, 0.58},
                       {0.070, 0.66},
                       {0.082, 0.73},
                       {0.115, 0.775}},
                      8)
        .arcAround({0.110, 0.780}, pi, 6) // the lip
        .curveThrough({{0.070, 0.725}, {0.058, 0.66}, {0.085, 0.58}}, 6);
    Mesh mesh;
    appendLathe(mesh, profile, 72);
    return mesh;
}

Mesh ring() {
    constexpr double kInner = 0.20, kOuter = 0.245, kHeight = 0.17, kRound = 0.012;
    Profile profile({kOuter, kRound});
    profile.lineTo({kOuter, kHeight - kRound})
        .arcAround({kOuter - kRound, kHeight - kRound}, 0.5 * pi, 6)
        .lineTo({kInner + kRound, kHeight})
        .arcAround({kInner + kRound, kHeight - kRound}, 0.5 * pi, 6)
        .lineTo({kInner, 0.0});
    Mesh mesh;
    appendLathe(mesh, profile, 128);
    return mesh;
}

Mesh stopper() {
    constexpr double kRadius = 0.13, kHeight = 0.30, kRound = 0.04;
    Profile profile({kRadius, 0.0});
    profile.lineTo({kRadius, kHeight - kRound})
        .arcAround({kRadius - kRound, kHeight - kRound}, 0.5 * pi, 12)
        .lineTo({0.0, kHeight});
    Mesh mesh;
    appendLathe(mesh, profile, 72);
    return mesh;
}

Mesh shell() {
    constexpr double kHalfLength = 0.33, kRadius = 0.22;
    Mesh unit;
    appendSphere(unit, glm::dvec3(0.0), 1.0, 96, 56);
    Mesh mesh;
    appendMesh(mesh, unit,
               glm::dmat4({kHalfLength, 0.0, 0.0, 0.0}, {0.0, kRadius, 0.0, 0.0}, {0.0, 0.0, kRadius, 0.0},
                          {0.0, kRadius, 0.0, 1.0}));
    return mesh;
}

Mesh lampFoot() {
    Profile profile({0.07, 0.0});
    profile.lineTo({0.07, 0.02}).arcAround({0.05, 0.02}, 0.5 * pi, 6).lineTo({0.012, 0.045}).lineTo({0.012, 0.10});
    Mesh mesh;
    appendLathe(mesh, profile, 40);
    return mesh;
}

} // namespace tessera::scenes::builtin::studio
