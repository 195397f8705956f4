#pragma once
#include <cstdint>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/UvAtlas.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/diffusion.h"

/// Square tiles of an object's UV atlas: light is computed and diffused only where a pixel may sample it
/// (docs/skin.md).
namespace tessera::frame {

constexpr int kDiffusionTileTexels = DIFFUSION_TILE_TEXELS;

/// A set of tiles of an atlas.
class TileSet {
public:
    TileSet() = default;
    explicit TileSet(int side, bool all = false) : side_(side), has_(std::size_t(side) * std::size_t(side), all) {}

    int side() const { return side_; } ///< in tiles
    bool has(int tile) const { return has_[std::size_t(tile)]; }
    void add(int tile) { has_[std::size_t(tile)] = true; }
    void remove(int tile) { has_[std::size_t(tile)] = false; }
    void add(const TileSet& other);
    void remove(const TileSet& other);
    bool isEmpty() const;
    std::size_t count() const;
    TileSet first(std::size_t most) const; ///< at most `most` of them, row by row
    /// Disjoint rectangles that cover the set and nothing else, in texels of an atlas of `sideTexels`.
    std::vector<gpu::Rectangle> rectangles(int tileTexels, int sideTexels) const;
    bool operator==(const TileSet&) const = default;

private:
    int side_ = 0;
    std::vector<bool> has_; ///< row by row
};

/// Bounds of a tile's triangles and texels.
struct DiffusionTile {
    // All triangles whose pixels may sample the tile:
    scenes::Box3 boxWS;
    glm::dvec3 axisWS{0.0}; ///< unit axis of their normal cone; 0: normals in all directions
    double cosine = -1.0;   ///< smallest cosine between a normal and the axis
    // Its texels:
    double leastUMetres = 0.0, leastVMetres = 0.0, mostShear = 0.0; ///< UvStep
    std::vector<int> continuesIn;                                   ///< tiles that its gutter texels read
    bool isUsed() const { return !boxWS.empty(); }
};
std::vector<DiffusionTile> diffusionTiles(const UvAtlas& atlas, const scenes::Mesh& mesh,
                                          const glm::dmat4& worldFromObject);

/// All used tiles, or an empty set.
TileSet usedTiles(const std::vector<DiffusionTile>& tiles, bool all = true);
/// Tiles that pixels of the view may sample. Omits tiles outside the frustum and, unless both sides are drawn,
/// back-facing tiles. `marginMetres`: see isOutside().
TileSet seenTiles(const std::vector<DiffusionTile>& tiles, const CameraView& view, double marginMetres,
                  bool drawsBothSides);

/// Tiles that each pass must compute so that the stored tiles are as if all tiles were computed.
struct DiffusionWork {
    TileSet light;
    struct Level {
        TileSet fill, alongU, alongV;
    };
    std::vector<Level> levels; ///< parallel to DiffusionKernel::levels
    TileSet store;
    TileSet blank = {}; ///< tiles to mark as having no light
};
DiffusionWork diffusionWork(const std::vector<DiffusionTile>& tiles, const std::vector<double>& variancesSquareMetres,
                            const TileSet& store);

} // namespace tessera::frame
