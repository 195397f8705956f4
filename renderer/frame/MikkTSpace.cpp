#include "renderer/frame/MikkTSpace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace tessera::frame {

namespace {

using Corner = std::size_t; ///< position in the mesh's indices: three per triangle
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A difference of vectors is rounding noise if it is shorter than this fraction of them.
constexpr double kSmallestShare = 1e-12;

/// If the angles of all triangles sum to less, in radians, they get equal weights: rounding dominates such slivers.
constexpr double kSmallestAngle = 1e-9;

Corner turned(Corner corner, Corner by) {
    return corner / 3 * 3 + (corner + by) % 3;
}

/// The normal at unit length, or 0 if its length is 0.
glm::dvec3 unitNormal(const glm::vec3& normal) {
    const double length = glm::length(glm::dvec3(normal));
    return length > 0.0 ? glm::dvec3(normal) / length : glm::dvec3(0.0);
}

/// `vector` projected into the plane of a unit normal, normalised; 0 if the projection vanishes or the normal is 0.
glm::dvec3 laidInto(const glm::dvec3& normal, const glm::dvec3& vector) {
    const glm::dvec3 flat = vector * glm::dot(normal, normal) - normal * glm::dot(normal, vector);
    const double length = glm::length(flat);
    return length > kSmallestShare * glm::length(vector) ? flat / length : glm::dvec3(0.0);
}

/// For each vertex, the first one with equal position, normal and texture coordinates.
std::vector<std::uint32_t> weldedVertices(const scenes::Mesh& mesh, const std::vector<glm::vec2>& uv) {
    struct Same {
        std::array<float, 8> values;
        bool operator==(const Same&) const = default;
    };
    const auto hash = [](const Same& same) {
        char bytes[sizeof same.values];
        std::memcpy(bytes, same.values.data(), sizeof bytes);
        return std::hash<std::string_view>{}(std::string_view(bytes, sizeof bytes));
    };
    std::unordered_map<Same, std::uint32_t, decltype(hash)> first(mesh.positionsOS.size(), hash);
    std::vector<std::uint32_t> welded;
    welded.reserve(mesh.positionsOS.size());
    for (std::uint32_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::vec3 &p = mesh.positionsOS[i], &n = mesh.normalsOS[i];
        Same same{{p.x, p.y, p.z, n.x, n.y, n.z, uv[i].x, uv[i].y}};
        for (float& value : same.values) value += 0.0f; // -0 is 0
        welded.push_back(first.emplace(same, i).first->second);
    }
    return welded;
}

/// Texture mapping of a triangle.
struct Face {
    glm::dvec3 alongU{0.0}; ///< object space, of any length
    int sense = 0; ///< handedness: 1, -1 if the texture is mirrored, 0 if it has no area and has not inherited one yet
    bool saysNothing = false;
    bool hasNoArea = false; ///< in object space: two of its corners coincide
};

class MikkTSpace {
public:
    MikkTSpace(const scenes::Mesh& mesh, const std::vector<glm::vec2>& uv, const glm::dmat2& textureFromUv)
        : mesh_(mesh), uv_(uv), vertices_(weldedVertices(mesh, uv)), across_(mesh.indices.size(), kNone),
          groupOf_(mesh.indices.size(), kNone) {
        for (Corner corner = 0; corner + 2 < mesh.indices.size(); corner += 3)
            faces_.push_back(faceAt(corner, textureFromUv));
        findNeighbours();
        for (Corner corner = 0; corner < 3 * faces_.size(); ++corner) {
            const Face& face = faces_[corner / 3];
            if (!face.hasNoArea && !face.saysNothing && groupOf_[corner] == kNone) gather(corner);
        }
        joinFacesWithoutArea();
    }

    std::vector<glm::vec4> perCorner() const {
        std::vector<glm::vec4> tangents;
        tangents.reserve(groupOf_.size());
        for (Corner corner = 0; corner < groupOf_.size(); ++corner) {
            const std::uint32_t group = groupOf_[corner];
            tangents.push_back(
                group != kNone ? tangents_[group]
                               : glm::vec4(anyPerpendicular(glm::dvec3(mesh_.normalsOS[mesh_.indices[corner]])), -1));
        }
        return tangents;
    }

private:
    std::uint32_t vertex(Corner corner) const { return vertices_[mesh_.indices[corner]]; }
    glm::dvec3 position(Corner corner) const { return glm::dvec3(mesh_.positionsOS[mesh_.indices[corner]]); }

    Face faceAt(Corner corner, const glm::dmat2& textureFromUv) const {
        Face face;
        const glm::dvec3 a = position(corner), b = position(corner + 1), c = position(corner + 2);
        face.hasNoArea = a == b || b == c || c == a;
        const auto uv = [&](Corner of) { return glm::dvec2(uv_[mesh_.indices[of]]); };
        // Coordinates have v downwards, tangents upwards.
        const glm::dmat2 upwards = glm::dmat2(1.0, 0.0, 0.0, -1.0) * textureFromUv;
        const glm::dvec2 side1 = uv(corner + 1) - uv(corner), side2 = uv(corner + 2) - uv(corner);
        const glm::dvec2 along1 = upwards * side1, along2 = upwards * side2;
        // From the untransformed sides: rounding in the transformed ones would give a line an area.
        const double area = glm::determinant(upwards) * glm::determinant(glm::dmat2(side1, side2));
        const glm::dvec3 edge1 = b - a, edge2 = c - a;
        const auto grows = [&](double share1, double share2) {
            const glm::dvec3 direction = edge1 * share1 - edge2 * share2;
            const double sum = glm::length(edge1) * std::abs(share1) + glm::length(edge2) * std::abs(share2);
            return glm::length(direction) > kSmallestShare * sum ? direction : glm::dvec3(0.0);
        };
        face.sense = area > 0.0 ? 1 : -1;
        face.alongU = grows(along2.y, along1.y) * double(face.sense);
        const glm::dvec3 alongV = grows(along2.x, along1.x);
        face.saysNothing = area == 0.0 || face.alongU == glm::dvec3(0.0) || alongV == glm::dvec3(0.0);
        if (face.saysNothing) face.sense = 0;
        return face;
    }

    /// Pairs triangle edges that join the same vertices in opposite directions, in order of appearance.
    void findNeighbours() {
        struct DirectedSide {
            std::uint32_t low, high;
            Corner corner; ///< the edge runs from here to the next corner
        };
        std::vector<DirectedSide> sides;
        for (Corner corner = 0; corner < 3 * faces_.size(); ++corner) {
            if (faces_[corner / 3].hasNoArea) continue;
            const auto [low, high] = std::minmax({vertex(corner), vertex(turned(corner, 1))});
            sides.push_back({low, high, corner});
        }
        std::sort(sides.begin(), sides.end(), [](const DirectedSide& a, const DirectedSide& b) {
            return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
        });
        std::size_t oldest = 0; // of the unpaired edges, all of which run in one direction
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const auto isBetweenTheSame = [&](std::size_t other) {
                return sides[other].low == sides[i].low && sides[other].high == sides[i].high;
            };
            if (!isBetweenTheSame(oldest)) oldest = i;
            while (oldest < i && across_[sides[oldest].corner] != kNone) ++oldest;
            if (oldest == i || vertex(sides[oldest].corner) == vertex(sides[i].corner)) continue;
            across_[sides[oldest].corner] = std::uint32_t(sides[i].corner);
            across_[sides[i].corner] = std::uint32_t(sides[oldest].corner);
            ++oldest;
        }
    }

    /// Groups the corners that share `start`'s vertex and handedness and are connected by edges.
    void gather(Corner start) {
        const std::uint32_t group = std::uint32_t(tangents_.size());
        const int sense = faces_[start / 3].sense;
        const glm::dvec3 normal = unitNormal(mesh_.normalsOS[mesh_.indices[start]]);
        glm::dvec3 sum(0.0), weighedSum(0.0);
        double angles = 0.0;
        std::vector<Corner> open = {start};
        while (!open.empty()) {
            const Corner corner = open.back();
            open.pop_back();
            Face& face = faces_[corner / 3];
            if (groupOf_[corner] != kNone) continue;
            if (face.sense == 0) face.sense = sense; // the first group that reaches it decides
            if (face.sense != sense) continue;
            groupOf_[corner] = group;
            if (!face.saysNothing) {
                const double angle = angleAt(corner, normal);
                const glm::dvec3 direction = laidInto(normal, face.alongU);
                sum += direction;
                weighedSum += direction * angle;
                angles += angle;
            }
            const std::uint32_t ahead = across_[corner], behind = across_[turned(corner, 2)];
            if (ahead != kNone) open.push_back(turned(ahead, 1));
            if (behind != kNone) open.push_back(behind);
        }
        if (angles > kSmallestAngle) sum = weighedSum / angles;
        const double length = glm::length(sum);
        const glm::dvec3 tangent = length > kSmallestShare ? sum / length : anyPerpendicular(normal);
        tangents_.emplace_back(glm::vec3(tangent), float(sense));
    }

    /// The triangle's angle at a corner, projected along the normal. An edge along the normal gives a right angle.
    double angleAt(Corner corner, const glm::dvec3& normal) const {
        const glm::dvec3 here = position(corner);
        const glm::dvec3 ahead = laidInto(normal, position(turned(corner, 1)) - here);
        const glm::dvec3 behind = laidInto(normal, position(turned(corner, 2)) - here);
        const double cosine = glm::dot(ahead, behind);
        const double sine = glm::length(glm::cross(ahead, behind));
        return cosine == 0.0 && sine == 0.0 ? std::acos(0.0) : std::atan2(sine, cosine);
    }

    /// Gives the corners of degenerate triangles the tangent of the first other triangle at the same vertex.
    void joinFacesWithoutArea() {
        std::vector<Corner> firstAt(vertices_.size(), groupOf_.size());
        for (Corner corner = 3 * faces_.size(); corner-- > 0;)
            if (!faces_[corner / 3].hasNoArea) firstAt[vertex(corner)] = corner;
        for (Corner corner = 0; corner < 3 * faces_.size(); ++corner) {
            const Corner first = firstAt[vertex(corner)];
            if (faces_[corner / 3].hasNoArea && first < groupOf_.size()) groupOf_[corner] = groupOf_[first];
        }
    }

    const scenes::Mesh& mesh_;
    const std::vector<glm::vec2>& uv_;
    std::vector<std::uint32_t> vertices_; ///< welded, by vertex of the mesh
    std::vector<Face> faces_;
    std::vector<std::uint32_t> across_;  ///< by corner: start of the neighbour's edge that runs back along this one
    std::vector<std::uint32_t> groupOf_; ///< by corner
    std::vector<glm::vec4> tangents_;    ///< by group
};

} // namespace

glm::dvec3 anyPerpendicular(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

std::vector<glm::vec4> mikkTSpaceTangents(const scenes::Mesh& mesh, std::size_t texCoordSet,
                                          const glm::dmat2& textureFromUv) {
    const std::vector<glm::vec2>& uv = mesh.texCoords[texCoordSet];
    if (!uv.empty()) return MikkTSpace(mesh, uv, textureFromUv).perCorner();
    return MikkTSpace(mesh, std::vector<glm::vec2>(mesh.positionsOS.size()), textureFromUv).perCorner();
}

} // namespace tessera::frame
