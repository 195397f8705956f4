#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;
constexpr double kTopY = kVaultSpringY + kVaultRadius + 0.4;

/// The near end faces the apse: a wall made facing +Z is turned around.
glm::dmat4 nearEnd() {
    return glm::rotate(glm::translate(glm::dmat4(1.0), {0.0, 0.0, kHalfLength}), pi, glm::dvec3(0.0, 1.0, 0.0));
}
glm::dmat4 farEnd() {
    return glm::translate(glm::dmat4(1.0), {0.0, 0.0, -kHalfLength});
}

Mesh archFrame(double radius, double springY, double width) {
    Mesh mesh;
    appendArch(mesh,
               Profile({radius, 0.0})
                   .lineTo({radius, -0.08})
                   .lineTo({radius + 0.4 * width, -0.08})
                   .lineTo({radius + 0.4 * width, -0.14})
                   .lineTo({radius + width, -0.14})
                   .lineTo({radius + width, 0.0}),
               {0.0, springY, 0.0}, 48);
    for (const double side : {-1.0, 1.0}) { // jambs down to the floor
        const double inner = side * radius;
        const double outer = side * (radius + width);
        appendBox(mesh, {std::min(inner, outer), 0.0, 0.0}, {std::max(inner, outer), springY, 0.08});
        appendBox(mesh, {std::min(inner - 0.04, outer - 0.04), springY - 0.25, 0.0},
                  {std::max(inner + 0.04, outer + 0.04), springY, 0.18});
    }
    return mesh;
}

} // namespace

Mesh endWalls() {
    ArchedWall wall;
    wall.widthMetres = 2.0 * kAisleOuterX;
    wall.topY = kTopY;
    wall.halfOpeningMetres = kApseRadius;
    wall.springY = kApseSpringY;
    wall.back = wall.soffit = false;
    wall.archSteps = 40;
    Mesh mesh;
    Mesh part;
    appendArchedWall(part, wall);
    appendMesh(mesh, part, farEnd());

    wall.halfOpeningMetres = kPortalHalf;
    wall.springY = kPortalSpringY;
    wall.soffit = true;
    wall.depthMetres = 0.5;
    part = Mesh();
    appendArchedWall(part, wall);
    appendMesh(mesh, part, nearEnd());
    return mesh;
}

Mesh endTrim() {
    Mesh mesh;
    appendMesh(mesh, archFrame(kApseRadius, kApseSpringY, 0.5), farEnd());
    appendMesh(mesh, archFrame(kPortalHalf, kPortalSpringY, 0.32), nearEnd());
    // The string course of the apse, where its dome begins.
    const int slices = 40;
    const auto ring = [&](double u) {
        const glm::dvec3 out(std::cos(pi * u), 0.0, -std::sin(pi * u));
        return out;
    };
    Mesh course;
    for (const double step : {0.0, 1.0}) {
        const double radius = kApseRadius - 0.1 - 0.06 * step;
        const double low = kApseSpringY - 0.22 + 0.12 * step;
        const double high = low + 0.12;
        appendPatch(course, slices, 1, [&](double u, double v) {
            return SurfacePoint{
                radius * ring(u) + glm::dvec3(0.0, glm::mix(low, high, v), 0.0), -ring(u), {u * 9.4, v}};
        });
        appendPatch(course, slices, 1, [&](double u, double v) {
            return SurfacePoint{
                glm::mix(radius, kApseRadius, v) * ring(u) + glm::dvec3(0.0, low, 0.0), {0.0, -1.0, 0.0}, {u * 9.4, v}};
        });
        appendPatch(course, slices, 1, [&](double u, double v) {
            return SurfacePoint{
                glm::mix(radius, kApseRadius, v) * ring(u) + glm::dvec3(0.0, high, 0.0), {0.0, 1.0, 0.0}, {u * 9.4, v}};
        });
    }
    appendMesh(mesh, course, farEnd());
    return mesh;
}

Mesh apse() {
    Mesh part;
    appendAlcove(part, kApseRadius, 0.0, kApseSpringY, 40);
    Mesh mesh;
    appendMesh(mesh, part, farEnd());
    return mesh;
}

Mesh portalDoors() {
    Mesh part;
    const double top = kPortalSpringY + kPortalHalf;
    for (const double side : {-1.0, 1.0}) {
        const double inner = side * 0.015;
        const double outer = side * kPortalHalf;
        appendBox(part, {std::min(inner, outer), 0.0, -0.5}, {std::max(inner, outer), top, -0.42});
        for (int panel = 0; panel < 3; ++panel) {
            const double low = 0.25 + panel * 1.05;
            appendBox(part, {std::min(side * 0.2, side * 1.1), low, -0.44},
                      {std::max(side * 0.2, side * 1.1), low + 0.85, -0.38});
        }
    }
    Mesh mesh;
    appendMesh(mesh, part, nearEnd());
    return mesh;
}

} // namespace tessera::scenes::builtin::hall
