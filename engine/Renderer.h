#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/HookedScene.h"
#include "engine/Settings.h"
#include "engine/Techniques.h"
#include "renderer/frame/DepthInterval.h"
#include "renderer/gpu/Context.h"
#include "renderer/gpu/GraphBackend.h"
#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Clips.h"
#include "scenes/ClosedBodies.h"

namespace tessera::engine {

/// An image read back from the GPU. Rows run top-down.
struct RenderedFrame {
    int width = 0;
    int height = 0;
    std::vector<float> radiance;       ///< RGBA, linear, before exposure; A: covered fraction of the pixel
    std::vector<std::uint8_t> display; ///< RGBA, display code values; empty unless requested
};

/// Reads images back: radiance RGBA32F and, if not null, display RGBA8 of the same size.
RenderedFrame readBack(const gpu::Texture& radiance, const gpu::Texture* display);

/// The light lists of a drawn view, and the constants to look pixels up in them.
struct DrawnLists {
    culling::Choice culling;
    culling::LightLists lists;    ///< empty where every pixel visits every light
    shared::ViewConstants view{}; ///< with `lighting`, gives a pixel's tile, slice and cell
    shared::LightingConstants lighting{};
    frame::DepthInterval depths;           ///< converts depth values to view depths
    std::vector<int> sceneIndex;           ///< index into Scene::lights, by light of the lists
    std::vector<std::uint32_t> everywhere; ///< unbounded lights of the lists, ascending
};

/// Shadow statistics of a drawn view.
struct DrawnShadows {
    struct Light {
        int sceneIndex = 0;   ///< into Scene::lights
        int faces = 0;        ///< of its shadow maps
        int wantedTexels = 0; ///< side of a face without the budget
        int sideTexels = 0;   ///< actual side; 0: the budget is exceeded, the light casts no shadows
    };
    bool hasMaps = false;             ///< else shadows are traced, and numbers of maps are 0
    std::vector<Light> lights;        ///< shadowed lights that reach the view
    std::optional<std::size_t> shown; ///< index of the light that views of one light display
    glm::ivec2 atlasTexels{0};        ///< of frame::kShadowTexelBytes each
    double budgetMiB = 0.0;           ///< limit of the atlas
    std::size_t faces = 0;            ///< in the atlas
    std::size_t drawnFaces = 0;       ///< drawn by this frame; the others were kept from earlier ones
    std::string missing;              ///< warning: missing shadows, with a remedy; empty: none
    std::string cut; ///< warning: truncated shadow loops may have made pixels NaN, with a remedy; empty: none
};

/// Work limit for updating stale subsurface irradiance (docs/skin.md); the rest is shaded undiffused.
struct DiffusionLimit {
    std::size_t tiles = 0; ///< tiles (shared/diffusion.h) to light; diffusing tiles counts against it too
    bool isOfAll = false;  ///< also updates tiles not visible in this frame, up to kMostOfAllBytes
};

/// Beyond this size (FrameSpec::diffusionBytes()), diffused irradiance is kept only for visible tiles.
constexpr double kMostOfAllBytes = double(1u << 30u);

/// Progress of diffusion in a view: its objects and tiles, and those up to date.
struct DiffusionProgress {
    bool isOfAll = false; ///< counts all tiles, not only visible ones
    std::size_t objects = 0, doneObjects = 0;
    std::size_t tiles = 0, doneTiles = 0;
    bool isDone() const { return doneTiles == tiles; }
};

/// The contents of a resource at the end of a frame: a texture, or `bytes` of a buffer.
struct KeptResource {
    const gpu::Texture* texture = nullptr;
    const gpu::Buffer* buffer = nullptr;
    std::size_t bytes = 0;
};

/// Renders images of one scene, with any technique and settings, on the current context. Data derived from the scene is
/// made once and kept.
class Renderer {
public:
    /// The scene must outlive the renderer.
    Renderer(gpu::Context& context, const scenes::Scene& scene, shader::SourceTree shaders = shader::SourceTree());
    Renderer(gpu::Context& context, scenes::Scene&& scene, shader::SourceTree shaders = shader::SourceTree()) = delete;
    ~Renderer();

    /// Draws a frame of one or more views without waiting for the GPU; download() reads it, backend() times it. Views
    /// share the scene's GPU data, so settings with Setting::isOfFrame must be equal. Throws InputError if they are
    /// not, or if settings name things that the scene lacks; std::runtime_error if GL fails. `after` adds passes to
    /// each view; texture() returns the graph outputs that they declare. After a throw, the latest frame may be gone.
    void draw(std::span<const ViewRequest> views, const AfterOpaque& after = {});
    void draw(Technique technique, const frame::FrameSettings& settings) {
        const ViewRequest view{technique, settings};
        draw({&view, 1});
    }

    /// The programs that draw() would use for a view; data kept from earlier frames may make some unnecessary. Throws
    /// InputError as draw() does.
    std::vector<shader::ProgramDesc> programsOf(Technique technique, const frame::FrameSettings& settings) const;

    /// Downloads the image of a view of the latest draw(); views count from 0.
    RenderedFrame download(std::size_t view = 0) const;
    /// The same on the GPU, valid until the next draw(): radiance RGBA32F and, if requested, display RGBA8.
    const gpu::Texture& radianceTexture(std::size_t view = 0) const;
    const gpu::Texture& displayTexture(std::size_t view = 0) const;

    /// An output of the latest draw() that its AfterOpaque declared.
    const gpu::Texture& texture(graph::TextureHandle output) const;

    /// Keeps the resource of this plan name (graph::Plan::Resource) to the end of following frames; empty: none.
    void keepResource(std::string name) { keptName_ = std::move(name); }
    /// That resource after the latest draw(), valid until the next; none if it was not used.
    std::optional<KeptResource> keptResource() const;

    /// Depth of a view of the latest draw(): reverse-Z, rows from the bottom, 0 where nothing opaque was drawn.
    std::vector<float> downloadDepth(std::size_t view = 0) const;
    /// The light lists that a view of the latest draw() used.
    DrawnLists downloadLists(std::size_t view = 0) const;
    /// Shadow statistics of a view of the latest draw(); does not wait for the GPU.
    DrawnShadows shadows(std::size_t view = 0) const;
    /// Warning: material textures that a view of the latest draw() lacks, with the reason; empty: none.
    std::string missingTextures(std::size_t view = 0) const;
    /// Warning: objects of a view of the latest draw() whose requested diffusion has no effect; empty: none.
    std::string invisibleDiffusion(std::size_t view = 0) const;

    RenderedFrame render(Technique technique, const frame::FrameSettings& settings) {
        draw(technique, settings);
        return download();
    }

    /// Call after changing factors of the scene's materials, but not textures; the next draw() uploads them. Lights and
    /// cameras of the scene may change between draws without notice.
    void materialsChanged() {
        for (Uploaded& uploaded : uploaded_) uploaded.materialsChanged = true;
    }

    /// Call after changing vertices of meshes, transforms of nodes or factors of materials (scenes::applyPose()), but
    /// not the set of instances, nor their attributes, triangles and textures; the next draw() uploads them. Programs
    /// and textures stay, unless an emission, a layer, transmission or a texture's transform appears or disappears, or
    /// other lights reach the view. The latest frame is discarded.
    void geometryChanged();

    /// Call after clips posed the scene: calls one of the two above, or neither.
    void partsMoved(const scenes::MovingParts& parts) {
        if (parts.geometry)
            geometryChanged();
        else if (parts.materials)
            materialsChanged();
    }

    /// Call after the scene's environment map was replaced; its rotation and intensity may change without notice.
    /// `filtered` is the map already filtered, if available.
    void environmentChanged(std::shared_ptr<const frame::FilteredEnvironment> filtered = {});

    /// On: keeps diffused irradiance until one of its inputs changes (docs/skin.md). Off: each frame recomputes it, for
    /// measurements.
    void keepDiffusedLight(bool keeps) { keepsDiffusedLight_ = keeps; }
    /// Sets the limit for following frames; none: they update everything missing.
    void limitDiffusion(std::optional<DiffusionLimit> limit) { diffusionLimit_ = limit; }
    /// Progress callback during draw(), (done, total): the GPU has diffused the light of `done` of the objects to
    /// update. First called with done = 0, if there are any, then after each object. May be empty.
    void reportDiffusion(std::function<void(std::size_t done, std::size_t objects)> report) {
        reportDiffusion_ = std::move(report);
    }
    /// Diffusion progress of a view after the latest draw().
    DiffusionProgress diffusionProgress(std::size_t view = 0) const;

    /// The scene's GPU data for frames of this spec.
    const frame::SceneGpu& sceneGpu(const frame::FrameSpec& spec);
    void makeForShadows(const frame::FrameSpec& spec);

    gpu::GraphBackend& backend() { return backend_; }
    shader::ProgramLibrary& programs() { return programs_; }
    /// The scene of the latest frame, with vertices displaced by its hook.
    const scenes::Scene& scene() const { return shown_; }
    /// The same at a given time. If vertices move, the latest frame is discarded.
    const scenes::Scene& sceneAt(double timeSeconds, Excess excess = Excess::Refuse);
    std::span<const frame::SurfaceBounds> bounds() const { return bounds_; }

private:
    struct Drawn;
    const Drawn& latest() const;
    /// Whether a view updates all diffusion tiles, visible or not.
    bool diffusesAll(const frame::PreparedView& view) const {
        return diffusionLimit_ && diffusionLimit_->isOfAll && view.spec.diffusionBytes() <= kMostOfAllBytes;
    }
    frame::TileSet seenTiles(const frame::DiffusionObject& object, const frame::GpuUvAtlas& atlas,
                             const frame::DrawnView& view) const;
    /// Adds the diffusion views of a view's objects.
    void addDiffusionViews(std::size_t number, frame::DrawnView& view);

    /// Connects the frame's views to the callback of reportDiffusion().
    void connectDiffusionReport(std::vector<frame::DrawnView>& views) const;

    void forgetGeometry();
    /// Drops diffused irradiance and shadow maps if an edit of the hook or of shaders has replaced programs.
    void forgetReloaded();

    gpu::Context& context_;
    std::unique_ptr<HookedScene> hooked_; ///< null where no hook moves vertices
    const scenes::Scene& shown_;
    std::vector<frame::SurfaceBounds> bounds_;
    scenes::ClosedMeshes closedMeshes_;
    shader::ProgramLibrary programs_;
    std::size_t reloaded_ = 0; ///< ProgramLibrary::reloaded() at the last forgetReloaded()
    gpu::GraphBackend backend_;
    std::string keptName_; ///< keepResource()
    frame::LightListMemory listMemory_;
    frame::ShadowMemories shadowMemories_;
    frame::GpuUvAtlases uvAtlases_;
    std::map<std::size_t, frame::DiffusionMemory> diffusionMemories_; ///< by view
    bool keepsDiffusedLight_ = true;
    std::optional<DiffusionLimit> diffusionLimit_;
    std::function<void(std::size_t, std::size_t)> reportDiffusion_;
    std::shared_ptr<const frame::FilteredEnvironment> filteredEnvironment_; ///< null: not filtered yet, or on the GPU
    std::unique_ptr<frame::EnvironmentGpu> environment_;                    ///< made by the first frame that needs it
    frame::LobesGpu lobes_;
    frame::LightPicturesGpu lightPictures_;
    /// The scene's GPU data for some settings.
    struct Uploaded {
        frame::FeatureSet features;
        frame::TextureFilter filter;
        scenes::SubsurfaceRequest subsurface;
        std::unique_ptr<frame::SceneGpu> scene;
        bool materialsChanged = false;
        bool geometryChanged = false;
    };
    std::vector<Uploaded> uploaded_; ///< the two latest, newest first: two sides of a comparison alternate
    std::unique_ptr<Drawn> drawn_;   ///< the latest frame; null before the first and after a failed execution
};

/// Plans a frame of one view, without a context.
graph::Plan planFrame(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings);
/// Plans a frame of several views as Renderer::draw() draws it. Throws InputError as that does.
graph::Plan planViews(const scenes::Scene& scene, std::span<const ViewRequest> views, const AfterOpaque& after = {});

/// The programs of all passes of a frame, including culled ones, without a context.
std::vector<shader::ProgramDesc> framePrograms(const scenes::Scene& scene, Technique technique,
                                               const frame::FrameSettings& settings);

} // namespace tessera::engine
