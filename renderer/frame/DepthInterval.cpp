#include "renderer/frame/DepthInterval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/Median.h"

namespace tessera::frame {

namespace {

std::array<glm::dvec3, 8> cornersOf(const scenes::Box3& box) {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[std::size_t(i)] = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                   (i & 4) != 0 ? box.max.z : box.min.z};
    return corners;
}

/// Visible extent of the bounding boxes.
struct Seen {
    double nearest = std::numeric_limits<double>::infinity(); ///< along the view axis
    double farthest = -std::numeric_limits<double>::infinity();
    double across = 0.0; ///< largest distance from the view axis
    double reach = 0.0;  ///< the largest SurfaceBounds::reachMetres

    void add(const glm::dvec3& placeVS) {
        nearest = std::min(nearest, -placeVS.z);
        farthest = std::max(farthest, -placeVS.z);
        across = std::max(across, glm::length(glm::dvec2(placeVS)));
    }
};

/// Margins beyond the sides of the image, since fp32 rounding may move geometry into it: fractions of the image's size
/// and of the distance of the box's farthest corner.
constexpr double kSideMargin = 1e-4;
constexpr double kRoundingMargin = 1e-6;

/// A frustum plane in view space: dot(normal, place) <= offset inside.
struct Side {
    glm::dvec3 normal;
    double offset;
    double beyond(const glm::dvec3& placeVS) const { return glm::dot(normal, placeVS) - offset; }
};

std::array<Side, 5> sidesOf(const scenes::Camera& camera, const glm::dvec2& halfExtent, double farthestMetres) {
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const double margin = kRoundingMargin * farthestMetres;
    std::array<Side, 5> sides;
    for (std::size_t i = 0; i < 4; ++i) {
        const int axis = int(i) / 2;
        const double half = halfExtent[axis] * (1.0 + kSideMargin);
        sides[i] = {{0.0, 0.0, isPerspective ? half : 0.0}, margin + (isPerspective ? 0.0 : half)};
        sides[i].normal[axis] = i % 2 == 0 ? 1.0 : -1.0;
    }
    sides[4] = {{0.0, 0.0, 1.0}, 0.0}; // in front of the eye
    return sides;
}

using Polygon = std::vector<glm::dvec3>;

/// Clips a polygon against a plane. Source: Sutherland and Hodgman 1974, "Reentrant Polygon Clipping".
Polygon clipped(const Polygon& polygon, const Side& side) {
    Polygon within;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = side.beyond(from), b = side.beyond(to);
        if (a <= 0.0) within.push_back(from);
        if ((a <= 0.0) != (b <= 0.0)) within.push_back(from + (a / (a - b)) * (to - from));
    }
    return within;
}

/// Adds the visible part of a box: its faces clipped by the frustum planes, and the eye if it is inside the box.
void addBox(Seen& seen, const SurfaceBounds& bounds, const scenes::Camera& camera, const glm::dvec2& halfExtent) {
    const glm::dmat3 viewFromWorld = glm::inverse(glm::dmat3(camera.worldFromCamera));
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    std::array<glm::dvec3, 8> cornersVS = cornersOf(bounds.boxWS);
    double farthestMetres = 0.0;
    for (glm::dvec3& corner : cornersVS) {
        corner = viewFromWorld * (corner - eyeWS);
        farthestMetres = std::max(farthestMetres, glm::length(corner));
    }
    Seen own;
    bool isWhole = true;
    const std::array<Side, 5> sides = sidesOf(camera, halfExtent, farthestMetres);
    for (const Side& side : sides) {
        const auto isBeyond = [&](const glm::dvec3& corner) { return side.beyond(corner) > 0.0; };
        const std::ptrdiff_t beyond = std::count_if(cornersVS.begin(), cornersVS.end(), isBeyond);
        if (beyond == 8) return;
        isWhole = isWhole && beyond == 0;
    }
    if (isWhole) {
        for (const glm::dvec3& corner : cornersVS) own.add(corner);
    } else {
        constexpr std::size_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
        for (const auto& face : kFaces) {
            Polygon polygon;
            for (const std::size_t corner : face) polygon.push_back(cornersVS[corner]);
            for (const Side& side : sides) polygon = clipped(polygon, side);
            for (const glm::dvec3& place : polygon) own.add(place);
        }
        const glm::dvec3 room(kRoundingMargin * farthestMetres);
        const bool isInside = glm::all(glm::lessThanEqual(bounds.boxWS.min - room, eyeWS)) &&
                              glm::all(glm::lessThanEqual(eyeWS, bounds.boxWS.max + room));
        if (isInside) own.add(glm::dvec3(0.0));
    }
    if (!(own.nearest <= own.farthest) || own.farthest < camera.nearMetres || own.nearest > camera.farMetres) return;
    seen.nearest = std::min(seen.nearest, std::max(own.nearest, camera.nearMetres));
    seen.farthest = std::max(seen.farthest, std::min(own.farthest, camera.farMetres));
    seen.across = std::max(seen.across, own.across);
    seen.reach = std::max(seen.reach, bounds.reachMetres);
}

DepthInterval ownInterval(const scenes::Camera& camera) {
    DepthInterval own{camera.nearMetres, camera.farMetres, 0.0, false};
    own.isEven = camera.projection == scenes::Projection::Orthographic;
    // Orthographic depth needs a finite far end.
    if (own.isEven && std::isinf(own.farMetres)) own.farMetres = own.nearMetres + 2000.0 * camera.halfHeightMetres;
    return own;
}

/// SurfaceBounds::usualMetres.
double usualMetresOf(const std::vector<glm::dvec3>& cornersWS) {
    const auto medianBy = [&](auto number) {
        std::vector<double> numbers(cornersWS.size());
        std::ranges::transform(cornersWS, numbers.begin(), number);
        return medianOf(std::move(numbers));
    };
    glm::dvec3 medianWS;
    for (int axis = 0; axis < 3; ++axis)
        medianWS[axis] = medianBy([axis](const glm::dvec3& cornerWS) { return cornerWS[axis]; });
    return medianBy([&](const glm::dvec3& cornerWS) { return glm::distance(cornerWS, medianWS); });
}

/// SurfaceBounds::textureSideMetres; `cornersWS` holds three corners per triangle.
double textureSideMetresOf(const scenes::Mesh& mesh, std::span<const glm::dvec3> cornersWS) {
    if (mesh.texCoords[0].empty()) return 0.0;
    double square = 0.0, covered = 0.0;
    for (std::size_t i = 0; i + 2 < cornersWS.size(); i += 3) {
        const auto place = [&](std::size_t c) { return glm::dvec2(mesh.texCoords[0][mesh.indices[i + c]]); };
        const glm::dvec2 a = place(1) - place(0), b = place(2) - place(0);
        covered += std::abs(a.x * b.y - a.y * b.x);
        square += glm::length(glm::cross(cornersWS[i + 1] - cornersWS[i], cornersWS[i + 2] - cornersWS[i]));
    }
    return covered > 0.0 ? std::sqrt(square / covered) : 0.0;
}

} // namespace

std::vector<SurfaceBounds> surfaceBounds(const scenes::Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    std::vector<SurfaceBounds> all;
    int number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            const scenes::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            SurfaceBounds bounds;
            bounds.instance = number++;
            std::vector<glm::dvec3> cornersWS;
            for (const std::uint32_t index : mesh.indices) {
                cornersWS.emplace_back(worldFromNode[node] * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0));
                bounds.boxWS.extend(cornersWS.back());
            }
            if (bounds.boxWS.empty()) continue;
            bounds.nodeWS = glm::dvec3(worldFromNode[node][3]);
            bounds.triangles = cornersWS.size() / 3;
            for (std::size_t i = 0; i < cornersWS.size(); ++i) {
                const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
                bounds.longestMetres = std::max(bounds.longestMetres, glm::distance(cornersWS[i], cornersWS[next]));
            }
            bounds.usualMetres = usualMetresOf(cornersWS);
            bounds.textureSideMetres = textureSideMetresOf(mesh, cornersWS);
            for (const glm::dvec3& corner : cornersOf(bounds.boxWS))
                bounds.reachMetres =
                    std::max(bounds.reachMetres, glm::distance(corner, glm::dvec3(worldFromNode[node][3])));
            all.push_back(bounds);
        }
    }
    return all;
}

double usualMetres(std::span<const SurfaceBounds> bounds) {
    const auto most = std::ranges::max_element(bounds, {}, &SurfaceBounds::triangles);
    return most == bounds.end() ? 0.0 : most->usualMetres;
}

DepthInterval depthInterval(const scenes::Camera& camera, const glm::dvec2& halfExtent,
                            std::span<const SurfaceBounds> bounds) {
    DepthInterval interval = ownInterval(camera);
    Seen seen;
    const bool isOrthographic = camera.projection == scenes::Projection::Orthographic;
    for (const SurfaceBounds& one : bounds) {
        addBox(seen, one, camera, halfExtent);
        const bool isTooLong =
            std::min(seen.farthest, camera.farMetres) > 2.0 * std::max(seen.nearest, camera.nearMetres);
        if (isTooLong && !isOrthographic) return interval;
    }
    if (!(seen.nearest <= seen.farthest)) return interval;

    // Margin for rounding of positions relative to the middle, and of vertices relative to their nodes.
    const double span = seen.farthest - seen.nearest;
    const double room = span / 8.0 + 1e-3 * (span + seen.across) + 1e-6 * seen.reach;
    const double nearMetres = std::max(camera.nearMetres, seen.nearest - room);
    const double farMetres = std::min(camera.farMetres, seen.farthest + room);
    if (!(farMetres > nearMetres) || !std::isfinite(farMetres)) return interval;
    if (!isOrthographic && farMetres > 2.0 * nearMetres) return interval;
    interval.nearMetres = nearMetres;
    interval.farMetres = farMetres;
    interval.originMetres = 0.5 * (nearMetres + farMetres);
    interval.isEven = true;
    return interval;
}

} // namespace tessera::frame
