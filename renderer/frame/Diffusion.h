#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/UvAtlas.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Texture.h"
#include "scenes/Scene.h"

/// Light that spreads over the surfaces of objects (docs/skin.md): which objects, by which Gaussians, in which atlas,
/// and what is kept from frame to frame.
namespace tessera::frame {

/// A mesh instance whose material spreads light over it.
struct DiffusedObject {
    int node = 0;
    int mesh = 0;
    int material = 0;
    int instance = 0;        ///< place among the mesh instances of all nodes, in document order
    scenes::Box3 boxWS;      ///< of its vertices
    double sideMetres = 0.0; ///< of the world, that a side of its texture covers, by areas; 0: no area
    std::string name;        ///< of messages
};

/// Those that are drawn, in document order. A view's atlas has a cell for each.
std::vector<DiffusedObject> diffusedObjects(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface);
/// Whether there are any.
bool diffusesLight(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface);

/// Light as it has spread so far is spread on by a Gaussian, and a share of it goes into the sum.
struct DiffusionLevel {
    double varianceSquareMetres = 0.0; ///< that is added, in metres of the scene
    glm::dvec3 weight{0.0};
    bool operator==(const DiffusionLevel&) const = default;
};
/// From the narrowest Gaussian on; their weights sum to 1 in each channel. With fewer Gaussians than the profile has,
/// neighbours become one of their mean variance. Where one is so wide that taps of the next would miss what lies
/// between them, levels without weight stand before it.
std::vector<DiffusionLevel> diffusionLevels(const scenes::Subsurface& subsurface, int mostGaussians,
                                            double texelMetres);

/// Texels outside of charts that know where the surface goes on: 3.5 standard deviations of the widest level, but 64 at
/// most; a power of two.
int gutterTexels(const std::vector<DiffusionLevel>& levels, double texelMetres);
/// Around what the coordinates 0 to 1 cover.
int borderTexels(int gutterTexels, int sideTexels);

/// Texels of a view's atlas: a square cell for each object.
struct DiffusedCells {
    int columns = 1;
    int sideTexels = 0;
    glm::ivec2 texels{0};
    glm::ivec2 corner(int cell) const { return {(cell % columns) * sideTexels, (cell / columns) * sideTexels}; }
};
DiffusedCells diffusedCells(std::size_t objects, int sideTexels);

/// An object's atlas on the GPU.
struct DiffusionAtlas {
    int borderTexels = 0;
    gpu::Texture steps;          ///< RGBA32F: shaders/shared/diffusion.h
    gpu::Texture continued;      ///< RG32F, the same
    gpu::Buffer triangleNormals; ///< vec4 each, unit, of the front, axes of the world
};

/// The atlases of a scene, made when they are asked for.
class DiffusionAtlases {
public:
    explicit DiffusionAtlases(const scenes::Scene& scene) : scene_(scene) {}
    /// Throws InputError where the object's texture coordinates do not unwrap it.
    const DiffusionAtlas& of(const DiffusedObject& object, int sideTexels, int gutterTexels);

private:
    const scenes::Scene& scene_;
    std::map<std::tuple<int, int, int>, std::unique_ptr<DiffusionAtlas>> atlases_;
};

/// Throws InputError where the object's texture coordinates do not unwrap it.
void requireUnwrapped(const scenes::Scene& scene, const DiffusedObject& object);

/// What the cells of a view's atlas hold from earlier frames, by what they were computed from.
class DiffusionMemory {
public:
    /// Forgets all where the atlas is not held.
    void begin(std::size_t cells, bool holdsAtlas);
    bool holds(std::size_t cell, std::uint64_t key) const { return held_[cell] == key; }
    void hold(std::size_t cell, std::uint64_t key) { held_[cell] = key; }

private:
    std::vector<std::optional<std::uint64_t>> held_;
};

} // namespace tessera::frame
