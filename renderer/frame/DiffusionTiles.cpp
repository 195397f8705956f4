#include "renderer/frame/DiffusionTiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tessera::frame {

namespace {

/// Triangles that face away by less than this cosine count as visible: rasterisation snaps vertices to subpixels, which
/// may turn small triangles.
constexpr double kFacingMargin = 0.1;
/// Tiles below this size are never culled as back-facing: snapping may turn any of their triangles.
constexpr double kLeastTilePixels = 4.0;

int tileOf(const glm::ivec2& texel, int side) {
    return texel.y / kDiffusionTileTexels * side + texel.x / kDiffusionTileTexels;
}

int sideOf(const std::vector<DiffusionTile>& tiles) {
    return int(std::lround(std::sqrt(double(tiles.size()))));
}

/// Visits the texels that a bilinear lookup at a place reads.
template <typename Visit>
void visitLookedUp(const glm::dvec2& place, int sideTexels, Visit visit) {
    // Shaders round: a place midway between texels may fall to either side.
    const glm::ivec2 low(glm::floor(place - 0.5 - 1e-3)), high(glm::floor(place + 0.5 + 1e-3));
    for (int v = low.y; v <= high.y; ++v)
        for (int u = low.x; u <= high.x; ++u)
            visit(glm::clamp(glm::ivec2(u, v), glm::ivec2(0), glm::ivec2(sideTexels - 1)));
}

/// A triangle in the UV atlas: its corners in texels and in world space, and the rounding margin of lookups.
struct Looked {
    std::array<glm::dvec2, 3> places;
    std::array<glm::dvec3, 3> cornersWS;
    glm::dvec2 low, high; ///< of the places
    double beside = 0.0;  ///< texels

    /// Extends a box by the part of the triangle whose lookups may reach a tile.
    void extend(scenes::Box3& boxWS, const glm::dvec2& tileLow, const glm::dvec2& tileHigh) const {
        scenes::Box3 whole;
        for (const glm::dvec3& corner : cornersWS) whole.extend(corner);
        const glm::dvec2 a = places[1] - places[0], b = places[2] - places[0];
        const double area = a.x * b.y - a.y * b.x;
        const glm::dvec2 from = glm::max(low, tileLow - beside), to = glm::min(high, tileHigh + beside);
        if (area != 0.0) {
            const glm::dvec3 side1 = cornersWS[1] - cornersWS[0], side2 = cornersWS[2] - cornersWS[0];
            const glm::dvec3 alongU = (side1 * b.y - side2 * a.y) / area, alongV = (side2 * a.x - side1 * b.x) / area;
            scenes::Box3 part;
            for (int i = 0; i < 4; ++i) {
                const glm::dvec2 offset = glm::dvec2(i & 1 ? to.x : from.x, i & 2 ? to.y : from.y) - places[0];
                part.extend(cornersWS[0] + offset.x * alongU + offset.y * alongV);
            }
            if (std::isfinite(part.min.x + part.min.y + part.min.z + part.max.x + part.max.y + part.max.z)) {
                whole.min = glm::max(whole.min, part.min);
                whole.max = glm::max(whole.min, glm::min(whole.max, part.max));
            }
        }
        boxWS.extend(whole.min);
        boxWS.extend(whole.max);
    }
};

/// Radius of a Gaussian's taps in texels (shaders/passes/diffusion_blur.frag).
int reachTexels(double varianceSquareMetres, double stepMetres, int sideTexels) {
    if (!(stepMetres > 0.0)) return sideTexels;
    // The last tap may lie beyond the radius by up to the tap spacing.
    const double reach =
        std::ceil((DIFFUSION_REACH + DIFFUSION_TAP_SHARE) * std::sqrt(varianceSquareMetres) / stepMetres) + 2.0;
    return int(std::min(reach, double(sideTexels)));
}

/// Texels that a pass must compute: a box in each tile.
class NeededTexels {
public:
    explicit NeededTexels(const TileSet& tiles) : side_(tiles.side()), boxes_(std::size_t(side_) * std::size_t(side_)) {
        for (int tile = 0; tile < int(boxes_.size()); ++tile)
            if (tiles.has(tile)) addTile(tile);
    }

    /// Adds the tiles that gutter texels read their light from.
    void addContinued(const std::vector<DiffusionTile>& tiles) {
        const TileSet own = this->tiles();
        for (int tile = 0; tile < int(boxes_.size()); ++tile)
            if (own.has(tile)) std::ranges::for_each(tiles[std::size_t(tile)].continuesIn, [&](int i) { addTile(i); });
    }
    /// A copy whose boxes are widened by `reachOf` texels.
    template <typename Reach>
    NeededTexels widened(const std::vector<DiffusionTile>& tiles, Reach reachOf) const {
        NeededTexels result = *this;
        for (std::size_t tile = 0; tile < boxes_.size(); ++tile) {
            if (boxes_[tile].isEmpty()) continue;
            const glm::ivec2 reach = reachOf(tiles[tile]);
            result.add(boxes_[tile].low - reach, boxes_[tile].high + reach);
        }
        return result;
    }
    TileSet tiles() const {
        TileSet set(side_);
        for (std::size_t tile = 0; tile < boxes_.size(); ++tile)
            if (!boxes_[tile].isEmpty()) set.add(int(tile));
        return set;
    }

private:
    struct Box {
        glm::ivec2 low{std::numeric_limits<int>::max()}, high{-1}; ///< both inclusive
        bool isEmpty() const { return high.x < 0; }
    };

    void addTile(int tile) {
        const glm::ivec2 low = kDiffusionTileTexels * glm::ivec2(tile % side_, tile / side_);
        boxes_[std::size_t(tile)] = {low, low + (kDiffusionTileTexels - 1)};
    }
    void add(glm::ivec2 low, glm::ivec2 high) {
        low = glm::max(low, 0);
        high = glm::min(high, side_ * kDiffusionTileTexels - 1);
        const glm::ivec2 first = low / kDiffusionTileTexels, last = high / kDiffusionTileTexels;
        for (int v = first.y; v <= last.y; ++v) {
            for (int u = first.x; u <= last.x; ++u) {
                Box& box = boxes_[std::size_t(v * side_ + u)];
                const glm::ivec2 corner = kDiffusionTileTexels * glm::ivec2(u, v);
                box.low = glm::min(box.low, glm::max(low, corner));
                box.high = glm::max(box.high, glm::min(high, corner + (kDiffusionTileTexels - 1)));
            }
        }
    }

    int side_;
    std::vector<Box> boxes_;
};

} // namespace

void TileSet::add(const TileSet& other) {
    for (std::size_t i = 0; i < has_.size(); ++i) has_[i] = has_[i] || other.has_[i];
}

void TileSet::remove(const TileSet& other) {
    for (std::size_t i = 0; i < has_.size(); ++i) has_[i] = has_[i] && !other.has_[i];
}

bool TileSet::isEmpty() const {
    return std::ranges::find(has_, true) == has_.end();
}

std::size_t TileSet::count() const {
    return std::size_t(std::ranges::count(has_, true));
}

TileSet TileSet::first(std::size_t most) const {
    TileSet some(side_);
    for (std::size_t tile = 0; tile < has_.size() && most > 0; ++tile) {
        if (!has_[tile]) continue;
        some.has_[tile] = true;
        --most;
    }
    return some;
}

std::vector<gpu::Rectangle> TileSet::rectangles(int tileTexels, int sideTexels) const {
    std::vector<gpu::Rectangle> result;
    std::vector<std::size_t> above; // rectangles that end at the row above
    for (int v = 0; v < side_; ++v) {
        std::vector<std::size_t> own;
        for (int u = 0; u < side_; ++u) {
            if (!has(v * side_ + u)) continue;
            const int first = u;
            while (u < side_ && has(v * side_ + u)) ++u;
            const gpu::Rectangle run{first * tileTexels, v * tileTexels, (u - first) * tileTexels, tileTexels};
            const auto same = std::ranges::find_if(
                above, [&](std::size_t i) { return result[i].x == run.x && result[i].width == run.width; });
            if (same != above.end()) {
                result[*same].height += tileTexels;
                own.push_back(*same);
            } else {
                own.push_back(result.size());
                result.push_back(run);
            }
        }
        above = std::move(own);
    }
    for (gpu::Rectangle& rectangle : result) { // the last tiles of an atlas may be cut
        rectangle.width = std::min(rectangle.width, sideTexels - rectangle.x);
        rectangle.height = std::min(rectangle.height, sideTexels - rectangle.y);
    }
    return result;
}

std::vector<DiffusionTile> diffusionTiles(const UvAtlas& atlas, const scenes::Mesh& mesh,
                                          const glm::dmat4& worldFromObject) {
    const int side = (atlas.sideTexels + kDiffusionTileTexels - 1) / kDiffusionTileTexels;
    std::vector<DiffusionTile> tiles(std::size_t(side) * std::size_t(side));
    const double sign = glm::determinant(glm::dmat3(worldFromObject)) < 0.0 ? -1.0 : 1.0;
    // The cone axes first, then the cone angles.
    for (const bool measures : {false, true}) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Looked triangle;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t vertex = mesh.indices[i + c];
                triangle.places[c] = atlas.placeOf(mesh.texCoords[0][vertex]);
                triangle.cornersWS[c] =
                    glm::dvec3(worldFromObject * glm::dvec4(glm::dvec3(mesh.positionsOS[vertex]), 1.0));
            }
            const auto& [a, b, c] = triangle.places;
            triangle.low = glm::min(a, glm::min(b, c));
            triangle.high = glm::max(a, glm::max(b, c));
            const glm::dvec2 extent = triangle.high - triangle.low;
            triangle.beside = 0.75 + std::min(0.5 * std::max(extent.x, extent.y), 8.0);
            const glm::dvec3 front = sign * glm::cross(triangle.cornersWS[1] - triangle.cornersWS[0],
                                                       triangle.cornersWS[2] - triangle.cornersWS[0]);
            const double area = glm::length(front);
            const glm::dvec2 last(double(atlas.sideTexels - 1));
            const glm::ivec2 from =
                glm::ivec2(glm::clamp(triangle.low - triangle.beside, glm::dvec2(0.0), last)) / kDiffusionTileTexels;
            const glm::ivec2 to =
                glm::ivec2(glm::clamp(triangle.high + triangle.beside, glm::dvec2(0.0), last)) / kDiffusionTileTexels;
            for (int v = from.y; v <= to.y; ++v) {
                for (int u = from.x; u <= to.x; ++u) {
                    DiffusionTile& tile = tiles[std::size_t(v * side + u)];
                    if (!measures) {
                        const glm::dvec2 low = double(kDiffusionTileTexels) * glm::dvec2(u, v);
                        triangle.extend(tile.boxWS, low, low + double(kDiffusionTileTexels));
                        if (area > 0.0) tile.axisWS += front / area;
                        tile.cosine = 1.0;
                    } else if (area > 0.0) {
                        tile.cosine = std::min(tile.cosine, glm::dot(front / area, tile.axisWS));
                    }
                }
            }
        }
        for (DiffusionTile& tile : tiles) {
            const double length = glm::length(tile.axisWS);
            if (!measures) tile.axisWS = length > 1e-9 ? tile.axisWS / length : glm::dvec3(0.0);
            if (tile.axisWS == glm::dvec3(0.0)) tile.cosine = -1.0;
        }
    }

    constexpr double kNone = std::numeric_limits<double>::infinity();
    for (DiffusionTile& tile : tiles) tile.leastUMetres = tile.leastVMetres = kNone;
    for (int v = 0; v < atlas.sideTexels; ++v) {
        for (int u = 0; u < atlas.sideTexels; ++u) {
            const UvTexel& texel = atlas.at(u, v);
            if (texel.chart == 0) continue;
            DiffusionTile& tile = tiles[std::size_t(tileOf({u, v}, side))];
            const UvStep& step = atlas.steps[std::size_t(texel.triangle)];
            tile.leastUMetres = std::min(tile.leastUMetres, step.uMetres);
            tile.leastVMetres = std::min(tile.leastVMetres, step.vMetres);
            tile.mostShear = std::max(tile.mostShear, std::abs(step.shear));
            if (texel.isCovered) continue;
            visitLookedUp(texel.continued, atlas.sideTexels, [&](const glm::ivec2& there) {
                const int other = tileOf(there, side);
                if (std::ranges::find(tile.continuesIn, other) == tile.continuesIn.end())
                    tile.continuesIn.push_back(other);
            });
        }
    }
    return tiles;
}

TileSet usedTiles(const std::vector<DiffusionTile>& tiles, bool all) {
    TileSet used(sideOf(tiles));
    for (std::size_t i = 0; all && i < tiles.size(); ++i)
        if (tiles[i].isUsed()) used.add(int(i));
    return used;
}

TileSet seenTiles(const std::vector<DiffusionTile>& tiles, const CameraView& view, double marginMetres,
                  bool drawsBothSides) {
    TileSet seen(sideOf(tiles));
    const bool isOrthographic = view.constants.forwardLS.w == 1.0f;
    const double pixel = double(std::max(view.constants.rayFromPixel.x, view.constants.rayFromPixel.y));
    const glm::dvec3 backWS = -(view.forwardLS * view.lsFromWorld); // by the transpose, into world axes
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const DiffusionTile& tile = tiles[i];
        if (!tile.isUsed() || isOutside(tile.boxWS, marginMetres, view)) continue;
        seen.add(int(i));
        if (drawsBothSides || tile.axisWS == glm::dvec3(0.0)) continue;
        const glm::dvec3 centerWS = 0.5 * (tile.boxWS.min + tile.boxWS.max);
        const double radius = 0.5 * glm::distance(tile.boxWS.min, tile.boxWS.max) + marginMetres;
        const double distance = glm::distance(view.eyeWS, centerWS);
        if (2.0 * radius < kLeastTilePixels * pixel * (isOrthographic ? 1.0 : distance)) continue;
        if (!isOrthographic && distance <= radius) continue;
        // Largest difference between a triangle's facing cosine and that at the box's centre.
        const double slack = isOrthographic ? 0.0 : radius / distance;
        const glm::dvec3 toViewerWS = isOrthographic ? backWS : (view.eyeWS - centerWS) / distance;
        const double apart = std::acos(std::clamp(glm::dot(tile.axisWS, toViewerWS), -1.0, 1.0));
        const double spread = std::acos(std::clamp(tile.cosine, -1.0, 1.0));
        if (std::cos(std::max(0.0, apart - spread)) < -slack - kFacingMargin) seen.remove(int(i));
    }
    return seen;
}

DiffusionWork diffusionWork(const std::vector<DiffusionTile>& tiles, const std::vector<double>& variances,
                            const TileSet& store) {
    const int sideTexels = store.side() * kDiffusionTileTexels;
    DiffusionWork work;
    work.store = store;
    work.levels.resize(variances.size());
    // From the last pass back: each pass must compute what the next one reads.
    NeededTexels needed(store);
    needed.addContinued(tiles);
    for (std::size_t i = variances.size(); i-- > 0;) {
        DiffusionWork::Level& level = work.levels[i];
        level.alongV = needed.tiles();
        needed = needed.widened(tiles, [&](const DiffusionTile& tile) {
            const int reach = reachTexels(variances[i], tile.leastVMetres, sideTexels);
            return glm::ivec2(int(std::min(tile.mostShear * double(reach) + 2.0, double(sideTexels))), reach);
        });
        level.alongU = needed.tiles();
        needed = needed.widened(tiles, [&](const DiffusionTile& tile) {
            return glm::ivec2(reachTexels(variances[i], tile.leastUMetres, sideTexels), 0);
        });
        level.fill = needed.tiles();
        needed.addContinued(tiles);
    }
    work.light = needed.tiles();
    return work;
}

} // namespace tessera::frame
