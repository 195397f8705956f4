#include "scenes/import/ObjText.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <queue>

namespace tessera::scenes::obj {
namespace {

/// Projects a polygon, seen from its front, to the most parallel coordinate plane. The normal is Newell's, twice the
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
    Clipper(std::span<const glm::dvec3> corners, std::uint64_t& steps, std::uint64_t mostSteps)
        : corners_(corners), flat_(flattened(corners)), links_(corners.size()), steps_(steps), mostSteps_(mostSteps) {
        const auto size = double(corners.size());
        side_ = std::size_t(std::sqrt(size));
        cells_.assign(side_ * side_, kNoCorner);
        glm::dvec2 most = least_ = flat_[0];
        for (const glm::dvec2& corner : flat_) {
            least_ = glm::min(least_, corner);
            most = glm::max(most, corner);
        }
        cellsPerLength_ = double(side_) / glm::max(most - least_, glm::dvec2(1e-300));
        for (std::size_t at = 0; at < corners.size(); ++at) {
            links_[at].after = (at + 1) % corners.size();
            links_[at].before = (at + corners.size() - 1) % corners.size();
            std::size_t& first = cells_[cellOf(flat_[at])];
            links_[at].inCell = std::exchange(first, at);
        }
        for (std::size_t at = 0; at < corners.size(); ++at) offer(at);
    }

    std::vector<std::array<std::size_t, 3>> clip() {
        for (std::size_t left = corners_.size(); left > 3; --left) clipAt(bestEar().value_or(links_[first_].after));
        clipAt(links_[first_].after);
        return std::move(triangles_);
    }

private:
    static constexpr std::size_t kNoCorner = ~std::size_t{0};
    struct Links {
        std::size_t before, after;       ///< among the remaining corners
        std::size_t inCell = kNoCorner;  ///< the next of the same cell
        std::size_t version = 0;         ///< raised when a neighbour or the corner itself is clipped
        std::size_t waiting = kNoCorner; ///< list in waits_ of the corners that this one keeps from being ears
    };
    struct Wait {
        std::size_t at, version, next;
    };
    struct Offer {
        double cut; ///< squared
        std::size_t at, version;
        bool operator>(const Offer& other) const { return std::pair(cut, at) > std::pair(other.cut, other.at); }
    };

    std::size_t columnOf(double length) const { return std::size_t(std::clamp(length, 0.0, double(side_ - 1))); }
    std::size_t cellOf(const glm::dvec2& place) const {
        const glm::dvec2 cell = (place - least_) * cellsPerLength_;
        return columnOf(cell.y) * side_ + columnOf(cell.x);
    }

    void offer(std::size_t at) {
        const glm::dvec3 cut = corners_[links_[at].after] - corners_[links_[at].before];
        offers_.push({glm::dot(cut, cut), at, ++links_[at].version});
    }

    void clipAt(std::size_t at) {
        Links& links = links_[at];
        triangles_.push_back({links.before, at, links.after});
        links_[links.before].after = links.after;
        links_[links.after].before = links.before;
        ++links.version;
        if (at == first_) first_ = links.after;
        if (steps_ > mostSteps_) return; // ears are no longer searched
        std::size_t* inCell = &cells_[cellOf(flat_[at])];
        for (; *inCell != at; ++steps_) inCell = &links_[*inCell].inCell;
        *inCell = links.inCell;
        offer(links.before);
        offer(links.after);
        for (std::size_t i = links.waiting; i != kNoCorner; ++steps_) {
            const std::size_t next = std::exchange(waits_[i].next, freeWait_);
            freeWait_ = i;
            if (links_[waits_[i].at].version == waits_[i].version) offer(waits_[i].at);
            i = next;
        }
    }

    std::optional<std::size_t> bestEar() {
        while (!offers_.empty() && steps_ <= mostSteps_) {
            const Offer best = offers_.top();
            offers_.pop();
            ++steps_;
            const Links& links = links_[best.at];
            if (best.version != links.version) continue;
            const glm::dvec2 &a = flat_[links.before], &b = flat_[best.at], &c = flat_[links.after];
            if (!(areaOf(a, b, c) > 0.0)) continue;
            const std::size_t within = cornerWithin(a, b, c);
            if (within == kNoCorner) return best.at;
            if (freeWait_ == kNoCorner) {
                freeWait_ = waits_.size();
                waits_.push_back({0, 0, kNoCorner});
            }
            Wait& wait = waits_[freeWait_];
            const std::size_t nextFree = wait.next;
            wait = {best.at, best.version, std::exchange(links_[within].waiting, freeWait_)};
            freeWait_ = nextFree;
        }
        return std::nullopt;
    }

    /// A corner in the triangle or on its edge, else kNoCorner.
    std::size_t cornerWithin(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        const glm::dvec2 least = (glm::min(a, glm::min(b, c)) - least_) * cellsPerLength_;
        const glm::dvec2 most = (glm::max(a, glm::max(b, c)) - least_) * cellsPerLength_;
        for (std::size_t y = columnOf(least.y); y <= columnOf(most.y); ++y)
            for (std::size_t x = columnOf(least.x); x <= columnOf(most.x); ++x, ++steps_)
                for (std::size_t at = cells_[y * side_ + x]; at != kNoCorner; at = links_[at].inCell, ++steps_) {
                    const glm::dvec2& p = flat_[at];
                    // A corner of the triangle, or its duplicate at the bridge of a hole.
                    if (p == a || p == b || p == c) continue;
                    if (areaOf(a, b, p) >= 0.0 && areaOf(b, c, p) >= 0.0 && areaOf(c, a, p) >= 0.0) return at;
                }
        return kNoCorner;
    }

    std::span<const glm::dvec3> corners_;
    std::vector<glm::dvec2> flat_;
    std::vector<Links> links_;
    std::vector<std::size_t> cells_; ///< the first corner of each cell of a grid over the polygon
    std::size_t side_ = 1;           ///< in cells
    glm::dvec2 least_{0.0}, cellsPerLength_{1.0};
    std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers_; ///< old versions are ignored
    std::vector<Wait> waits_;
    std::size_t freeWait_ = kNoCorner; ///< the first free entry of waits_
    std::size_t first_ = 0;            ///< the first of the remaining corners
    std::uint64_t& steps_;
    std::uint64_t mostSteps_;
    std::vector<std::array<std::size_t, 3>> triangles_;
};

} // namespace

std::vector<std::array<std::size_t, 3>> cutPolygon(std::span<const glm::dvec3> corners, std::uint64_t& steps,
                                                   std::uint64_t mostSteps) {
    assert(corners.size() >= 3);
    if (corners.size() == 3) return {{0, 1, 2}};
    return Clipper(corners, steps, mostSteps).clip();
}

} // namespace tessera::scenes::obj
