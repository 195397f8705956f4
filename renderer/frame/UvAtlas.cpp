#include "renderer/frame/UvAtlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

namespace tessera::frame {

namespace {

/// Tolerated fraction of overlapping texels: a texel may lie in two triangles along their common edge.
constexpr double kMostOverlapping = 0.01;
constexpr float kMostOutside = 1e-4f; ///< rounding tolerance of texture coordinates
constexpr int kOverlapSideTexels = 1024;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// A triangle in texels and in world space.
struct Triangle {
    std::array<glm::dvec2, 3> places;
    std::array<glm::dvec3, 3> cornersWS;
    glm::dvec3 alongU{0.0}, alongV{0.0}; ///< metres per texel
    bool hasArea = false;                ///< in texels and in world space

    glm::dvec3 pointWS(const glm::dvec2& place) const {
        const glm::dvec2 offset = place - places[0];
        return cornersWS[0] + offset.x * alongU + offset.y * alongV;
    }
    /// Position in texels of a point in its plane.
    glm::dvec2 placeOf(const glm::dvec3& inPlaneWS) const {
        const glm::dvec3 offset = inPlaneWS - cornersWS[0];
        const double uu = glm::dot(alongU, alongU), uv = glm::dot(alongU, alongV), vv = glm::dot(alongV, alongV);
        const double u = glm::dot(offset, alongU), v = glm::dot(offset, alongV);
        return places[0] + glm::dvec2(vv * u - uv * v, uu * v - uv * u) / (uu * vv - uv * uv);
    }
};

Triangle triangleOf(const scenes::Mesh& mesh, const glm::dmat4& worldFromObject, const UvAtlas& atlas,
                    std::size_t number) {
    Triangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = mesh.indices[3 * number + corner];
        triangle.places[corner] = atlas.placeOf(mesh.texCoords[0][vertex]);
        triangle.cornersWS[corner] =
            glm::dvec3(worldFromObject * glm::dvec4(glm::dvec3(mesh.positionsOS[vertex]), 1.0));
    }
    const glm::dvec2 edge1 = triangle.places[1] - triangle.places[0], edge2 = triangle.places[2] - triangle.places[0];
    const glm::dvec3 side1 = triangle.cornersWS[1] - triangle.cornersWS[0];
    const glm::dvec3 side2 = triangle.cornersWS[2] - triangle.cornersWS[0];
    const double area = cross(edge1, edge2);
    if (area == 0.0) return triangle;
    triangle.alongU = (side1 * edge2.y - side2 * edge1.y) / area;
    triangle.alongV = (side2 * edge1.x - side1 * edge2.x) / area;
    const double metres2 = glm::length(glm::cross(triangle.alongU, triangle.alongV));
    triangle.hasArea = std::isfinite(metres2) && metres2 > 0.0;
    return triangle;
}

UvStep stepOf(const Triangle& triangle) {
    if (!triangle.hasArea) return {};
    const double u = glm::length(triangle.alongU);
    const double across = glm::dot(triangle.alongU, triangle.alongV) / u;
    const double area = glm::length(glm::cross(triangle.alongU, triangle.alongV));
    return {u, area / u, -across / u};
}

/// An edge of a triangle, from corner `edge` to the next.
struct Edge {
    std::size_t triangle;
    int edge;
};

/// Identifies a vertex by its position, so that vertices split at texture seams are the same.
using PlaceOS = std::tuple<float, float, float>;
PlaceOS placeOSOf(const glm::vec3& positionOS) {
    return {positionOS.x, positionOS.y, positionOS.z};
}

/// The other triangle at an edge, and whether both have the same texture coordinates there. -1 for edges of more or
/// fewer than two triangles.
struct Neighbour {
    std::int32_t triangle = -1;
    int edge = 0;
    bool isInChart = false;
};

std::vector<Neighbour> neighboursOf(const scenes::Mesh& mesh, const std::vector<Triangle>& triangles) {
    std::map<std::pair<PlaceOS, PlaceOS>, std::vector<Edge>> edges;
    const auto vertexOf = [&](std::size_t triangle, int corner) {
        return mesh.indices[3 * triangle + std::size_t(corner % 3)];
    };
    for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle) {
        if (!triangles[triangle].hasArea) continue;
        for (int edge = 0; edge < 3; ++edge) {
            const PlaceOS a = placeOSOf(mesh.positionsOS[vertexOf(triangle, edge)]);
            const PlaceOS b = placeOSOf(mesh.positionsOS[vertexOf(triangle, edge + 1)]);
            edges[std::minmax(a, b)].push_back({triangle, edge});
        }
    }
    std::vector<Neighbour> neighbours(3 * triangles.size());
    for (const auto& [places, sharing] : edges) {
        if (sharing.size() != 2) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            const Edge& own = sharing[i];
            const Edge& other = sharing[1 - i];
            const auto texCoord = [&](const Edge& edge, int corner) {
                return mesh.texCoords[0][vertexOf(edge.triangle, edge.edge + corner)];
            };
            const bool isSameWay = placeOSOf(mesh.positionsOS[vertexOf(own.triangle, own.edge)]) ==
                                   placeOSOf(mesh.positionsOS[vertexOf(other.triangle, other.edge)]);
            const bool isInChart = texCoord(own, 0) == texCoord(other, isSameWay ? 0 : 1) &&
                                   texCoord(own, 1) == texCoord(other, isSameWay ? 1 : 0);
            neighbours[3 * own.triangle + std::size_t(own.edge)] = {std::int32_t(other.triangle), other.edge,
                                                                    isInChart};
        }
    }
    return neighbours;
}

/// Numbers the charts of the triangles, from 1; 0 for triangles without area. Returns the number of charts.
std::size_t numberCharts(const std::vector<Triangle>& triangles, const std::vector<Neighbour>& neighbours,
                         std::vector<std::int32_t>& charts) {
    charts.assign(triangles.size(), 0);
    std::int32_t count = 0;
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < triangles.size(); ++first) {
        if (charts[first] != 0 || !triangles[first].hasArea) continue;
        charts[first] = ++count;
        open.push_back(first);
        while (!open.empty()) {
            const std::size_t triangle = open.back();
            open.pop_back();
            for (std::size_t edge = 0; edge < 3; ++edge) {
                const Neighbour& neighbour = neighbours[3 * triangle + edge];
                if (neighbour.triangle < 0 || !neighbour.isInChart || charts[std::size_t(neighbour.triangle)] != 0)
                    continue;
                charts[std::size_t(neighbour.triangle)] = count;
                open.push_back(std::size_t(neighbour.triangle));
            }
        }
    }
    return std::size_t(count);
}

/// Calls `visit(u, v)` for texels whose centres lie in a box, within the atlas.
template <typename Visit>
void visitTexels(const UvAtlas& atlas, const glm::dvec2& low, const glm::dvec2& high, Visit visit) {
    const auto bound = [&](double place) { return int(std::clamp(place, 0.0, double(atlas.sideTexels))); };
    for (int v = bound(std::ceil(low.y - 0.5)); v < bound(std::floor(high.y - 0.5) + 1.0); ++v)
        for (int u = bound(std::ceil(low.x - 0.5)); u < bound(std::floor(high.x - 0.5) + 1.0); ++u) visit(u, v);
}

/// Whether a position lies in a triangle, its edges included.
bool isWithin(const Triangle& triangle, const glm::dvec2& place) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 along = triangle.places[(i + 1) % 3] - triangle.places[i];
        const double side = cross(along, place - triangle.places[i]);
        least = std::min(least, side);
        most = std::max(most, side);
    }
    return least >= 0.0 || most <= 0.0;
}

/// Whether the position lies inside by more than its rounding error.
bool isDeepWithin(const Triangle& triangle, const glm::dvec2& place) {
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 along = triangle.places[(i + 1) % 3] - triangle.places[i];
        if (std::abs(cross(along, place - triangle.places[i])) <= 1e-4 * glm::length(along)) return false;
    }
    return true;
}

/// Where the surface continues past an edge: unfolds the position into the other triangle, or mirrors it at the edge.
glm::dvec2 continuedAt(const glm::dvec2& place, const Triangle& own, int edge, const Triangle* other, int otherEdge) {
    const auto corner = [](const Triangle& triangle, int i) { return triangle.cornersWS[std::size_t(i % 3)]; };
    const glm::dvec3 from = corner(own, edge), along = glm::normalize(corner(own, edge + 1) - from);
    const auto inward = [&](const Triangle& triangle, int i) {
        const glm::dvec3 toThird = corner(triangle, i + 2) - from;
        return glm::normalize(toThird - glm::dot(toThird, along) * along);
    };
    const glm::dvec3 offset = own.pointWS(place) - from;
    const glm::dvec3 ownInward = inward(own, edge);
    const double outMetres = -glm::dot(offset, ownInward);
    const glm::dvec3& goesOn = other ? inward(*other, otherEdge) : ownInward;
    const Triangle& reached = other ? *other : own;
    return reached.placeOf(from + glm::dot(offset, along) * along + outMetres * goesOn);
}

} // namespace

UvAtlas makeUvAtlas(const scenes::Mesh& mesh, const glm::dmat4& worldFromObject, int sideTexels, int borderTexels,
                    int reachTexels) {
    UvAtlas atlas;
    atlas.sideTexels = sideTexels;
    atlas.borderTexels = borderTexels;
    atlas.texels.resize(std::size_t(sideTexels) * std::size_t(sideTexels));
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < mesh.indices.size() / 3; ++i) {
        triangles.push_back(triangleOf(mesh, worldFromObject, atlas, i));
        atlas.steps.push_back(stepOf(triangles.back()));
    }
    const std::vector<Neighbour> neighbours = neighboursOf(mesh, triangles);
    std::vector<std::int32_t> charts;
    atlas.chartCount = numberCharts(triangles, neighbours, charts);
    const auto texelAt = [&](int u, int v) -> UvTexel& {
        return atlas.texels[std::size_t(v) * std::size_t(sideTexels) + std::size_t(u)];
    };

    std::size_t covered = 0;
    std::vector<bool> isShared(atlas.texels.size(), false);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& triangle = triangles[i];
        if (!triangle.hasArea) continue;
        const auto& [a, b, c] = triangle.places;
        visitTexels(atlas, glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](int u, int v) {
            const glm::dvec2 middle = glm::dvec2(u, v) + 0.5;
            if (!isWithin(triangle, middle)) return;
            UvTexel& texel = texelAt(u, v);
            if (!texel.isCovered) {
                texel = {std::int32_t(i), charts[i], true, middle};
                ++covered;
            } else if (isDeepWithin(triangle, middle) && isDeepWithin(triangles[std::size_t(texel.triangle)], middle)) {
                isShared[std::size_t(&texel - atlas.texels.data())] = true;
            }
        });
    }
    const auto shared = std::ranges::count(isShared, true);
    atlas.overlapping = covered > 0 ? double(shared) / double(covered) : 0.0;

    // Outside charts, by the nearest edge. The fallbacks serve where the continued surface is not covered.
    struct Instead {
        glm::dvec2 mirrored{0.0}, nearest{0.0};
    };
    std::vector<Instead> instead(atlas.texels.size());
    std::vector<double> nearest(atlas.texels.size(), double(reachTexels));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!triangles[i].hasArea) continue;
        for (int edge = 0; edge < 3; ++edge) {
            const Neighbour& neighbour = neighbours[3 * i + std::size_t(edge)];
            if (neighbour.triangle >= 0 && neighbour.isInChart) continue;
            const glm::dvec2 a = triangles[i].places[std::size_t(edge)];
            const glm::dvec2 b = triangles[i].places[std::size_t((edge + 1) % 3)];
            const glm::dvec2 third = triangles[i].places[std::size_t((edge + 2) % 3)];
            const double length2 = glm::dot(b - a, b - a);
            const double inner = cross(b - a, third - a);
            visitTexels(atlas, glm::min(a, b) - double(reachTexels), glm::max(a, b) + double(reachTexels),
                        [&](int u, int v) {
                            UvTexel& texel = texelAt(u, v);
                            if (texel.isCovered) return;
                            const glm::dvec2 middle = glm::dvec2(u, v) + 0.5;
                            if (cross(b - a, middle - a) * inner > 0.0) return; // on the triangle's side
                            const double share = std::clamp(glm::dot(middle - a, b - a) / length2, 0.0, 1.0);
                            const double distance = glm::distance(middle, a + share * (b - a));
                            double& least = nearest[std::size_t(&texel - atlas.texels.data())];
                            if (!(distance < least)) return;
                            least = distance;
                            const Triangle* const other =
                                neighbour.triangle >= 0 ? &triangles[std::size_t(neighbour.triangle)] : nullptr;
                            texel = {std::int32_t(i), charts[i], false,
                                     continuedAt(middle, triangles[i], edge, other, neighbour.edge)};
                            instead[std::size_t(&texel - atlas.texels.data())] = {
                                continuedAt(middle, triangles[i], edge, nullptr, 0), a + share * (b - a)};
                        });
        }
    }
    // Near corners of charts, the other triangle may not extend to the continued position.
    const auto isKnown = [&](const glm::dvec2& place) {
        const glm::dvec2 low = glm::floor(place - 0.5);
        for (int i = 0; i < 4; ++i) {
            const glm::dvec2 near = low + glm::dvec2(i & 1, i >> 1);
            if (near.x >= 0.0 && near.y >= 0.0 && near.x < double(sideTexels) && near.y < double(sideTexels) &&
                texelAt(int(near.x), int(near.y)).isCovered)
                return true;
        }
        return false;
    };
    for (std::size_t i = 0; i < atlas.texels.size(); ++i) {
        UvTexel& texel = atlas.texels[i];
        if (texel.isCovered || texel.chart == 0 || isKnown(texel.continued)) continue;
        if (isKnown(instead[i].mirrored))
            texel.continued = instead[i].mirrored;
        else if (isKnown(instead[i].nearest))
            texel.continued = instead[i].nearest;
        else
            texel = {};
    }
    return atlas;
}

std::string unwrapProblem(const scenes::Mesh& mesh) {
    if (mesh.texCoords[0].empty()) return "it has no texture coordinates; unwrap it";
    for (const std::uint32_t vertex : mesh.indices) {
        const glm::vec2 texCoord = mesh.texCoords[0][vertex];
        const glm::vec2 outside = glm::abs(texCoord - 0.5f) - 0.5f;
        if (!(outside.x <= kMostOutside && outside.y <= kMostOutside))
            return fmt::format("its texture coordinates go to {:.4g}, {:.4g}; unwrap it into 0 to 1", texCoord.x,
                               texCoord.y);
    }
    const UvAtlas atlas = makeUvAtlas(mesh, glm::dmat4(1.0), kOverlapSideTexels, 0, 0);
    if (atlas.chartCount == 0)
        return "no triangle has an area both in space and in its texture; unwrap it, or remove triangles of no size";
    if (atlas.overlapping > kMostOverlapping)
        return fmt::format("several of its triangles lie in {:.0f} % of its texture; unwrap it so that none overlap",
                           100.0 * atlas.overlapping);
    return "";
}

} // namespace tessera::frame
