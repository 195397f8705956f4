#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;
constexpr double kPlinthY = 0.2;
constexpr double kShaftY = 0.62; // above the base's mouldings
constexpr double kNeckY = 4.85;
constexpr double kBottomRadius = 0.40;
constexpr double kNeckRadius = 0.335;

/// The fluted shaft: swelling as classical columns do, flutes running out round at both ends.
glm::dvec3 shaftPoint(double u, double v) {
    constexpr int kFlutes = 20;
    constexpr double kFluteDepth = 0.036;
    constexpr double kRunOut = 0.16;
    const double y = glm::mix(kShaftY, kNeckY, v);
    const double radius = glm::mix(kBottomRadius, kNeckRadius, v * v);
    const double toEnd = std::min(y - kShaftY, kNeckY - y);
    const double open = glm::smoothstep(0.03, kRunOut, toEnd);
    const double flute = std::pow(std::abs(std::sin(pi * kFlutes * u)), 0.75);
    const double r = radius - kFluteDepth * open * flute;
    return {r * std::cos(2.0 * pi * u), y, -r * std::sin(2.0 * pi * u)};
}

/// More rows where the flutes run out.
double shaftRow(double v) {
    return v - 0.95 * std::sin(2.0 * pi * v) / (2.0 * pi);
}

void appendShaft(Mesh& mesh) {
    constexpr double kStep = 1e-4;
    appendPatch(mesh, 20 * 5, 12, [](double u, double row) {
        const double v = shaftRow(row);
        const glm::dvec3 around = shaftPoint(u + kStep, v) - shaftPoint(u - kStep, v);
        const glm::dvec3 along = shaftPoint(u, std::min(v + kStep, 1.0)) - shaftPoint(u, std::max(v - kStep, 0.0));
        return SurfacePoint{
            shaftPoint(u, v), glm::cross(around, along), {2.0 * pi * kBottomRadius * u, kNeckY - v * 4.2}};
    });
}

/// An acanthus leaf as masons rough it out: it leans on the bell, widens, and its tip rolls over.
glm::dvec3 leafPoint(double s, double t, double footY, double height, double footRadius) {
    const double roll = std::max(0.0, t - 0.62) / 0.38; // over the last part of its length
    const double halfWidth = 0.085 * (0.75 + 0.9 * t * (1.0 - t)) * (1.0 - 0.55 * roll * roll);
    const double out =
        footRadius + 0.05 * t + 0.13 * roll * roll - 0.035 * s * s * (1.0 - 0.4 * roll) + 0.012 * std::cos(pi * s);
    const double y = footY + height * (t - 0.20 * roll * roll * roll * t);
    return {halfWidth * s, y, out};
}

void appendLeaves(Mesh& mesh, int count, double phase, double footY, double height, double footRadius) {
    constexpr double kStep = 1e-4;
    for (int leaf = 0; leaf < count; ++leaf) {
        const glm::dmat4 turned =
            glm::rotate(glm::dmat4(1.0), 2.0 * pi * (leaf + phase) / count, glm::dvec3(0.0, 1.0, 0.0));
        for (const double side : {1.0, -1.0}) { // the rolled tip makes the leaf's back visible
            Mesh part;
            appendPatch(part, 4, 6, [&](double u, double v) {
                const double s = 2.0 * u - 1.0;
                const auto at = [&](double ds, double dt) {
                    return leafPoint(s + ds, v + dt, footY, height, footRadius);
                };
                const glm::dvec3 normal =
                    glm::cross(at(kStep, 0.0) - at(-kStep, 0.0), at(0.0, kStep) - at(0.0, -kStep));
                return SurfacePoint{at(0.0, 0.0), side * normal, {0.17 * u, height * v}};
            });
            appendMesh(mesh, part, turned);
        }
    }
}

} // namespace

Mesh columnPlinth() {
    Mesh mesh;
    appendBox(mesh, {-0.52, 0.0, -0.52}, {0.52, kPlinthY, 0.52});
    return mesh;
}

Mesh columnShaft() {
    Mesh mesh;
    // Attic base: torus, scotia, torus, each between fillets.
    const Profile base = Profile({0.44, kPlinthY})
                             .arcAround({0.44, kPlinthY + 0.08}, pi, 8)
                             .lineTo({0.44, kPlinthY + 0.185})
                             .arcAround({0.45, kPlinthY + 0.235}, -0.8 * pi, 6)
                             .lineTo({0.425, kPlinthY + 0.30})
                             .arcAround({0.425, kPlinthY + 0.35}, pi, 6)
                             .lineTo({kBottomRadius, kShaftY});
    appendLathe(mesh, base, 40);
    appendShaft(mesh);
    return mesh;
}

Mesh columnCapital() {
    Mesh mesh;
    const Profile bell =
        Profile({kNeckRadius, kNeckY})
            .arcAround({kNeckRadius, kNeckY + 0.035}, pi, 6)
            .curveThrough({{kNeckRadius - 0.01, kNeckY + 0.3}, {0.40, kNeckY + 0.58}, {0.52, kNeckY + 0.7}}, 3);
    appendLathe(mesh, bell, 40);
    appendLeaves(mesh, 8, 0.0, kNeckY + 0.07, 0.36, 0.335);
    appendLeaves(mesh, 8, 0.5, kNeckY + 0.2, 0.5, 0.345);
    appendBox(mesh, {-0.47, kNeckY + 0.68, -0.47}, {0.47, kNeckY + 0.76, 0.47});
    appendBox(mesh, {-0.51, kNeckY + 0.76, -0.51}, {0.51, kImpostY, 0.51});
    for (int side = 0; side < 4; ++side) { // a boss in the middle of each side
        const double angle = 0.5 * pi * side;
        appendSphere(mesh, {0.5 * std::sin(angle), kNeckY + 0.75, 0.5 * std::cos(angle)}, 0.07, 12, 8);
    }
    return mesh;
}

} // namespace tessera::scenes::builtin::hall
