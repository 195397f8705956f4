#include "validation/reference/Tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <map>
#include <optional>

#include "validation/reference/TangentFrame.h"

namespace tessera::reference {

namespace {

/// Directions in object space in which the texture coordinates grow.
struct Growth {
    glm::dvec3 u{0.0}, v{0.0};
    double area = 0.0; ///< of the triangle in the texture, signed
};

/// A direction whose tangential fraction is below this lies along the normal, up to rounding.
constexpr double kSmallestShare = 1e-12;

/// Angle at a vertex, in radians, that rounding can give slivers.
constexpr double kSmallestAngle = 1e-9;

glm::dvec3 madeUnit(const glm::dvec3& vector, const glm::dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : fallback;
}

/// Duff et al. 2017, listing 3, first vector.
glm::dvec3 perpendicularTo(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    return {1.0 - sign * n.x * n.x / (sign + n.z), -sign * n.x * n.y / (sign + n.z), -sign * n.x};
}

/// A mesh's triangles in texture coordinates.
class Texture {
public:
    Texture(const scenes::Mesh& mesh, const scenes::Material& material) : mesh_(mesh) {
        const scenes::TextureSlot slot = *tangentSlot(material);
        texCoords_ = &mesh.texCoords[std::size_t(material.texture(slot).texCoordSet)];
        textureFromUv_ = textureFromUv(material, slot);
    }

    /// Solves [edge1 edge2] = [u v] [uv1 uv2], then applies the chain rule; v upwards. Zero without texture area.
    Growth growthOf(std::size_t triangle) const {
        const auto at = [&](std::size_t k) { return glm::dvec3(mesh_.positionsOS[mesh_.indices[3 * triangle + k]]); };
        const auto uvAt = [&](std::size_t k) { return uv(mesh_.indices[3 * triangle + k]); };
        const glm::dmat2x3 edges(at(1) - at(0), at(2) - at(0));
        const glm::dmat2 sides(uvAt(1) - uvAt(0), uvAt(2) - uvAt(0));
        const double area = glm::determinant(sides) * glm::determinant(textureFromUv_);
        if (area == 0.0) return {};
        const glm::dmat2 edgesFromTexture = glm::inverse(sides) * glm::inverse(textureFromUv_);
        const glm::dmat2x3 directions = edges * edgesFromTexture;
        const auto unlessRounding = [&](glm::length_t column) {
            const double sum = glm::length(edges[0]) * std::abs(edgesFromTexture[column][0]) +
                               glm::length(edges[1]) * std::abs(edgesFromTexture[column][1]);
            return glm::length(directions[column]) > kSmallestShare * sum ? directions[column] : glm::dvec3(0.0);
        };
        return {unlessRounding(0), -unlessRounding(1), -area};
    }

    glm::dvec2 uv(std::uint32_t vertex) const {
        return texCoords_->empty() ? glm::dvec2(0.0) : glm::dvec2((*texCoords_)[vertex]);
    }

private:
    const scenes::Mesh& mesh_;
    const std::vector<glm::vec2>* texCoords_ = nullptr;
    glm::dmat2 textureFromUv_{1.0};
};

struct Corner {
    std::size_t triangle = 0;
    std::size_t k = 0;
    std::size_t index() const { return 3 * triangle + k; }
    Corner next() const { return {triangle, (k + 1) % 3}; }
    Corner previous() const { return {triangle, (k + 2) % 3}; }
    bool operator==(const Corner&) const = default;
};

class VertexFans {
public:
    VertexFans(const scenes::Mesh& mesh, const Texture& texture)
        : mesh_(mesh), triangles_(mesh.indices.size() / 3), tangents_(mesh.indices.size()),
          neighbours_(mesh.indices.size()) {
        weld(texture);
        for (std::size_t t = 0; t < triangles_; ++t) {
            growth_.push_back(texture.growthOf(t));
            const bool says = growth_[t].u != glm::dvec3(0.0) && growth_[t].v != glm::dvec3(0.0);
            orientations_.push_back(says ? std::optional(growth_[t].area > 0.0 ? 1.0 : -1.0) : std::nullopt);
            hasUvArea_.push_back(says);
        }
        meetNeighbours();
        for (std::size_t i = 0; i < 3 * triangles_; ++i) {
            const Corner corner{i / 3, i % 3};
            if (isDegenerate(corner.triangle) || !hasUvArea_[corner.triangle] || tangents_[i]) continue;
            walkFrom(corner);
        }
        copyToPointed();
    }

    std::vector<glm::dvec4> tangents() const {
        std::vector<glm::dvec4> all;
        for (std::size_t i = 0; i < tangents_.size(); ++i)
            all.push_back(tangents_[i].value_or(glm::dvec4(perpendicularTo(normalAt({i / 3, i % 3})), -1.0)));
        return all;
    }

private:
    glm::dvec3 at(const Corner& corner) const { return glm::dvec3(mesh_.positionsOS[mesh_.indices[corner.index()]]); }
    glm::dvec3 normalAt(const Corner& corner) const {
        return glm::dvec3(mesh_.normalsOS[mesh_.indices[corner.index()]]);
    }
    bool isDegenerate(std::size_t t) const {
        return at({t, 0}) == at({t, 1}) || at({t, 1}) == at({t, 2}) || at({t, 2}) == at({t, 0});
    }
    int vertexOf(const Corner& corner) const { return vertices_[corner.index()]; }

    /// Gives equal vertices the same number.
    void weld(const Texture& texture) {
        std::map<std::array<double, 8>, int> known;
        std::vector<int> numbers;
        for (std::uint32_t i = 0; i < mesh_.positionsOS.size(); ++i) {
            const glm::dvec3 p(mesh_.positionsOS[i]), n(mesh_.normalsOS[i]);
            const glm::dvec2 uv = texture.uv(i);
            numbers.push_back(
                known.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}, int(known.size())).first->second);
        }
        for (const std::uint32_t index : mesh_.indices) vertices_.push_back(numbers[index]);
    }

    /// Pairs each edge with the first unpaired one in the opposite direction.
    void meetNeighbours() {
        std::map<std::pair<int, int>, std::list<Corner>> waiting;
        for (std::size_t i = 0; i < 3 * triangles_; ++i) {
            const Corner from{i / 3, i % 3};
            if (isDegenerate(from.triangle)) continue;
            const int start = vertexOf(from), end = vertexOf(from.next());
            std::list<Corner>& back = waiting[{end, start}];
            if (back.empty()) {
                waiting[{start, end}].push_back(from);
                continue;
            }
            neighbours_[i] = back.front();
            neighbours_[back.front().index()] = from;
            back.pop_front();
        }
    }

    /// Visits the corners round the vertex of `first` on one side, and returns them without `first`.
    std::vector<Corner> walk(const Corner& first, bool isLeft) {
        std::vector<Corner> met;
        Corner corner = first;
        while (true) {
            // Across the edge that ends here the neighbour's begins here; across the one that begins here it ends.
            const std::optional<Corner> side = neighbours_[(isLeft ? corner.previous() : corner).index()];
            if (!side) return met;
            corner = isLeft ? *side : side->next();
            if (corner == first || tangents_[corner.index()]) return met;
            std::optional<double>& hand = orientations_[corner.triangle];
            if (!hand) hand = orientations_[first.triangle];
            if (hand != orientations_[first.triangle]) return met;
            tangents_[corner.index()] = glm::dvec4(0.0);
            met.push_back(corner);
        }
    }

    void walkFrom(const Corner& first) {
        std::vector<Corner> met = walk(first, false);
        for (const Corner& corner : walk(first, true)) met.push_back(corner);
        met.push_back(first);
        const glm::dvec3 normal = madeUnit(normalAt(first), glm::dvec3(0.0));
        const auto flat = [&](const glm::dvec3& vector) {
            const glm::dvec3 across = glm::cross(glm::cross(normal, vector), normal);
            const double length = glm::length(across);
            return length > kSmallestShare * glm::length(vector) ? across / length : glm::dvec3(0.0);
        };
        glm::dvec3 weighed(0.0), alike(0.0);
        double angles = 0.0;
        for (const Corner& corner : met) {
            if (!hasUvArea_[corner.triangle]) continue;
            const glm::dvec3 one = flat(at(corner.next()) - at(corner)),
                             other = flat(at(corner.previous()) - at(corner));
            // Kahan's angle between two vectors of equal length.
            const double angle = 2.0 * std::atan2(glm::length(one - other), glm::length(one + other));
            const glm::dvec3 direction = flat(growth_[corner.triangle].u);
            const bool standsUp = one == glm::dvec3(0.0) || other == glm::dvec3(0.0);
            const double weight = standsUp ? std::asin(1.0) : angle;
            weighed += weight * direction;
            alike += direction;
            angles += weight;
        }
        const glm::dvec3 mean = angles > kSmallestAngle ? weighed / angles : alike;
        const glm::dvec3 tangent = glm::length(mean) > kSmallestShare ? glm::normalize(mean) : perpendicularTo(normal);
        for (const Corner& corner : met)
            tangents_[corner.index()] = glm::dvec4(tangent, *orientations_[first.triangle]);
    }

    void copyToPointed() {
        std::map<int, Corner> firstAt;
        for (std::size_t i = 0; i < 3 * triangles_; ++i)
            if (!isDegenerate(i / 3)) firstAt.try_emplace(vertices_[i], Corner{i / 3, i % 3});
        for (std::size_t i = 0; i < 3 * triangles_; ++i) {
            const auto found = firstAt.find(vertices_[i]);
            if (isDegenerate(i / 3) && found != firstAt.end()) tangents_[i] = tangents_[found->second.index()];
        }
    }

    const scenes::Mesh& mesh_;
    std::size_t triangles_;
    std::vector<int> vertices_;                       ///< welded, by corner
    std::vector<Growth> growth_;                      ///< by triangle
    std::vector<std::optional<double>> orientations_; ///< by triangle, once it is known
    std::vector<bool> hasUvArea_;                     ///< by triangle: its texture area gives its orientation
    std::vector<std::optional<glm::dvec4>> tangents_; ///< by corner, once visited
    std::vector<std::optional<Corner>> neighbours_;   ///< by corner: start of the neighbour's opposite edge
};

/// Lengyel 2001.
std::vector<glm::dvec4> summed(const scenes::Mesh& mesh, const Texture& texture) {
    std::vector<Growth> growth(mesh.positionsOS.size());
    for (std::size_t t = 0; 3 * t + 2 < mesh.indices.size(); ++t) {
        const Growth share = texture.growthOf(t);
        for (std::size_t k = 0; k < 3; ++k) {
            growth[mesh.indices[3 * t + k]].u += share.u;
            growth[mesh.indices[3 * t + k]].v += share.v;
        }
    }
    std::vector<glm::dvec4> tangents;
    for (const std::uint32_t vertex : mesh.indices) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(mesh.normalsOS[vertex]));
        const glm::dvec3& u = growth[vertex].u;
        const glm::dvec3 flat = u - glm::dot(normal, u) * normal;
        if (glm::length(flat) > kSmallestShare * glm::length(u)) {
            const glm::dvec3 tangent = glm::normalize(flat);
            const double side = glm::dot(glm::cross(normal, tangent), growth[vertex].v);
            tangents.emplace_back(tangent, side < 0.0 ? -1.0 : 1.0);
        } else {
            tangents.emplace_back(perpendicularTo(glm::dvec3(mesh.normalsOS[vertex])), 1.0);
        }
    }
    return tangents;
}

/// The mesh's own tangents, rotated about the normal by the angle between the texture's u and the coordinates'.
std::vector<glm::dvec4> turned(const scenes::Mesh& mesh, const Axis& axis) {
    std::vector<glm::dvec4> tangents;
    for (const std::uint32_t vertex : mesh.indices) {
        const glm::dvec4 own(mesh.tangentsOS[vertex]);
        const glm::dvec3 bitangent = own.w * glm::cross(glm::dvec3(mesh.normalsOS[vertex]), glm::dvec3(own));
        const glm::dmat2x3 frame(glm::dvec3(own), bitangent);
        tangents.emplace_back(madeUnit(frame * axis.alongU, glm::dvec3(own)), own.w * axis.side);
    }
    return tangents;
}

} // namespace

std::vector<glm::dvec4> tangentsOS(const scenes::Mesh& mesh, const scenes::Material& material) {
    if (!mesh.tangentsOS.empty()) return turned(mesh, axisOf(textureFromUv(material, *tangentSlot(material))));
    const Texture texture(mesh, material);
    return material.tangents == scenes::TangentMethod::Lengyel ? summed(mesh, texture)
                                                               : VertexFans(mesh, texture).tangents();
}

} // namespace tessera::reference
