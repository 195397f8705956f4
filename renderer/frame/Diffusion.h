#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "renderer/frame/DiffusionTiles.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/UvAtlas.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Texture.h"
#include "scenes/Scene.h"

/// Light that spreads over the surfaces of objects (docs/skin.md): which objects, by which Gaussians, in which atlas,
/// and what is kept from frame to frame.
namespace tessera::frame {

/// A mesh instance whose material spreads light over it.
struct SpreadingObject {
    int node = 0;
    int mesh = 0;
    int material = 0;
    int instance = 0;        ///< place among the mesh instances of all nodes, in document order
    scenes::Box3 boxWS;      ///< SurfaceBounds
    double sideMetres = 0.0; ///< SurfaceBounds::textureSideMetres
    std::string name;        ///< of messages
};

/// Those that are drawn, in document order. A view's SpreadLightAtlas has a cell for each.
std::vector<SpreadingObject> spreadingObjects(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface,
                                              std::span<const SurfaceBounds> bounds);

/// Light as it has spread so far is spread on by a Gaussian, and a share of it goes into the sum.
struct DiffusionLevel {
    double varianceSquareMetres = 0.0; ///< that is added to texels of the object's mean size, in metres of the scene
    glm::dvec3 weight{0.0};
    /// Of light that has spread by this level and those before, with what showing texels adds.
    double spreadSquareMetres = 0.0;
    bool operator==(const DiffusionLevel&) const = default;
};
/// How an object's light spreads. All weights sum to 1 in each channel. Showing texels spreads their light already, by
/// texelVariance(): levels add what is missing. A narrower Gaussian has its variance from two shares, one that texels
/// show as they are lit and one that does not spread, which pixels reflect of the frame's lights like other surfaces.
struct LightSpread {
    glm::dvec3 inPixels{0.0}, inTexels{0.0};
    std::vector<DiffusionLevel> levels; ///< from the narrowest Gaussian on
    double texelMetres = 0.0;           ///< what it was made for
};
/// The least that a level spreads light from and the most that it spreads it to: a texel shows less than the mean,
/// where it is smaller, so that its first level adds more.
struct LevelReach {
    double fromSquareMetres = 0.0, toSquareMetres = 0.0;
    double mostSquareMetres() const { return toSquareMetres - fromSquareMetres; } ///< variance that it adds
};
LevelReach levelReach(const LightSpread& spread, std::size_t level);
/// By how much light spreads that is sampled at texels and interpolated between them, in squares of a texel: a tent's,
/// and where four texels became one, theirs around its middle.
constexpr double texelVariance(bool isHalved) {
    return 1.0 / 6.0 + (isHalved ? 1.0 / 16.0 : 0.0);
}
constexpr double texelVariance(double texelMetres, bool isHalved) {
    return texelMetres * texelMetres * texelVariance(isHalved);
}
/// With fewer Gaussians than the profile has, neighbours become one of their mean variance. Where one is so wide that
/// taps of the next would miss what lies between them, levels without weight stand before it. Texels of 0 metres, those
/// of an object without area, show every Gaussian.
LightSpread lightSpread(const scenes::Subsurface& subsurface, int mostGaussians, double texelMetres,
                        bool isHalved = false);

/// Texels outside of charts that know where the surface goes on: 3.5 standard deviations of the widest level, but 64 at
/// most; a power of two.
int gutterTexels(const std::vector<DiffusionLevel>& levels, double texelMetres);
/// Around what the coordinates 0 to 1 cover.
int borderTexels(int gutterTexels, int sideTexels);
/// On a surface of which the coordinates 0 to 1 cover `sideMetres`: they lie on the texels within the border
/// (UvAtlas::placeOf()).
double texelMetresOf(double sideMetres, int sideTexels, int borderTexels);

/// The view's picture of spread light: a square cell for each object, and above all cells one texel for each, in rows
/// as they lie.
struct SpreadLightAtlas {
    int columns = 1, rows = 1;
    int sideTexels = 0;
    glm::ivec2 texels() const { return {columns * sideTexels, rows * (sideTexels + 1)}; }
    glm::ivec2 place(int cell) const { return {cell % columns, cell / columns}; }
    glm::ivec2 corner(int cell) const { return place(cell) * sideTexels; }
    /// rgb LightSpread::inPixels, a the border of the object's UV atlas in texels.
    glm::ivec2 ofCell(int cell) const { return place(cell) + glm::ivec2(0, rows * sideTexels); }
};
SpreadLightAtlas spreadLightAtlas(std::size_t objects, int sideTexels);

/// An object's UV atlas on the GPU.
struct GpuUvAtlas {
    int borderTexels = 0;
    gpu::Texture steps;     ///< RGBA32F: shaders/shared/diffusion.h
    gpu::Texture continued; ///< RG32F, the same
    std::vector<DiffusionTile> tiles;
};

/// The UV atlases of a scene, made when they are asked for.
class GpuUvAtlases {
public:
    explicit GpuUvAtlases(const scenes::Scene& scene) : scene_(scene) {}
    /// Throws InputError where the object's texture coordinates do not unwrap it.
    const GpuUvAtlas& of(const SpreadingObject& object, int sideTexels, int gutterTexels);
    /// Drops all, since they hold for meshes and nodes as they were.
    void forget() { atlases_.clear(); }

private:
    const scenes::Scene& scene_;
    std::map<std::tuple<int, int, int>, std::unique_ptr<GpuUvAtlas>> atlases_;
};

/// Throws InputError where the object's texture coordinates do not unwrap it.
void requireUnwrapped(const scenes::Scene& scene, const SpreadingObject& object);

/// What is known of the cells of a view's SpreadLightAtlas from earlier frames, tile by tile: the light that enters the
/// surface, and the light that leaves it, spread. Both hold for the key that they were computed under (diffusionKey()).
class DiffusionMemory {
public:
    /// Forgets the light that leaves where the view's atlas is not held.
    void begin(std::size_t cells, bool holdsAtlas);
    /// How many tiles the next frame may light, of those it lacks; none: all. Spreading kSpreadTiles takes the place of
    /// lighting one.
    void limit(std::optional<std::size_t> tiles) { tilesLeft_ = tiles; }
    bool isLimited() const { return tilesLeft_.has_value(); }
    static constexpr std::size_t kSpreadTiles = 8; ///< docs/skin.md, "What it costs"
    void forget() { cells_.assign(cells_.size(), {}); }
    void forgetLit(std::size_t cell) { cells_[cell].lit = {}; }

    /// Those of the tiles whose light that leaves, or that enters, is not known.
    TileSet missing(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    TileSet unlit(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    void hold(std::size_t cell, std::uint64_t key, const TileSet& lit, const TileSet& spread);
    /// No light is known there, and the atlas says so.
    void holdBlank(std::size_t cell, std::uint64_t key, const TileSet& blank);

    /// Whether the frame has nothing to do for the tiles: they are known, or it may add no light and the atlas says
    /// what is not.
    bool isIdle(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    /// What the frame is to compute of those tiles, which is taken off its limit. `variancesSquareMetres` as of
    /// diffusionWork().
    DiffusionWork next(std::size_t cell, std::uint64_t key, const std::vector<DiffusionTile>& atlas,
                       const std::vector<double>& variancesSquareMetres, const TileSet& tiles);

private:
    struct Cell {
        std::optional<std::uint64_t> key;
        TileSet lit, stored, blank;
    };
    /// Tiles of the atlas of which pixels may find what was never written.
    TileSet unwritten(std::size_t cell, std::uint64_t key, int side) const;

    std::vector<Cell> cells_;
    std::optional<std::size_t> tilesLeft_;
};

} // namespace tessera::frame
