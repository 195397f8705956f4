#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/lamps/Parts.h"
#include "scenes/builtin/lamps/Plan.h"

namespace tessera::scenes::builtin::lamps {
namespace {

constexpr double kWindowHalf = 2.2;
constexpr double kWindowSillY = 1.1;
constexpr double kWindowSpringY = 3.7;
constexpr double kWindowDepth = 0.45;

} // namespace

Mesh walls() {
    Mesh mesh, window;
    for (const double side : {-1.0, 1.0}) {
        const double x = side * kHalfWidth, near = side * kHalfLength;
        appendQuad(mesh, {x, 0.0, -near}, {x, 0.0, near}, {x, kCeilingY, near}, {x, kCeilingY, -near});
    }
    appendQuad(mesh, {kHalfWidth, 0.0, kHalfLength}, {-kHalfWidth, 0.0, kHalfLength},
               {-kHalfWidth, kCeilingY, kHalfLength}, {kHalfWidth, kCeilingY, kHalfLength});
    ArchedWall wall;
    wall.widthMetres = 2.0 * kHalfWidth;
    wall.bottomY = 0.0;
    wall.topY = kCeilingY;
    wall.halfOpeningMetres = kWindowHalf;
    wall.sillY = kWindowSillY;
    wall.springY = kWindowSpringY;
    wall.depthMetres = kWindowDepth;
    wall.back = false;
    wall.archSteps = 32;
    appendArchedWall(window, wall);
    appendMesh(mesh, window, glm::translate(glm::dmat4(1.0), {0.0, 0.0, -kHalfLength}));
    return mesh;
}

Mesh ceiling() {
    Mesh mesh;
    appendQuad(mesh, {-kHalfWidth, kCeilingY, -kHalfLength}, {kHalfWidth, kCeilingY, -kHalfLength},
               {kHalfWidth, kCeilingY, kHalfLength}, {-kHalfWidth, kCeilingY, kHalfLength});
    return mesh;
}

Mesh beams() {
    Mesh mesh;
    constexpr double kHalf = 0.12, kDrop = 0.35;
    for (int i = 0; i <= kCases; ++i) {
        const double z = -kHalfLength + i * kCaseSpacing;
        appendBox(mesh, {-kHalfWidth, kCeilingY - kDrop, z - kHalf}, {kHalfWidth, kCeilingY, z + kHalf});
    }
    return mesh;
}

Mesh floorBoards() {
    Mesh mesh;
    appendFloor(mesh, glm::dvec3(0.0), {2.0 * kHalfWidth, 2.0 * kHalfLength}, {22, 48});
    return mesh;
}

Mesh carpetRunner() {
    Mesh mesh;
    constexpr double kHalf = 0.85, kThick = 0.012, kFromWall = 1.0;
    appendBox(mesh, {-kHalf, 0.0, -kHalfLength + kFromWall}, {kHalf, kThick, kHalfLength - kFromWall});
    return mesh;
}

Mesh windowBars() {
    Mesh mesh;
    constexpr double kHalf = 0.035;
    const double topY = kWindowSpringY + kWindowHalf, z = -kHalfLength - 0.5 * kWindowDepth;
    for (const double x : {-0.5 * kWindowHalf, 0.0, 0.5 * kWindowHalf})
        appendBox(mesh, {x - kHalf, kWindowSillY, z - kHalf}, {x + kHalf, topY, z + kHalf});
    for (const double y : {kWindowSillY + 1.3, kWindowSpringY})
        appendBox(mesh, {-kWindowHalf, y - kHalf, z - kHalf}, {kWindowHalf, y + kHalf, z + kHalf});
    return mesh;
}

Mesh gallery() {
    Mesh mesh;
    appendBox(mesh, {kNaveHalf, kGalleryUnderY, -kHalfLength}, {kHalfWidth, kGalleryFloorY, kHalfLength});
    return mesh;
}

Mesh railing() {
    Mesh mesh;
    constexpr double kBar = 0.012, kHand = 0.035, kHandY = kGalleryFloorY + 1.0, kPostSpacing = 1.5;
    const double x = kNaveHalf + 0.08;
    const auto along = [&](double y, double half) {
        appendBox(mesh, {x - half, y - half, -kHalfLength}, {x + half, y + half, kHalfLength});
    };
    along(kHandY, kHand);
    for (const double y : {0.25, 0.5, 0.75}) along(kGalleryFloorY + y, kBar);
    const int posts = static_cast<int>(2.0 * kHalfLength / kPostSpacing);
    for (int i = 0; i < posts; ++i) {
        const double z = -kHalfLength + (i + 0.5) * kPostSpacing;
        appendBox(mesh, {x - 0.02, kGalleryFloorY, z - 0.02}, {x + 0.02, kHandY, z + 0.02});
    }
    return mesh;
}

Mesh pillar() {
    constexpr double kShaft = 0.13, kFoot = 0.24, kHead = 0.22;
    Profile profile({kFoot, 0.0});
    profile.lineTo({kFoot, 0.10})
        .arcAround({kFoot - 0.04, 0.10}, 0.5 * std::numbers::pi, 4)
        .lineTo({kShaft + 0.02, 0.14})
        .lineTo({kShaft, 0.24})
        .lineTo({kShaft, kGalleryUnderY - 0.3})
        .arcAround({kHead, kGalleryUnderY - 0.3}, -0.5 * std::numbers::pi, 6)
        .lineTo({kHead, kGalleryUnderY});
    Mesh mesh;
    appendLathe(mesh, profile, 20);
    return mesh;
}

} // namespace tessera::scenes::builtin::lamps
