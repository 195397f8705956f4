#pragma once
#include <cstdint>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/UvAtlas.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/diffusion.h"

/// Squares of an object's atlas, so that light is computed and spread where a pixel may see it and nowhere else
/// (docs/skin.md).
namespace tessera::frame {

constexpr int kDiffusionTileTexels = DIFFUSION_TILE_TEXELS;

/// Some of the tiles of an atlas.
class TileSet {
public:
    TileSet() = default;
    explicit TileSet(int side, bool all = false) : side_(side), has_(std::size_t(side) * std::size_t(side), all) {}

    int side() const { return side_; } ///< tiles
    bool has(int tile) const { return has_[std::size_t(tile)]; }
    void add(int tile) { has_[std::size_t(tile)] = true; }
    void remove(int tile) { has_[std::size_t(tile)] = false; }
    void add(const TileSet& other);
    void remove(const TileSet& other);
    bool isEmpty() const;
    std::size_t count() const;
    TileSet first(std::size_t most) const; ///< so many of them at most, row by row
    /// Disjoint rectangles that cover the set and nothing else, in texels of an atlas of `sideTexels`.
    std::vector<gpu::Rectangle> rectangles(int tileTexels, int sideTexels) const;
    bool operator==(const TileSet&) const = default;

private:
    int side_ = 0;
    std::vector<bool> has_; ///< row by row
};

/// What is known of a tile.
struct DiffusionTile {
    // Of all triangles whose pixels may look up a texel of the tile.
    scenes::Box3 boxWS;
    glm::dvec3 axisWS{0.0}; ///< unit; 0: they face all sides
    double cosine = -1.0;   ///< least of the angles between their fronts and the axis
    // Of its texels.
    double leastUMetres = 0.0, leastVMetres = 0.0, mostShear = 0.0; ///< UvStep
    std::vector<int> continuesIn;                                   ///< tiles whose light those outside of charts take
    bool isUsed() const { return !boxWS.empty(); }
};
std::vector<DiffusionTile> diffusionTiles(const UvAtlas& atlas, const scenes::Mesh& mesh,
                                          const glm::dmat4& worldFromObject);

/// All that hold anything, or none.
TileSet usedTiles(const std::vector<DiffusionTile>& tiles, bool all = true);
/// Tiles that a pixel of the view may look up. Those outside of the picture are left out, and those whose front faces
/// away from the viewer, unless both sides are drawn. `marginMetres` is that of isOutside().
TileSet seenTiles(const std::vector<DiffusionTile>& tiles, const CameraView& view, double marginMetres,
                  bool drawsBothSides);

/// Which tiles each pass must compute so that the light of some tiles is what it would be if all were computed.
struct DiffusionWork {
    TileSet light;
    struct Level {
        TileSet fill, alongU, alongV;
    };
    std::vector<Level> levels; ///< parallel to LightSpread::levels
    TileSet store;
    TileSet blank = {}; ///< where no light is known, and pixels must be told so
};
DiffusionWork diffusionWork(const std::vector<DiffusionTile>& tiles, const std::vector<double>& variancesSquareMetres,
                            const TileSet& store);

} // namespace tessera::frame
