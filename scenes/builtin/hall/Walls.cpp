#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;

/// Moves a part made around the origin, facing +Z, into the plane x, facing +X.
glm::dmat4 facingRight(double x) {
    return {{0.0, 0.0, -1.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {x, 0.0, 0.0, 1.0}};
}
glm::dmat4 facingLeft(double x) {
    return {{0.0, 0.0, 1.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0, 0.0}, {x, 0.0, 0.0, 1.0}};
}

/// A stepped frame around a round head of the given radius, standing off the wall.
Mesh archivolt(double radius, double width, double springY, double proud, int steps) {
    Mesh mesh;
    const Profile profile = Profile({radius, 0.0})
                                .lineTo({radius, -0.6 * proud})
                                .lineTo({radius + 0.45 * width, -0.6 * proud})
                                .lineTo({radius + 0.45 * width, -proud})
                                .lineTo({radius + width, -proud})
                                .lineTo({radius + width, 0.0});
    appendArch(mesh, profile, {0.0, springY, 0.0}, steps);
    return mesh;
}

/// The main cornice above the arches: from the wall outwards and up (x off the wall).
Profile corniceProfile() {
    return Profile({0.0, kCorniceY - 0.18})
        .lineTo({0.05, kCorniceY - 0.18})
        .lineTo({0.05, kCorniceY - 0.06})
        .curveThrough({{0.10, kCorniceY}, {0.22, kCorniceY + 0.06}, {0.26, kCorniceY + 0.14}}, 4)
        .lineTo({0.34, kCorniceY + 0.14})
        .lineTo({0.34, kCorniceY + 0.24})
        .curveThrough({{0.38, kCorniceY + 0.28}, {0.40, kCorniceY + 0.34}}, 3)
        .lineTo({0.0, kCorniceY + 0.34});
}

} // namespace

void appendAlcove(Mesh& mesh, double radius, double floorY, double springY, int slices) {
    const auto out = [](double u) { return glm::dvec3(std::cos(pi * u), 0.0, -std::sin(pi * u)); };
    appendPatch(mesh, slices, 1, [&](double u, double v) {
        return SurfacePoint{radius * out(u) + glm::dvec3(0.0, glm::mix(floorY, springY, v), 0.0),
                            -out(u),
                            {pi * radius * u, glm::mix(springY, floorY, v)}};
    });
    appendPatch(mesh, slices, slices / 2, [&](double u, double v) {
        const double rise = 0.5 * pi * v;
        const glm::dvec3 direction = std::cos(rise) * out(u) + glm::dvec3(0.0, std::sin(rise), 0.0);
        return SurfacePoint{
            radius * direction + glm::dvec3(0.0, springY, 0.0), -direction, {pi * radius * u, -radius * rise}};
    });
    appendPatch(mesh, slices, 1, [&](double u, double v) {
        const glm::dvec3 p = radius * v * out(u);
        return SurfacePoint{p + glm::dvec3(0.0, floorY, 0.0), {0.0, 1.0, 0.0}, {p.x, p.z}};
    });
}

Mesh bayWalls() {
    Mesh mesh;
    ArchedWall arcade;
    arcade.widthMetres = kBayLength;
    arcade.bottomY = arcade.sillY = arcade.springY = kImpostY;
    arcade.topY = kCorniceY + 0.3;
    arcade.halfOpeningMetres = kArchRadius;
    arcade.depthMetres = 2.0 * kWallHalf;
    arcade.archSteps = 32;
    Mesh part;
    appendArchedWall(part, arcade);
    // The wall's underside beside the arch rests on the capitals.
    for (const double side : {-1.0, 1.0}) {
        const double inner = side * kArchRadius;
        const double outer = side * 0.5 * kBayLength;
        const double low = std::min(inner, outer);
        const double high = std::max(inner, outer);
        appendQuad(part, {low, kImpostY, -arcade.depthMetres}, {high, kImpostY, -arcade.depthMetres},
                   {high, kImpostY, 0.0}, {low, kImpostY, 0.0});
    }
    appendMesh(mesh, part, facingRight(-kNaveHalf));

    ArchedWall window = arcade;
    window.bottomY = arcade.topY;
    window.topY = kVaultSpringY;
    window.sillY = kWindowSillY;
    window.springY = kWindowSpringY;
    window.halfOpeningMetres = kWindowHalf;
    window.archSteps = 20;
    part = Mesh();
    appendArchedWall(part, window);
    appendMesh(mesh, part, facingRight(-kNaveHalf));

    ArchedWall outer = arcade;
    outer.bottomY = 0.0;
    outer.topY = kAisleVaultSpringY;
    outer.sillY = kNicheSillY;
    outer.springY = kNicheSpringY;
    outer.halfOpeningMetres = kNicheRadius;
    outer.back = outer.soffit = false;
    outer.archSteps = 20;
    part = Mesh();
    appendArchedWall(part, outer);
    appendAlcove(part, kNicheRadius, kNicheSillY, kNicheSpringY, 20);
    appendMesh(mesh, part, facingRight(-kAisleOuterX));

    // Barrel vault of the aisle, facing down.
    const double innerX = -kColumnX - kWallHalf;
    const double radius = 0.5 * (kAisleOuterX + innerX);
    const double centerX = 0.5 * (innerX - kAisleOuterX);
    appendPatch(mesh, 20, 1, [&](double u, double v) {
        const glm::dvec3 out(std::cos(pi * u), std::sin(pi * u), 0.0);
        const double z = (v - 0.5) * kBayLength;
        return SurfacePoint{glm::dvec3(centerX, kAisleVaultSpringY, z) + radius * out, -out, {pi * radius * u, z}};
    });
    return mesh;
}

Mesh bayTrim() {
    Mesh mesh;
    const glm::dmat4 nave = facingRight(-kNaveHalf);
    appendMesh(mesh, archivolt(kArchRadius, 0.3, kImpostY, 0.07, 32), nave);
    appendMesh(mesh, archivolt(kArchRadius, 0.3, kImpostY, 0.07, 32), facingLeft(-kColumnX - kWallHalf));
    appendMesh(mesh, archivolt(kWindowHalf, 0.16, kWindowSpringY, 0.05, 20), nave);
    appendMesh(mesh, archivolt(kNicheRadius, 0.18, kNicheSpringY, 0.06, 20), facingRight(-kAisleOuterX));

    const double half = 0.5 * kBayLength;
    const auto moulding = [&](const Profile& profile, double x) {
        Mesh part;
        appendMoulding(part, profile, -half, half);
        appendMesh(mesh, part, glm::translate(glm::dmat4(1.0), {x, 0.0, 0.0}));
    };
    moulding(corniceProfile(), -kNaveHalf);
    const double y = kVaultSpringY;
    moulding(Profile({0.0, y - 0.2})
                 .lineTo({0.06, y - 0.2})
                 .lineTo({0.06, y - 0.1})
                 .curveThrough({{0.09, y - 0.05}, {0.16, y - 0.02}}, 3)
                 .lineTo({0.16, y + 0.05})
                 .lineTo({0.0, y + 0.05}),
             -kNaveHalf);
    // Dado and string course of the outer wall, the latter also where the aisle's vault begins.
    moulding(Profile({0.0, 0.0})
                 .lineTo({0.12, 0.0})
                 .lineTo({0.12, 0.2})
                 .curveThrough({{0.06, 0.26}, {0.04, 0.34}}, 3)
                 .lineTo({0.0, 0.34}),
             -kAisleOuterX);
    const double s = kAisleVaultSpringY;
    moulding(Profile({0.0, s - 0.16})
                 .lineTo({0.05, s - 0.16})
                 .curveThrough({{0.07, s - 0.08}, {0.14, s - 0.03}}, 3)
                 .lineTo({0.14, s + 0.04})
                 .lineTo({0.0, s + 0.04}),
             -kAisleOuterX);
    // Sill of the niche.
    appendBox(mesh, {-kAisleOuterX, kNicheSillY - 0.1, -kNicheRadius - 0.16},
              {-kAisleOuterX + 0.14, kNicheSillY, kNicheRadius + 0.16});
    // Pilaster and vault rib at the bay's end towards -Z.
    appendBox(mesh, {-kAisleOuterX, 0.0, -half - 0.28}, {-kAisleOuterX + 0.14, s - 0.16, -half + 0.28});
    appendBox(mesh, {-kAisleOuterX, 0.0, -half - 0.34}, {-kAisleOuterX + 0.2, 0.42, -half + 0.34});
    const double innerX = -kColumnX - kWallHalf;
    const double radius = 0.5 * (kAisleOuterX + innerX);
    appendArch(
        mesh,
        Profile({radius, 0.25}).lineTo({radius - 0.12, 0.25}).lineTo({radius - 0.12, -0.25}).lineTo({radius, -0.25}),
        {0.5 * (innerX - kAisleOuterX), s, -half}, 24);
    return mesh;
}

Mesh bayGilding() {
    Mesh mesh;
    const double half = 0.5 * kBayLength;
    const auto fillet = [&](double x, double y, double size) {
        Mesh part;
        appendMoulding(part, Profile({0.0, y - size}).arcAround({0.0, y}, pi, 6), -half, half);
        appendMesh(mesh, part, glm::translate(glm::dmat4(1.0), {x, 0.0, 0.0}));
    };
    fillet(-kNaveHalf + 0.05, kCorniceY - 0.12, 0.035);
    fillet(-kNaveHalf + 0.34, kCorniceY + 0.19, 0.03);
    fillet(-kNaveHalf + 0.06, kVaultSpringY - 0.15, 0.035);
    // A bead around the arch, between its two steps.
    Mesh bead;
    appendArch(bead, Profile({kArchRadius + 0.1, -0.042}).arcAround({kArchRadius + 0.135, -0.042}, pi, 6),
               {0.0, kImpostY, 0.0}, 32);
    appendMesh(mesh, bead, facingRight(-kNaveHalf));
    return mesh;
}

} // namespace tessera::scenes::builtin::hall
