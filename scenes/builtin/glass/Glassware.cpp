#include "scenes/builtin/glass/Glassware.h"

#include <cmath>
#include <numbers>

#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin::glass {
namespace {

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;
constexpr int kSlices = 72;
constexpr double kPaneMetres = 0.22;

/// A flat triangle, its corners counter-clockwise seen from the front.
void appendFlatTriangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positionsOS.size());
    const glm::vec3 normalOS(glm::normalize(glm::cross(b - a, c - a)));
    for (const glm::dvec3& corner : {a, b, c}) {
        mesh.positionsOS.emplace_back(corner);
        mesh.normalsOS.push_back(normalOS);
        mesh.texCoords[0].emplace_back(glm::distance(corner, a), glm::distance(corner, b));
    }
    for (std::uint32_t i = 0; i < 3; ++i) mesh.indices.push_back(first + i);
}

/// A closed foot whose edge is rounded, up to the wall above it.
Profile roundedFoot(double radiusMetres, double edgeMetres) {
    Profile profile({0.0, 0.0});
    profile.lineTo({radiusMetres - edgeMetres, 0.0})
        .arcAround({radiusMetres - edgeMetres, edgeMetres}, kQuarterTurn, 5);
    return profile;
}

} // namespace

Mesh tableTop() {
    Mesh mesh;
    appendBox(mesh, {-0.9, -0.04, -0.6}, {0.9, 0.0, 0.6});
    return mesh;
}

Mesh wineBottle() {
    Profile profile = roundedFoot(0.036, 0.006);
    profile.lineTo({0.036, 0.155})
        .curveThrough({{0.033, 0.176}, {0.020, 0.202}, {0.0145, 0.222}}, 8)
        .lineTo({0.0135, 0.262})
        .lineTo({0.0165, 0.263})
        .lineTo({0.0165, 0.275})
        .arcAround({0.0135, 0.275}, kQuarterTurn, 5)
        .lineTo({0.0, 0.278});
    Mesh mesh;
    appendLathe(mesh, profile, kSlices);
    return mesh;
}

Mesh potBottle() {
    Profile profile = roundedFoot(0.045, 0.008);
    profile.curveThrough({{0.052, 0.030}, {0.053, 0.065}, {0.040, 0.100}, {0.019, 0.120}, {0.016, 0.135}}, 8)
        .lineTo({0.016, 0.155})
        .lineTo({0.020, 0.156})
        .lineTo({0.020, 0.165})
        .arcAround({0.016, 0.165}, kQuarterTurn, 5)
        .lineTo({0.0, 0.169});
    Mesh mesh;
    appendLathe(mesh, profile, kSlices);
    return mesh;
}

Mesh vase() {
    constexpr glm::dvec2 kLip(0.0355, 0.178);
    constexpr double kLipMetres = 0.002;
    Profile inside({kLip.x - kLipMetres, kLip.y});
    inside.curveThrough({{0.026, 0.150}, {0.037, 0.108}, {0.041, 0.062}, {0.030, 0.016}}, 8).lineTo({0.0, 0.014});
    Profile outside({0.0, 0.0});
    outside.lineTo({0.024, 0.0})
        .curveThrough({{0.033, 0.012}, {0.045, 0.062}, {0.041, 0.108}, {0.029, 0.150}, {kLip.x + kLipMetres, kLip.y}},
                      8)
        .arcAround(kLip, std::numbers::pi, 6);
    Mesh mesh;
    appendLathe(mesh, inside, kSlices);
    appendLathe(mesh, outside, kSlices);
    return mesh;
}

Mesh tumbler() {
    constexpr double kWallMetres = 0.0015, kRim = 0.038, kHeight = 0.0942;
    Profile inside({kRim - kWallMetres, kHeight});
    inside.lineTo({0.031, 0.010}).lineTo({0.0, 0.008});
    Profile outside = roundedFoot(0.032, 0.003);
    outside.lineTo({kRim, kHeight}).arcAround({kRim - 0.5 * kWallMetres, kHeight}, std::numbers::pi, 6);
    Mesh mesh;
    appendLathe(mesh, inside, kSlices);
    appendLathe(mesh, outside, kSlices);
    return mesh;
}

Mesh prism() {
    constexpr double kSide = 0.07, kHalfLength = 0.085;
    const double top = kSide * std::sqrt(0.75);
    const auto corner = [&](double x, int i) {
        return i == 2 ? glm::dvec3(x, top, 0.0) : glm::dvec3(x, 0.0, i == 0 ? 0.5 * kSide : -0.5 * kSide);
    };
    Mesh mesh;
    const auto left = [&](int i) { return corner(-kHalfLength, i); };
    const auto right = [&](int i) { return corner(kHalfLength, i); };
    appendQuad(mesh, left(1), right(1), right(0), left(0)); // below
    appendQuad(mesh, right(1), left(1), left(2), right(2)); // behind
    appendQuad(mesh, left(0), right(0), right(2), left(2));
    appendFlatTriangle(mesh, left(1), left(0), left(2));
    appendFlatTriangle(mesh, right(0), right(1), right(2));
    return mesh;
}

Mesh crystalBall() {
    constexpr double kRadius = 0.055, kFootRadius = 0.020;
    Mesh mesh;
    appendSphere(mesh, {0.0, kFootMetres + std::sqrt(kRadius * kRadius - kFootRadius * kFootRadius), 0.0}, kRadius, 96,
                 56);
    return mesh;
}

Mesh crystalFoot() {
    Profile profile({0.028, 0.0});
    profile.lineTo({0.028, 0.5 * kFootMetres})
        .lineTo({0.022, kFootMetres})
        .lineTo({0.020, kFootMetres})
        .lineTo({0.020, 0.0});
    Mesh mesh;
    appendLathe(mesh, profile, kSlices);
    return mesh;
}

Mesh pane() {
    constexpr double kHalf = 0.5 * kPaneMetres;
    Mesh mesh;
    appendQuad(mesh, {-kHalf, 0.0, 0.0}, {kHalf, 0.0, 0.0}, {kHalf, kPaneMetres, 0.0}, {-kHalf, kPaneMetres, 0.0});
    return mesh;
}

Mesh paneHolder() {
    constexpr double kHalf = 0.52 * kPaneMetres;
    Mesh mesh;
    appendBox(mesh, {-kHalf, 0.0, -0.008}, {kHalf, kHolderMetres, 0.008});
    return mesh;
}

Mesh fruit() {
    constexpr double kRadius = 0.034;
    Mesh mesh;
    appendSphere(mesh, {0.0, kRadius, 0.0}, kRadius, 48, 32);
    return mesh;
}

Mesh lampStand() {
    constexpr double kSocketMetres = 0.014; // around the lamp's end
    Profile profile = roundedFoot(0.04, 0.004);
    profile.lineTo({0.04, 0.008}).lineTo({kSocketMetres, 0.012}).lineTo({kSocketMetres, 0.034}).lineTo({0.0, 0.034});
    Mesh mesh;
    appendLathe(mesh, profile, kSlices);
    return mesh;
}

} // namespace tessera::scenes::builtin::glass
