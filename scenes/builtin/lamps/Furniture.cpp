#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/builtin/Random.h"
#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/lamps/Parts.h"
#include "scenes/builtin/lamps/Plan.h"
#include "scenes/builtin/lamps/Textures.h"

namespace tessera::scenes::builtin::lamps {
namespace {

/// A shelf for books: a point of its back edge, its direction, and the direction that spines face.
struct Shelf {
    glm::dvec3 backOS;
    glm::dvec3 along;
    glm::dvec3 out;
};

/// A row of books between two positions along the shelf. The texture of spines begins at `pictureFrom` and continues
/// over the tops and ends.
void appendRow(Mesh& mesh, const Shelf& shelf, double from, double to, double height, double depth,
               double pictureFrom) {
    constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);
    const auto at = [&](double a, double y, double forward) {
        return shelf.backOS + a * shelf.along + y * kUp + forward * shelf.out;
    };
    const auto picture = [&](double a, double v) { return glm::dvec2(pictureFrom + (a - from) / kSpinesMetres, v); };
    appendPatch(mesh, 1, 1, [&](double u, double v) {
        const double a = glm::mix(from, to, u);
        return SurfacePoint{at(a, height * v, depth), shelf.out, picture(a, 1.0 - v)};
    });
    appendPatch(mesh, 1, 1, [&](double u, double v) {
        const double a = glm::mix(from, to, u);
        return SurfacePoint{at(a, height, depth * v), kUp, picture(a, 0.02)};
    });
    for (const double end : {-1.0, 1.0})
        appendPatch(mesh, 1, 1, [&](double u, double v) {
            // The cover of the last book.
            const double a = end < 0.0 ? from : to;
            return SurfacePoint{at(a, height * v, depth * u), end * shelf.along, picture(a - 0.004 * end, 1.0 - v)};
        });
}

/// Rows of varying height and depth from one upright to the next, with some gaps.
void appendRows(Mesh& mesh, Random& random, const Shelf& shelf, double from, double to, double deepest) {
    constexpr double kLeastMetres = 0.25;
    double start = from + random.between(0.0, 0.08);
    while (to - start > kLeastMetres) {
        const double end = std::min(start + random.between(0.5, 1.3), to);
        const double height = random.between(0.28, 0.40);
        const double depth = deepest - random.between(0.0, 0.05);
        appendRow(mesh, shelf, start, end, height, depth, random.unit());
        const double gap = random.unit() < 0.25 ? random.between(0.12, 0.3) : random.between(0.003, 0.03);
        start = end + gap;
    }
}

constexpr double kBackHalf = 0.01;  ///< half thickness of the board between a case's two faces
constexpr double kUpright = 0.04;   ///< thickness of ends
constexpr double kBookDepth = 0.19; ///< well behind the strips, which thus light whole spines, not only their edges
constexpr glm::dvec3 kForward(0.0, 0.0, 1.0);
constexpr glm::dvec3 kRight(1.0, 0.0, 0.0);

} // namespace

Mesh caseBoards() {
    Mesh mesh;
    const double end = kCaseX + kCaseLength, middle = kCaseX + 0.5 * kCaseLength;
    const auto box = [&](double x0, double x1, double y0, double y1, double half) {
        appendBox(mesh, {x0, y0, -half}, {x1, y1, half});
    };
    box(kCaseX, kCaseX + kUpright, 0.0, kCaseY, kCaseHalfDepth);
    box(end - kUpright, end, 0.0, kCaseY, kCaseHalfDepth);
    box(middle - 0.5 * kUpright, middle + 0.5 * kUpright, kFirstShelfY, boardY(kShelves), kCaseHalfDepth - 0.02);
    box(kCaseX + kUpright, end - kUpright, kFirstShelfY, boardY(kShelves), kBackHalf);
    box(kCaseX + kUpright, end - kUpright, 0.0, kFirstShelfY, kCaseHalfDepth - 0.03);
    for (int board = 1; board < kShelves; ++board)
        box(kCaseX + kUpright, end - kUpright, boardY(board) - kBoard, boardY(board), kCaseHalfDepth - 0.01);
    box(kCaseX + kUpright, end - kUpright, boardY(kShelves) - kBoard, kCaseY, kCaseHalfDepth - 0.01);
    return mesh;
}

Mesh caseBooks(std::uint32_t seed) {
    Mesh mesh;
    Random random(seed);
    const double half = 0.5 * kCaseLength;
    for (const double face : {-1.0, 1.0})
        for (int shelf = 0; shelf < kShelves; ++shelf)
            for (int part = 0; part < 2; ++part)
                appendRows(mesh, random, {{0.0, boardY(shelf), face * kBackHalf}, kRight, face * kForward},
                           kCaseX + part * half + kUpright, kCaseX + (part + 1) * half - kUpright, kBookDepth);
    return mesh;
}

Mesh upperBoards() {
    Mesh mesh;
    const double front = kHalfWidth - kUpperShelfDepth;
    for (int board = 0; board <= kUpperShelves; ++board) {
        const double y = kUpperShelfY + board * kShelfSpacing;
        appendBox(mesh, {front, y - kBoard, -kHalfLength}, {kHalfWidth, y, kHalfLength});
    }
    const double top = kUpperShelfY + kUpperShelves * kShelfSpacing;
    for (int i = 0; i <= kCases; ++i) {
        const double z = -kHalfLength + i * kCaseSpacing;
        appendBox(mesh, {front, kGalleryFloorY, z - 0.5 * kUpright}, {kHalfWidth, top, z + 0.5 * kUpright});
    }
    return mesh;
}

Mesh upperBooks() {
    Mesh mesh;
    Random random(71);
    for (int shelf = 0; shelf < kUpperShelves; ++shelf)
        for (int i = 0; i < kCases; ++i) {
            const double z = -kHalfLength + i * kCaseSpacing;
            appendRows(mesh, random, {{kHalfWidth, kUpperShelfY + shelf * kShelfSpacing, 0.0}, kForward, -kRight},
                       z + kUpright, z + kCaseSpacing - kUpright, kUpperShelfDepth - 0.05);
        }
    return mesh;
}

Mesh desk() {
    Mesh mesh;
    constexpr double kHalfX = 0.55, kHalfZ = 1.3, kTop = 0.04;
    appendBox(mesh, {-kHalfX, kDeskY - kTop, -kHalfZ}, {kHalfX, kDeskY, kHalfZ});
    for (const double end : {-1.0, 1.0}) {
        const double z = end * (kHalfZ - 0.15);
        appendBox(mesh, {-kHalfX + 0.08, 0.0, z - 0.03}, {kHalfX - 0.08, kDeskY - kTop, z + 0.03});
    }
    appendBox(mesh, {-0.03, 0.25, -kHalfZ + 0.18}, {0.03, kDeskY - kTop, kHalfZ - 0.18});
    return mesh;
}

Mesh benches() {
    Mesh mesh;
    constexpr double kX = 0.88, kHalfX = 0.16, kHalfZ = 1.15, kSeatY = 0.45;
    for (const double side : {-1.0, 1.0}) {
        const double x = side * kX;
        appendBox(mesh, {x - kHalfX, kSeatY - 0.05, -kHalfZ}, {x + kHalfX, kSeatY, kHalfZ});
        for (const double end : {-1.0, 1.0}) {
            const double z = end * (kHalfZ - 0.12);
            appendBox(mesh, {x - kHalfX + 0.03, 0.0, z - 0.03}, {x + kHalfX - 0.03, kSeatY - 0.05, z + 0.03});
        }
    }
    return mesh;
}

Mesh deskLampStands() {
    Mesh mesh;
    for (int lamp = 0; lamp < kDeskLamps; ++lamp) {
        const double z = deskLampZ(lamp);
        appendBox(mesh, {-0.06, kDeskY, z - 0.08}, {0.06, kDeskY + 0.018, z + 0.08});
        appendBox(mesh, {-0.009, kDeskY + 0.018, z - 0.009}, {0.009, kShadeY + 0.06, z + 0.009});
    }
    return mesh;
}

Mesh deskLampShades() {
    Mesh mesh;
    constexpr double kRadius = 0.075, kHalfZ = 0.17;
    constexpr int kSteps = 8;
    for (int lamp = 0; lamp < kDeskLamps; ++lamp) {
        const double z = deskLampZ(lamp);
        Profile half({kRadius, kShadeY});
        half.arcAround({0.0, kShadeY}, std::numbers::pi, kSteps);
        appendMoulding(mesh, half, z - kHalfZ, z + kHalfZ);
        for (const double end : {-1.0, 1.0})
            appendPatch(mesh, kSteps, 1, [&](double u, double v) {
                const double angle = std::numbers::pi * u;
                return SurfacePoint{
                    {v * kRadius * std::cos(angle), kShadeY + v * kRadius * std::sin(angle), z + end * kHalfZ},
                    {0.0, 0.0, end},
                    {u, v}};
            });
    }
    return mesh;
}

Mesh papers() {
    Mesh mesh;
    constexpr double kHalfX = 0.148, kHalfZ = 0.105, kThick = 0.003, kX = 0.32;
    Random random(404);
    for (int lamp = 0; lamp < kDeskLamps; ++lamp) {
        for (const double side : {-1.0, 1.0}) {
            const double x = side * kX + random.between(-0.04, 0.04), z = deskLampZ(lamp) + random.between(-0.1, 0.1);
            appendBox(mesh, {x - kHalfX, kDeskY, z - kHalfZ}, {x + kHalfX, kDeskY + kThick, z + kHalfZ});
        }
    }
    return mesh;
}

Mesh luminaires() {
    Mesh mesh;
    constexpr double kHalfX = 0.25, kHalfZ = 0.6, kFrame = 0.02, kRod = 0.008; // a frame around each sheet
    constexpr int kRows = 24;
    for (int row = 0; row < kRows; ++row) {
        const double z = -kHalfLength + (row + 0.5) * 2.0 * kHalfLength / kRows;
        for (const double x : {-3.4, -1.2, 1.2, 3.4}) {
            for (const double edge : {-1.0, 1.0}) {
                const double frameX = x + edge * (kHalfX + 0.5 * kFrame), frameZ = z + edge * (kHalfZ + 0.5 * kFrame);
                appendBox(mesh, {frameX - 0.5 * kFrame, kLuminaireY - kFrame, z - kHalfZ},
                          {frameX + 0.5 * kFrame, kLuminaireY + kFrame, z + kHalfZ});
                appendBox(mesh, {x - kHalfX, kLuminaireY - kFrame, frameZ - 0.5 * kFrame},
                          {x + kHalfX, kLuminaireY + kFrame, frameZ + 0.5 * kFrame});
                appendBox(mesh, {x - kRod, kLuminaireY + kFrame, frameZ - kRod}, {x + kRod, kCeilingY, frameZ + kRod});
            }
        }
    }
    return mesh;
}

Mesh fixtures() {
    Mesh mesh;
    appendBox(mesh, {kWasherX - 0.05, kWasherY + 0.04, -kHalfLength}, {kWasherX + 0.05, kWasherY + 0.09, kHalfLength});
    for (int i = 0; i <= kCases; ++i) { // brackets from the wall
        const double z = -kHalfLength + i * kCaseSpacing;
        appendBox(mesh, {kWasherX + 0.05, kWasherY + 0.05, z - 0.015}, {kHalfWidth, kWasherY + 0.08, z + 0.015});
    }
    return mesh;
}

} // namespace tessera::scenes::builtin::lamps
