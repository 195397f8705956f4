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

/// Texture-space diffusion of irradiance (docs/skin.md): its objects, their Gaussians and atlas, and the state kept
/// from frame to frame.
namespace tessera::frame {

/// A mesh instance whose material uses texture-space diffusion.
struct DiffusionObject {
    int node = 0;
    int mesh = 0;
    int material = 0;
    int instance = 0;        ///< place among the mesh instances of all nodes, in document order
    scenes::Box3 boxWS;      ///< SurfaceBounds
    double sideMetres = 0.0; ///< SurfaceBounds::textureSideMetres
    std::string name;        ///< for messages
};

/// The drawn objects with diffusion, in document order. A view's DiffusionAtlas has one cell for each.
std::vector<DiffusionObject> diffusionObjects(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface,
                                              std::span<const SurfaceBounds> bounds);

/// One of successive Gaussian blurs: blurs the result of the level before it, and adds it to the sum by its weight.
struct DiffusionLevel {
    double varianceSquareMetres = 0.0; ///< added variance at the object's mean texel size, in scene metres squared
    glm::dvec3 weight{0.0};
    /// Total variance after this level, including texelVariance().
    double totalSquareMetres = 0.0;
    bool operator==(const DiffusionLevel&) const = default;
};
/// The diffusion of an object's irradiance. All weights sum to 1 in each channel. Texel interpolation already blurs by
/// texelVariance(); levels add the rest. A narrower Gaussian is split into two fractions that match its variance:
/// `inTexels`, read from the texels as lit, and `inPixels`, undiffused, shaded per pixel like other surfaces.
struct DiffusionKernel {
    glm::dvec3 inPixels{0.0}, inTexels{0.0};
    std::vector<DiffusionLevel> levels; ///< narrowest first
    double texelMetres = 0.0;           ///< mean texel size it was made for
};
/// Bounds of the total variance before and after a level. Texels smaller than the mean blur less by interpolation, so
/// the first level may start at 0 and add more.
struct LevelReach {
    double fromSquareMetres = 0.0, toSquareMetres = 0.0;
    double mostSquareMetres() const { return toSquareMetres - fromSquareMetres; } ///< largest added variance
};
LevelReach levelReach(const DiffusionKernel& kernel, std::size_t level);
/// Variance of the blur by texel sampling and bilinear interpolation, in squared texels: that of a tent and, if halved,
/// that of the four averaged texels around their centre.
constexpr double texelVariance(bool isHalved) {
    return 1.0 / 6.0 + (isHalved ? 1.0 / 16.0 : 0.0);
}
constexpr double texelVariance(double texelMetres, bool isHalved) {
    return texelMetres * texelMetres * texelVariance(isHalved);
}
/// Merges neighbours at their mean variance if the profile has more than `mostGaussians`. Inserts levels of weight 0
/// before a Gaussian that is too wide for the level before it, since its taps would skip detail. With texels of 0
/// metres (an object without area), every Gaussian becomes a level.
DiffusionKernel diffusionKernel(const scenes::Subsurface& subsurface, int mostGaussians, double texelMetres,
                                bool isHalved = false);

/// Width of the gutter around charts, whose texels store where the surface continues: 3.5 standard deviations of the
/// widest level, 2 to 64 texels; a power of two.
int gutterTexels(const std::vector<DiffusionLevel>& levels, double texelMetres);
/// Width of the border around the texture coordinates 0 to 1.
int borderTexels(int gutterTexels, int sideTexels);
/// Mean texel size if the texture coordinates 0 to 1 span `sideMetres` of the surface. They cover the texels within the
/// border (UvAtlas::placeOf()).
double texelMetresOf(double sideMetres, int sideTexels, int borderTexels);

/// Layout of a view's image of diffused irradiance: a square cell per object and, above all cells, one parameter texel
/// per cell in the same grid.
struct DiffusionAtlas {
    int columns = 1, rows = 1;
    int sideTexels = 0;
    glm::ivec2 texels() const { return {columns * sideTexels, rows * (sideTexels + 1)}; }
    glm::ivec2 place(int cell) const { return {cell % columns, cell / columns}; }
    glm::ivec2 corner(int cell) const { return place(cell) * sideTexels; }
    /// The parameter texel of a cell: rgb DiffusionKernel::inPixels, a the border of the object's UV atlas in texels.
    glm::ivec2 ofCell(int cell) const { return place(cell) + glm::ivec2(0, rows * sideTexels); }
};
DiffusionAtlas diffusionAtlas(std::size_t objects, int sideTexels);

/// An object's UV atlas on the GPU.
struct GpuUvAtlas {
    int borderTexels = 0;
    gpu::Texture steps;     ///< RGBA32F: shaders/shared/diffusion.h
    gpu::Texture continued; ///< RG32F, the same
    std::vector<DiffusionTile> tiles;
};

/// The UV atlases of a scene, made on demand.
class GpuUvAtlases {
public:
    explicit GpuUvAtlases(const scenes::Scene& scene) : scene_(scene) {}
    /// Throws InputError where the object's texture coordinates do not unwrap it.
    const GpuUvAtlas& of(const DiffusionObject& object, int sideTexels, int gutterTexels);
    /// Drops all atlases, after meshes or nodes have changed.
    void forget() { atlases_.clear(); }

private:
    const scenes::Scene& scene_;
    std::map<std::tuple<int, int, int>, std::unique_ptr<GpuUvAtlas>> atlases_;
};

/// Throws InputError where the object's texture coordinates do not unwrap it.
void requireUnwrapped(const scenes::Scene& scene, const DiffusionObject& object);

/// Which tiles of a view's DiffusionAtlas are valid from earlier frames, per cell: `lit` is incoming irradiance,
/// `stored` is diffused, outgoing light. Both are valid for the key they were computed with (diffusionKey()).
class DiffusionMemory {
public:
    /// Invalidates the stored light if the view's atlas was not kept.
    void begin(std::size_t cells, bool holdsAtlas);
    /// Limits how many missing tiles the next frame may light; none: all. Diffusing kDiffusedTiles tiles counts as
    /// lighting one.
    void limit(std::optional<std::size_t> tiles) { tilesLeft_ = tiles; }
    bool isLimited() const { return tilesLeft_.has_value(); }
    static constexpr std::size_t kDiffusedTiles = 8; ///< docs/skin.md, "What it costs"
    void forget() { cells_.assign(cells_.size(), {}); }
    void forgetLit(std::size_t cell) { cells_[cell].lit = {}; }

    /// The tiles whose diffused (missing) or incoming (unlit) light is not valid.
    TileSet missing(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    TileSet unlit(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    void hold(std::size_t cell, std::uint64_t key, const TileSet& lit, const TileSet& diffused);
    /// Records tiles that the atlas marks as having no light.
    void holdBlank(std::size_t cell, std::uint64_t key, const TileSet& blank);

    /// Whether the tiles need no work: all are valid, or the limit is used up and the atlas marks the others as having
    /// no light.
    bool isIdle(std::size_t cell, std::uint64_t key, const TileSet& tiles) const;
    /// Returns the frame's work for the tiles and subtracts it from the limit. `variancesSquareMetres`: see
    /// diffusionWork().
    DiffusionWork next(std::size_t cell, std::uint64_t key, const std::vector<DiffusionTile>& atlas,
                       const std::vector<double>& variancesSquareMetres, const TileSet& tiles);

private:
    struct Cell {
        std::optional<std::uint64_t> key;
        TileSet lit, stored, blank;
    };
    /// Tiles of the atlas that were never written.
    TileSet unwritten(std::size_t cell, std::uint64_t key, int side) const;

    std::vector<Cell> cells_;
    std::optional<std::size_t> tilesLeft_;
};

} // namespace tessera::frame
