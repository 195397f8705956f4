#include "viewer/edit/Contour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

namespace tessera::viewer {
namespace {

constexpr float kSmoothPixels = 1.0f; ///< height of the steps of a slanted edge
/// Most sides of a piece that is simplified separately. If each point that stays cuts off only one side, as on a comb,
/// a piece takes time proportional to the square of this.
constexpr std::size_t kPieceSides = 128;

/// Directions along pixel sides from a corner, each with the inside on its right.
constexpr std::array<glm::ivec2, 4> kWays{glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0), glm::ivec2(0, -1)};

/// The pixel sides of contours, stored as directions that leave their corners.
class Sides {
public:
    Sides(std::span<const std::uint8_t> isInside, glm::ivec2 sizePixels)
        : size_(sizePixels + 1), leaving_(std::size_t(size_.x) * std::size_t(size_.y)), entering_(leaving_.size()) {
        const auto at = [&](int x, int y) {
            return isInside[std::size_t(y) * std::size_t(sizePixels.x) + std::size_t(x)];
        };
        for (int y = 0; y < sizePixels.y; ++y)
            for (int x = 0; x < sizePixels.x; ++x) {
                if (!at(x, y)) continue;
                if (y > 0 && !at(x, y - 1)) add({x, y}, 0);
                if (x + 1 < sizePixels.x && !at(x + 1, y)) add({x + 1, y}, 1);
                if (y + 1 < sizePixels.y && !at(x, y + 1)) add({x + 1, y + 1}, 2);
                if (x > 0 && !at(x - 1, y)) add({x, y + 1}, 3);
            }
    }
    /// First the contours that the image border cuts off, from their starts, then closed ones.
    std::vector<Contour> takeAll() {
        std::vector<Contour> contours;
        for (const bool isCut : {true, false})
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x)
                    while (ways({x, y}) != 0 && (!isCut || std::popcount(ways({x, y})) > entering_[indexOf({x, y})]))
                        contours.push_back(take({x, y}));
        return contours;
    }

private:
    std::size_t indexOf(glm::ivec2 corner) const {
        return std::size_t(corner.y) * std::size_t(size_.x) + std::size_t(corner.x);
    }
    std::uint8_t& ways(glm::ivec2 corner) { return leaving_[indexOf(corner)]; }
    void add(glm::ivec2 from, std::size_t way) {
        ways(from) |= std::uint8_t(1u << way);
        ++entering_[indexOf(from + kWays[way])];
    }
    /// Follows the contour that leaves a corner to its end, and merges straight runs.
    Contour take(glm::ivec2 corner) {
        Contour contour{glm::vec2(corner)};
        int latest = -1;
        while (ways(corner) != 0) {
            const int way = std::countr_zero(ways(corner));
            ways(corner) &= std::uint8_t(~(1u << way));
            corner += kWays[std::size_t(way)];
            --entering_[indexOf(corner)];
            if (way == latest)
                contour.back() = glm::vec2(corner);
            else
                contour.emplace_back(corner);
            latest = way;
        }
        return contour;
    }

    glm::ivec2 size_; ///< in pixel corners
    std::vector<std::uint8_t> leaving_, entering_;
};

float distanceToLine(const glm::vec2& point, const glm::vec2& begin, const glm::vec2& end) {
    const glm::vec2 along = end - begin;
    const float square = glm::dot(along, along);
    const float share = square > 0.0f ? std::clamp(glm::dot(point - begin, along) / square, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, begin + share * along);
}

/// Removes points within this distance from the line between the remaining ones. The ends of pieces of kPieceSides
/// stay, so that the time is linear in the number of points.
/// Source: Douglas and Peucker 1973, "Algorithms for the reduction of the number of points required to represent a
/// digitized line or its caricature".
Contour smoothed(const Contour& contour, float pixels) {
    std::vector<std::uint8_t> stays(contour.size(), 0);
    stays.front() = stays.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (std::size_t first = 0, end = contour.size() - 1; first < end; first += kPieceSides) {
        stays[first] = 1;
        parts.emplace_back(first, std::min(first + kPieceSides, end));
    }
    while (!parts.empty()) {
        const auto [first, last] = parts.back();
        parts.pop_back();
        float farthest = pixels;
        std::size_t found = first;
        for (std::size_t i = first + 1; i < last; ++i) {
            const float distance = distanceToLine(contour[i], contour[first], contour[last]);
            if (distance > farthest) {
                farthest = distance;
                found = i;
            }
        }
        if (found == first) continue;
        stays[found] = 1;
        parts.emplace_back(first, found);
        parts.emplace_back(found, last);
    }
    Contour result;
    for (std::size_t i = 0; i < contour.size(); ++i)
        if (stays[i] != 0) result.push_back(contour[i]);
    return result;
}

float lengthOf(const Contour& contour) {
    float length = 0.0f;
    for (std::size_t i = 1; i < contour.size(); ++i) length += glm::distance(contour[i - 1], contour[i]);
    return length;
}

} // namespace

std::vector<Contour> contoursOf(std::span<const std::uint8_t> isInside, glm::ivec2 sizePixels) {
    assert(isInside.size() == std::size_t(sizePixels.x) * std::size_t(sizePixels.y));
    std::vector<std::pair<float, Contour>> found;
    for (Contour& contour : Sides(isInside, sizePixels).takeAll()) {
        const float length = lengthOf(contour);
        found.emplace_back(length, std::move(contour));
    }
    std::ranges::stable_sort(found, std::ranges::greater(), [](const auto& entry) { return entry.first; });
    std::vector<Contour> contours;
    std::size_t points = 0;
    for (const auto& [length, contour] : found) {
        Contour smooth = smoothed(contour, kSmoothPixels);
        if (contours.empty()) // the longest contour always stays, for example of connected foliage
            // Once the tolerance exceeds the image, only the ends of pieces stay, fewer each time.
            for (float pixels = 2.0f * kSmoothPixels; smooth.size() > kMostContourPoints; pixels *= 2.0f)
                smooth = smoothed(smooth, pixels);
        points += smooth.size();
        if (points > kMostContourPoints) break;
        if (smooth.size() > 1) contours.push_back(std::move(smooth));
    }
    return contours;
}

} // namespace tessera::viewer
