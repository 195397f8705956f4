#include "scenes/import/ObjPolygon.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace tessera::scenes::obj {
namespace {

/// The polygon seen from its front, in the coordinate plane it is most parallel to. The normal is Newell's, twice the
/// sum of signed areas: Sutherland, Sproull & Schumacker 1974, "A Characterization of Ten Hidden-Surface Algorithms".
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 fromFirst = corners[i] - corners[0];
        normal += glm::cross(fromFirst, corners[(i + 1) % corners.size()] - corners[0]);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int dropped = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec2 kept(corner[(dropped + 1) % 3], corner[(dropped + 2) % 3]);
        flat.push_back(normal[dropped] < 0.0 ? glm::dvec2(kept.y, kept.x) : kept);
    }
    return flat;
}

/// Twice the signed area, positive counter-clockwise.
double areaOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class Clipper {
public:
    Clipper(std::span<const glm::dvec3> corners, std::uint64_t& steps)
        : corners_(corners), flat_(flattened(corners)), left_(corners.size()), steps_(steps) {
        std::iota(left_.begin(), left_.end(), std::size_t{0});
    }

    std::vector<std::array<std::size_t, 3>> clip() {
        while (left_.size() > 3) {
            const std::optional<std::size_t> ear = bestEar();
            clipAt(ear.value_or(1)); // around the first corner: a fan
        }
        clipAt(1);
        return std::move(triangles_);
    }

private:
    std::size_t before(std::size_t at) const { return left_[(at + left_.size() - 1) % left_.size()]; }
    std::size_t after(std::size_t at) const { return left_[(at + 1) % left_.size()]; }

    void clipAt(std::size_t at) {
        triangles_.push_back({before(at), left_[at], after(at)});
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
    }

    std::optional<std::size_t> bestEar() {
        steps_ += left_.size();
        std::optional<std::size_t> best;
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t at = 0; at < left_.size(); ++at) {
            const glm::dvec3 cut = corners_[after(at)] - corners_[before(at)];
            const double length = glm::dot(cut, cut);
            if (length < shortest && isEar(at)) {
                shortest = length;
                best = at;
            }
        }
        return best;
    }

    bool isEar(std::size_t at) {
        const glm::dvec2& a = flat_[before(at)];
        const glm::dvec2& b = flat_[left_[at]];
        const glm::dvec2& c = flat_[after(at)];
        if (!(areaOf(a, b, c) > 0.0)) return false;
        return std::ranges::none_of(left_, [&](std::size_t other) {
            ++steps_;
            const glm::dvec2& p = flat_[other];
            if (p == a || p == b || p == c) return false; // a corner itself, or one where a hole's bridge returns
            return areaOf(a, b, p) >= 0.0 && areaOf(b, c, p) >= 0.0 && areaOf(c, a, p) >= 0.0;
        });
    }

    std::span<const glm::dvec3> corners_;
    std::vector<glm::dvec2> flat_;
    std::vector<std::size_t> left_; ///< corners not yet cut off
    std::uint64_t& steps_;
    std::vector<std::array<std::size_t, 3>> triangles_;
};

} // namespace

std::vector<std::array<std::size_t, 3>> cutPolygon(std::span<const glm::dvec3> corners, std::uint64_t& steps) {
    assert(corners.size() >= 3);
    return Clipper(corners, steps).clip();
}

} // namespace tessera::scenes::obj
