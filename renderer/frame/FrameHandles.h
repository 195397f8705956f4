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

/// Inputs that several passes have in common, as typed handles. `read` declares in a pass's setup that the pass reads
/// them, `bind` binds them while the pass runs. Their creator sets every member.
namespace tessera::frame {

/// Memory that light lists are built in on the CPU, kept from frame to frame.
struct LightListMemory {
    culling::LightListBuilder builder;
    std::vector<float> depth, transparentDepth;
    std::vector<std::uint32_t> normals; ///< words of the G-buffer's texture that holds them
};

/// The CPU's data of a view while its frame runs. Passes get a pointer to it, which is null if the frame is only
/// planned.
struct DrawnView {
    PreparedView prepared;
    const SceneGpu* scene = nullptr;
    EnvironmentGpu* environment = nullptr; ///< where the view has use for it
    LobesGpu* lobes = nullptr;             ///< likewise
    LightPicturesGpu* lightPictures = nullptr;
    ViewDraws draws;
    LightListMemory* listMemory = nullptr;
    ShadowMemory* shadowMemory = nullptr; ///< where the view has shadow maps

    /// An object that light spreads over, drawn into its texels.
    struct SpreadingView;                       // holds a DrawnView, so no initializer may need it whole
    std::vector<SpreadingView> spreadingViews;  ///< by cell of the view's SpreadLightAtlas
    DiffusionMemory* diffusionMemory = nullptr; ///< where the view has any
    std::function<void()> spreadOne = {};       ///< called when the light of an object was spread; may be empty
};
struct DrawnView::SpreadingView {
    DrawnView drawn;
    const GpuUvAtlas* uvAtlas = nullptr;
    std::uint64_t key = 0; ///< of all that its light is computed from
    TileSet seen;          ///< of the UV atlas, by the view
};

/// The camera of a view.
struct ViewHandles {
    graph::BufferHandle constants; ///< shared::ViewConstants

    ViewHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// Light from everywhere (EnvironmentGpu). A pass reads what it is given.
struct EnvironmentHandles {
    graph::BufferHandle constants; ///< shared::EnvironmentConstants
    std::optional<graph::TextureHandle> map, filtered;
    std::optional<graph::BufferHandle> samples;
    EnvironmentHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The tables of lobes (LobesGpu). A pass reads what it is given.
struct LobeHandles {
    LobesGpu* lobes = nullptr; ///< null if the frame is only planned
    std::optional<graph::TextureHandle> table, shapes;
    LobeHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The scene's own buffers, which all views of a frame share.
struct SceneHandles {
    std::vector<graph::BufferHandle> vertices; ///< a stream each
    graph::BufferHandle indices;
    graph::BufferHandle materials;                    ///< shared::MaterialConstants of each
    std::optional<graph::BufferHandle> materialTable; ///< where surfaces hold their material's number
    std::optional<graph::BufferHandle> subsurfaces;   ///< where lighting reads them: shared::SubsurfaceConstants
    std::optional<graph::BufferHandle> facetNormals;  ///< where there are shadows: a stream too, of lit surfaces
    std::optional<graph::BufferHandle> casters;       ///< where shadows are traced: shaders/shared/caster_tree.h
    EnvironmentHandles environment;                   ///< without constants; what some view has use for
    LobeHandles lobes;                                ///< what some view has use for
    std::optional<graph::BufferHandle> lightPictures; ///< where lights have any: shaders/shared/light_pictures.h
};

/// The scene as a view draws it.
struct SurfaceHandles {
    const DrawnView* drawn = nullptr;
    SceneHandles scene;
    ViewHandles view;                                     ///< empty where a pass draws with cameras of its own
    graph::BufferHandle rows;                             ///< DrawRows of each draw of the view
    graph::BufferHandle commands;                         ///< gpu::DrawIndexedCommand of the same
    std::optional<graph::TextureHandle> spreadLight = {}; ///< where light has spread over some: their atlas
    std::optional<graph::BufferHandle> hook = {};         ///< where the scene has one: shared::HookConstants
    std::vector<std::size_t> depthPrograms = {}; ///< of readDepth(), by number: bare, then where there is one, masked

    enum class Kind { Opaque, Transparent };

    SurfaceHandles read(graph::PassBuilder& pass) const;
    /// Draws the surfaces of a kind with the program in use, as SceneGpu::draw().
    void draw(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state,
              std::optional<gpu::Blend> transmitting = {}) const;
    /// The same of opaque surfaces as gpu::drawInParts(), for a pass whose geometry takes long.
    void drawOpaqueInParts(const graph::PassContext& context, const gpu::PipelineState& state) const;

    /// The same as draw() for a pass that wants depth alone and has the programs of depthPrograms(). Materials are read
    /// only where some have holes.
    SurfaceHandles readDepth(graph::PassBuilder& pass, const std::vector<shader::ProgramDesc>& programs) const;
    void drawDepth(const graph::PassContext& context, Kind kind, const gpu::PipelineState& state) const;
    /// The same of any batches, for a pass that binds a camera itself.
    void drawDepth(const graph::PassContext& context, std::span<const Batch> batches,
                   const gpu::PipelineState& state) const;

private:
    SurfaceHandles readGeometry(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
    SceneGpu::ViewBuffers buffers(const graph::PassContext& context) const {
        return {context.buffer(rows), context.buffer(commands)};
    }
};

/// Light lists (shaders/shared/light_lists.h), where a pass finds the lights of a pixel in them.
struct LightListHandles {
    graph::BufferHandle tiles;   ///< shared::LightTile each
    graph::BufferHandle cells;   ///< uvec2 each
    graph::BufferHandle entries; ///< uint each

    LightListHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};
/// What a plan calls the buffers whose bytes are counted while the frame runs.
inline constexpr const char* kLightCellsName = "light_cells";
inline constexpr const char* kLightEntriesName = "light_entries";

/// What hides lights.
struct CasterTreeHandles {
    graph::BufferHandle constants; ///< shared::CasterTreeConstants
    graph::BufferHandle casters;   ///< texels (shaders/shared/caster_tree.h)

    CasterTreeHandles read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// What a pass lights with.
struct LightingInputs {
    ViewHandles view;
    graph::BufferHandle constants;                         ///< shared::LightingConstants
    graph::BufferHandle lights;                            ///< texels (shaders/shared/light.h)
    std::optional<graph::BufferHandle> materialTable;      ///< where surfaces hold their material's number
    std::optional<graph::BufferHandle> subsurfaces;        ///< where surfaces have any: shared::SubsurfaceConstants
    std::optional<LightListHandles> lists;                 ///< where FrameSpec::culling asks for them
    std::optional<CasterTreeHandles> casterTree;           ///< where the view has shadows that are traced
    std::optional<graph::TextureHandle> shadowAtlas;       ///< where it has shadow maps
    std::optional<EnvironmentHandles> environment;         ///< where it lights surfaces
    LobeHandles lobes;                                     ///< those that lights and the environment need
    std::optional<graph::BufferHandle> lightPictures = {}; ///< where lights in view have any

    LightingInputs read(graph::PassBuilder& pass) const;
    void bind(const graph::PassContext& context) const;
};

/// The G-buffer, and the depths of its surfaces.
struct GBufferHandles {
    std::vector<graph::TextureHandle> textures; ///< by attachment, as FrameSpec::gbufferTextures()
    graph::TextureHandle depth;                 ///< D32F, reverse-Z; 0 where nothing is

    /// `depthAccess`: Sampled, or DepthTest, which may be sampled too.
    GBufferHandles read(graph::PassBuilder& pass, const FrameSpec& spec,
                        graph::Access depthAccess = graph::Access::Sampled) const;
    void bind(const graph::PassContext& context) const;
};

/// What bodies of glass see: the finished picture of opaque surfaces, of one sample a pixel, RGBA32F: rgb of what
/// covers the pixel, times a, the share that it covers.
struct BehindHandles {
    graph::TextureHandle picture;
    std::optional<graph::TextureHandle> levels; ///< where some bodies blur it: FrameSpec::behindLevels()
    /// Of its surfaces at the centres of pixels, R32F; none with one sample a pixel, whose depth buffer is that.
    std::optional<graph::TextureHandle> depth;

    BehindHandles read(graph::PassBuilder& pass, const FrameSpec& spec) const;
    void bind(const graph::PassContext& context) const;
};

/// What light lists are built from.
struct LitDepths {
    /// Of opaque surfaces: the depth buffer, D32F; with several samples per pixel the range in which each is lit,
    /// RG32F: x nearest depth, y farthest depth negated, x 0 where there is no surface.
    graph::TextureHandle opaque;
    std::optional<graph::TextureHandle> transparent; ///< RG32F, as that range

    LitDepths read(graph::PassBuilder& pass, const FrameSpec& spec,
                   graph::Access access = graph::Access::Sampled) const;
    /// As textures.
    void bind(const graph::PassContext& context) const;
};

/// Makes the scene's own buffers known to a graph. `scene` is null if the frame is only planned; features are those of
/// the scene, so any of the frame's views has them. Where some view traces shadows, `scene` has its casters.
SceneHandles importScene(graph::Graph& graph, std::span<const FrameSpec* const> specs, const SceneGpu* scene);
/// The same of what views of these specs use of the environment; null where the frame is only planned.
EnvironmentHandles importEnvironment(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                     EnvironmentGpu* environment);
/// The same of the tables of lobes.
LobeHandles importLobes(graph::Graph& graph, std::span<const FrameSpec* const> specs, LobesGpu* lobes);
/// The same of the pictures of lights; `drawn` is any of the views, or null.
std::optional<graph::BufferHandle> importLightPictures(graph::Graph& graph, std::span<const FrameSpec* const> specs,
                                                       const DrawnView* drawn);
/// Binds them where shaders read them.
void bindLightPictures(const graph::PassContext& context, graph::BufferHandle pictures);

} // namespace tessera::frame
