#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "renderer/culling/LightLists.h"
#include "renderer/frame/Diffusion.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/LightPictures.h"
#include "renderer/frame/LobesGpu.h"
#include "renderer/frame/PreparedView.h"
#include "renderer/frame/SceneGpu.h"
#include "renderer/frame/ShadowMemory.h"
#include "renderer/graph/Graph.h"

/// Typed handles of inputs that several passes share. `read` declares the reads in a pass's setup, `bind` binds them
/// while the pass runs. Their creator sets every member.
namespace tessera::frame {

/// Buffers for building light lists on the CPU, kept from frame to frame.
struct LightListMemory {
    culling::LightListBuilder builder;
    std::vector<float> depth, transparentDepth;
    std::vector<std::uint32_t> normals; ///< words of the G-buffer texture with the normals
};

/// The CPU's data of a view while its frame runs. Passes get a pointer to it, which is null if the frame is only
/// planned.
struct DrawnView {
    PreparedView prepared;
    const SceneGpu* scene = nullptr;
    EnvironmentGpu* environment = nullptr; ///< if the view uses it
    LobesGpu* lobes = nullptr;             ///< likewise
    LightPicturesGpu* lightPictures = nullptr;
    ViewDraws draws;
    LightListMemory* listMemory = nullptr;
    ShadowMemory* shadowMemory = nullptr; ///< if the view has shadow maps

    /// A diffusing object, drawn into its UV atlas.
    struct DiffusionView;                       // contains a DrawnView, so no initializer may need it complete
    std::vector<DiffusionView> diffusionViews;  ///< by cell of the view's DiffusionAtlas
    DiffusionMemory* diffusionMemory = nullptr; ///< if the view has diffusing objects
    std::function<void()> objectDiffused = {};  ///< called after an object's light is diffused; may be empty
};
struct DrawnView::DiffusionView {
    DrawnView drawn;
    const GpuUvAtlas* uvAtlas = nullptr;
    std::uint64_t key = 0; ///< hash of all inputs of its light
    TileSet seen;          ///< tiles of the UV atlas that the view may sample
};

/// The camera of a view.
struct ViewHandles {
    graph::BufferHandle constants; ///< shared::ViewConstants

    ViewHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// Environment lighting (EnvironmentGpu). A pass reads the handles that are set.
struct EnvironmentHandles {
    graph::BufferHandle constants; ///< shared::EnvironmentConstants
    std::optional<graph::TextureHandle> map, filtered;
    std::optional<graph::BufferHandle> samples;
    EnvironmentHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The tables of lobes (LobesGpu). A pass reads the handles that are set.
struct LobeHandles {
    LobesGpu* lobes = nullptr; ///< null if the frame is only planned
    std::optional<graph::TextureHandle> table, shapes;
    LobeHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The scene's buffers, shared by all views of a frame.
struct SceneHandles {
    std::vector<graph::BufferHandle> vertices; ///< one per stream
    graph::BufferHandle indices;
    graph::BufferHandle materials;                    ///< shared::MaterialConstants of each
    std::optional<graph::BufferHandle> materialTable; ///< if surfaces store material numbers
    std::optional<graph::BufferHandle> subsurfaces;   ///< if lighting reads them: shared::SubsurfaceConstants
    std::optional<graph::BufferHandle> facetNormals;  ///< with shadows: another vertex stream, for lit surfaces
    std::optional<graph::BufferHandle> casters;       ///< with traced shadows: shaders/shared/caster_tree.h
    EnvironmentHandles environment;                   ///< without constants; parts that some view uses
    LobeHandles lobes;                                ///< those that some view uses
    std::optional<graph::BufferHandle> lightPictures; ///< with textured lights: shaders/shared/light_pictures.h
};

/// The scene as a view draws it.
struct SurfaceHandles {
    const DrawnView* drawn = nullptr;
    SceneHandles scene;
    ViewHandles view;                                       ///< empty if a pass draws with its own cameras
    graph::BufferHandle rows;                               ///< DrawRows of each draw of the view
    graph::BufferHandle commands;                           ///< gpu::DrawIndexedCommand of the same
    std::optional<graph::TextureHandle> diffusedLight = {}; ///< with diffusing objects: the atlas of their light
    std::optional<graph::BufferHandle> hook = {};           ///< with a scene hook: shared::HookConstants
    std::vector<std::size_t> depthPrograms = {};            ///< of readDepth(): opaque, then masked if there is one

    enum class Kind { Opaque, Transparent };

    SurfaceHandles read(graph::PassBuilder& pass) const;
    /// Draws the surfaces of a kind with the program in use, as SceneGpu::draw().
    void draw(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state,
              std::optional<gpu::Blend> transmitting = {}) const;
    /// Draws the opaque surfaces in parts (gpu::drawInParts()), for a pass with expensive geometry.
    void drawOpaqueInParts(const graph::PassContext& context, const gpu::PipelineState& state) const;

    /// read() and draw() for a depth-only pass with the programs of depthPrograms(). Materials are read only if some
    /// are alpha-masked.
    SurfaceHandles readDepth(graph::PassBuilder& pass, const std::vector<shader::ProgramDesc>& programs) const;
    void drawDepth(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state) const;
    /// The same for any batches, for a pass that binds its own camera.
    void drawDepth(const graph::PassContext& context, std::span<const Batch> batches,
                   const gpu::PipelineState& state) const;

private:
    SurfaceHandles readGeometry(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
    SceneGpu::ViewBuffers buffers(const graph::PassContext& context) const {
        return {context.buffer(rows), context.buffer(commands)};
    }
};

/// Light lists (shaders/shared/light_lists.h) in which a pass looks up the lights of a pixel.
struct LightListHandles {
    graph::BufferHandle tiles;   ///< shared::LightTile each
    graph::BufferHandle cells;   ///< uvec2 each
    graph::BufferHandle entries; ///< uint each

    LightListHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};
/// Names, in a plan, of the buffers whose sizes are measured while the frame runs.
inline constexpr const char* kLightCellsName = "light_cells";
inline constexpr const char* kLightEntriesName = "light_entries";

/// The shadow casters.
struct CasterTreeHandles {
    graph::BufferHandle constants; ///< shared::CasterTreeConstants
    graph::BufferHandle casters;   ///< texels (shaders/shared/caster_tree.h)

    CasterTreeHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// Inputs of a lighting pass.
struct LightingInputs {
    ViewHandles view;
    graph::BufferHandle constants;                         ///< shared::LightingConstants
    graph::BufferHandle lights;                            ///< texels (shaders/shared/light.h)
    std::optional<graph::BufferHandle> materialTable;      ///< if surfaces store material numbers
    std::optional<graph::BufferHandle> subsurfaces;        ///< with subsurface scattering: shared::SubsurfaceConstants
    std::optional<LightListHandles> lists;                 ///< if FrameSpec::culling requires them
    std::optional<CasterTreeHandles> casterTree;           ///< with traced shadows
    std::optional<graph::TextureHandle> shadowAtlas;       ///< with shadow maps
    std::optional<EnvironmentHandles> environment;         ///< if it lights surfaces
    LobeHandles lobes;                                     ///< those that lights and the environment need
    std::optional<graph::BufferHandle> lightPictures = {}; ///< with textured lights in view

    LightingInputs read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The G-buffer, and the depths of its surfaces.
struct GBufferHandles {
    std::vector<graph::TextureHandle> textures; ///< by attachment, as FrameSpec::gbufferTextures()
    graph::TextureHandle depth;                 ///< D32F, reverse-Z; 0 where nothing is drawn

    /// `depthAccess`: Sampled, or DepthTest, which may be sampled too.
    GBufferHandles read(graph::PassBuilder& pass, const FrameSpec& spec,
                        graph::Access depthAccess = graph::Access::Sampled) const;
    void bind(const graph::PassContext& context) const;
};

/// The image behind refractive objects: finished opaque surfaces at one sample per pixel, RGBA32F: rgb radiance
/// premultiplied by a, the coverage.
struct BehindHandles {
    graph::TextureHandle picture;
    std::optional<graph::TextureHandle> levels; ///< if some objects blur it: FrameSpec::behindLevels()
    /// Depth of its surfaces at pixel centres, R32F; none at one sample per pixel, where the depth buffer serves.
    std::optional<graph::TextureHandle> depth;

    BehindHandles read(graph::PassBuilder& pass, const FrameSpec& spec) const;
    void bind(const graph::PassContext& context) const;
};

/// Depths from which light lists are built.
struct LitDepths {
    /// Opaque surfaces: the depth buffer, D32F; with several samples per pixel, the depth range in which each pixel is
    /// shaded, RG32F: x nearest depth, y farthest depth negated, x 0 where there is no surface.
    graph::TextureHandle opaque;
    std::optional<graph::TextureHandle> transparent; ///< RG32F, the same range

    LitDepths read(graph::PassBuilder& pass, const FrameSpec& spec,
                   graph::Access access = graph::Access::Sampled) const;
    /// Binds them as textures.
    void bind(const graph::PassContext& context) const;
};

/// Imports the scene's buffers into a graph. `scene` is null if the frame is only planned. Features are the scene's, so
/// any of the frame's views has them. `scene` must have its casters if some view traces shadows.
SceneHandles importScene(graph::Graph& graph, std::span<const FrameSpec* const> specs, const SceneGpu* scene);
/// Imports the parts of the environment that views of these specs use; null if the frame is only planned.
EnvironmentHandles importEnvironment(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                     EnvironmentGpu* environment);
/// Imports the lobe tables in the same way.
LobeHandles importLobes(graph::Graph& graph, std::span<const FrameSpec* const> specs, LobesGpu* lobes);
/// Imports the textures of lights in the same way; `drawn` is any of the views, or null.
std::optional<graph::BufferHandle> importLightPictures(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                                       const DrawnView* drawn);
/// Binds them to the texture unit that shaders read.
void bindLightPictures(const graph::PassContext& context, graph::BufferHandle pictures);

} // namespace tessera::frame
