#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;
constexpr int kAround = 10; // coffers from springing to springing
constexpr int kAlong = 4;   // coffers in a bay

/// A point of the vault by fractions of the half circle and of the bay, `depth` behind the vault's face.
glm::dvec3 vaultPoint(double around, double along, double depth) {
    const double r = kVaultRadius + depth;
    return {r * std::cos(pi * around), kVaultSpringY + r * std::sin(pi * around), (along - 0.5) * kBayLength};
}

/// A coffer: two frames, each with a step inwards behind it, and the ground. Insets are metres along the face.
struct Coffer {
    double around0, around1, along0, along1;

    Coffer inset(double metres) const {
        const double around = metres / (pi * kVaultRadius);
        const double along = metres / kBayLength;
        return {around0 + around, around1 - around, along0 + along, along1 - along};
    }
    /// Counter-clockwise seen from inside the hall.
    glm::dvec3 corner(int i, double depth) const {
        return vaultPoint(i < 2 ? around0 : around1, i == 0 || i == 3 ? along0 : along1, depth);
    }
};

Coffer cofferAt(int i, int j) {
    return {static_cast<double>(i) / kAround, static_cast<double>(i + 1) / kAround, static_cast<double>(j) / kAlong,
            static_cast<double>(j + 1) / kAlong};
}

/// The ring between two outlines, facing the inside of the hall.
void appendRing(Mesh& mesh, const Coffer& outer, double outerDepth, const Coffer& inner, double innerDepth) {
    for (int i = 0; i < 4; ++i) {
        const int k = (i + 1) % 4;
        appendQuad(mesh, outer.corner(i, outerDepth), outer.corner(k, outerDepth), inner.corner(k, innerDepth),
                   inner.corner(i, innerDepth));
    }
}

constexpr double kFrameMetres = 0.1;
constexpr double kStepMetres = 0.09;
constexpr double kInnerMetres = 0.07;
constexpr double kDepth = 0.2;

Coffer ground(const Coffer& coffer) {
    return coffer.inset(kFrameMetres).inset(0.02).inset(kInnerMetres).inset(0.02);
}

template <typename Add>
void forEachCoffer(const Add& add) {
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAround; ++i) add(cofferAt(i, j));
    }
}

} // namespace

Mesh vaultFrames() {
    Mesh mesh;
    forEachCoffer([&](const Coffer& coffer) {
        const Coffer first = coffer.inset(kFrameMetres);
        const Coffer firstBottom = first.inset(0.02);
        const Coffer second = firstBottom.inset(kInnerMetres);
        appendRing(mesh, coffer, 0.0, first, 0.0);
        appendRing(mesh, first, 0.0, firstBottom, kStepMetres);
        appendRing(mesh, firstBottom, kStepMetres, second, kStepMetres);
        appendRing(mesh, second, kStepMetres, ground(coffer), kDepth);
    });
    // A rib at each line of columns separates the bays.
    appendArch(mesh,
               Profile({kVaultRadius, 0.3})
                   .lineTo({kVaultRadius - 0.1, 0.3})
                   .lineTo({kVaultRadius - 0.1, -0.3})
                   .lineTo({kVaultRadius, -0.3}),
               {0.0, kVaultSpringY, -0.5 * kBayLength}, 40);
    return mesh;
}

Mesh vaultPanels() {
    Mesh mesh;
    forEachCoffer([&](const Coffer& coffer) {
        const Coffer g = ground(coffer);
        appendQuad(mesh, g.corner(0, kDepth), g.corner(1, kDepth), g.corner(2, kDepth), g.corner(3, kDepth));
    });
    return mesh;
}

Mesh vaultRosettes() {
    // A flower: petals are a wave on a shallow dome.
    Mesh flower;
    constexpr double kRadius = 0.19;
    appendPatch(flower, 16, 4, [](double u, double v) {
        const auto at = [](double a, double r) {
            const double petal = 0.84 + 0.16 * std::cos(8.0 * 2.0 * pi * a);
            const double height = 0.1 * (1.0 - r * r) + 0.02 * std::cos(3.0 * pi * r);
            return glm::dvec3(kRadius * r * petal * std::cos(2.0 * pi * a), height,
                              -kRadius * r * petal * std::sin(2.0 * pi * a));
        };
        constexpr double kStep = 1e-3;
        const double r = std::max(v, 0.02);
        const glm::dvec3 normal =
            v == 0.0 ? glm::dvec3(0.0, 1.0, 0.0)
                     : glm::cross(at(u + kStep, r) - at(u - kStep, r), at(u, r - kStep) - at(u, r + kStep));
        return SurfacePoint{at(u, v), normal, {u, v}};
    });
    Mesh mesh;
    forEachCoffer([&](const Coffer& coffer) {
        const double around = 0.5 * (coffer.around0 + coffer.around1);
        const double along = 0.5 * (coffer.along0 + coffer.along1);
        const glm::dvec3 up = glm::normalize(glm::dvec3(-std::cos(pi * around), -std::sin(pi * around), 0.0));
        const glm::dvec3 side(0.0, 0.0, 1.0);
        // The ground is a chord of the vault and lies a little below its arc.
        const double sagitta = (kVaultRadius + kDepth) * (1.0 - std::cos(0.5 * pi / kAround));
        const glm::dvec3 foot = vaultPoint(around, along, kDepth - 0.6 * sagitta);
        appendMesh(
            mesh, flower,
            {glm::dvec4(glm::cross(up, side), 0.0), glm::dvec4(up, 0.0), glm::dvec4(side, 0.0), glm::dvec4(foot, 1.0)});
    });
    return mesh;
}

} // namespace tessera::scenes::builtin::hall
