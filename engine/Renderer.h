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

/// A picture read back from the GPU. Rows run from the top.
struct RenderedFrame {
    int width = 0;
    int height = 0;
    std::vector<float> radiance;       ///< RGBA, linear, before exposure; A is the share of the pixel that is covered
    std::vector<std::uint8_t> display; ///< RGBA, display code values; empty where the settings did not ask for them
};

/// Reads pictures back: radiance RGBA32F and, where not null, display RGBA8 of the same size.
RenderedFrame readBack(const gpu::Texture& radiance, const gpu::Texture* display);

/// Which lights a drawn frame's pixels visited, and how.
struct DrawnLists {
    culling::Choice culling;
    culling::LightLists lists;    ///< empty where every pixel visits every light
    shared::ViewConstants view{}; ///< with lighting, how a pixel finds its tile, slice and cell
    shared::LightingConstants lighting{};
    frame::DepthInterval depths;           ///< the view depths of depth values
    std::vector<int> sceneIndex;           ///< by light of the lists: index into Scene::lights
    std::vector<std::uint32_t> everywhere; ///< lights of the lists that reach everywhere, ascending
};

/// How the lights of a drawn view cast shadows.
struct DrawnShadows {
    struct Light {
        int sceneIndex = 0;   ///< into Scene::lights
        int faces = 0;        ///< of its shadow maps
        int wantedTexels = 0; ///< side of a face where the budget is no matter
        int sideTexels = 0;   ///< what it got; 0: the budget has no room for it, and it casts no shadows
    };
    bool hasMaps = false;             ///< else shadows are traced, and numbers of maps are 0
    std::vector<Light> lights;        ///< that reach what is in view and cast shadows
    std::optional<std::size_t> shown; ///< the one among them that views of one light show
    glm::ivec2 atlasTexels{0};        ///< of frame::kShadowTexelBytes each
    double budgetMiB = 0.0;           ///< that the atlas keeps within
    std::size_t faces = 0;            ///< in the atlas
    std::size_t drawnFaces = 0;       ///< those that this frame drew; the atlas held the others
    std::string missing;              ///< which shadows the view lacks, and what to do; empty: none
    std::string cut;                  ///< how shadows may have made pixels NaN, and what to do; empty: they have not
};

/// How much of the light that a frame lacks, since it was not yet spread over surfaces (docs/skin.md), it may add. What
/// is missing then is drawn as if its light did not spread.
struct SpreadLimit {
    std::size_t tiles = 0; ///< of shared/diffusion.h, to be lit; spreading their light is counted in these too
    bool isOfAll = false;  ///< also of what the frame does not see, for those that follow, up to kMostOfAllBytes
};

/// Light of more is kept only where it is seen: FrameSpec::spreadLightBytes().
constexpr double kMostOfAllBytes = double(1u << 30u);

/// How far light has spread over the objects of a view: those of which all is known that the view sees, or is to know.
struct SpreadProgress {
    bool isOfAll = false; ///< whatever it sees
    std::size_t objects = 0, doneObjects = 0;
    std::size_t tiles = 0, doneTiles = 0;
    bool isDone() const { return doneTiles == tiles; }
};

/// What a resource of a frame holds at the end of it: a texture, or so many bytes of a buffer.
struct KeptResource {
    const gpu::Texture* texture = nullptr;
    const gpu::Buffer* buffer = nullptr;
    std::size_t bytes = 0;
};

/// Renders pictures of one scene, with any technique and settings, on the context that is current. Everything derived
/// from the scene is made once and kept.
class Renderer {
public:
    /// The scene must outlive the renderer.
    Renderer(gpu::Context& context, const scenes::Scene& scene, shader::SourceTree shaders = shader::SourceTree());
    Renderer(gpu::Context& context, scenes::Scene&& scene, shader::SourceTree shaders = shader::SourceTree()) = delete;
    ~Renderer();

    /// Draws one frame of one or more views and does not wait; download() reads it, passTimings() times it. The views
    /// share the scene's data on the GPU, so their settings of filter and pruning must be equal. Throws InputError if
    /// they are not, or if settings name things that the scene lacks; std::runtime_error when GL fails. `after` adds
    /// passes to each view; what they declare as outputs of the graph, texture() gives. After a throw no frame is there
    /// to be read.
    void draw(std::span<const ViewRequest> views, const AfterOpaque& after = {});
    void draw(Technique technique, const frame::FrameSettings& settings) {
        const ViewRequest view{technique, settings};
        draw({&view, 1});
    }

    /// The programs that draw() would use for a view; what is kept of earlier frames may spare it some of them. Throws
    /// InputError as draw() does.
    std::vector<shader::ProgramDesc> programsOf(Technique technique, const frame::FrameSettings& settings) const;

    /// The picture of a view of the latest draw(), counted from 0.
    RenderedFrame download(std::size_t view = 0) const;
    /// The same where it is, until the next draw(): radiance RGBA32F, and display RGBA8 where the settings asked for
    /// it.
    const gpu::Texture& radianceTexture(std::size_t view = 0) const;
    const gpu::Texture& displayTexture(std::size_t view = 0) const;

    /// An output of the latest draw() that its AfterOpaque declared.
    const gpu::Texture& texture(graph::TextureHandle output) const;

    /// Frames from now on keep the resource that has this name in their plans (graph::Plan::Resource) to their end;
    /// empty: none.
    void keepResource(std::string name) { keptName_ = std::move(name); }
    /// Of the latest draw(), until the next; none where it did not use that resource.
    std::optional<KeptResource> keptResource() const;

    /// Depth of a view of the latest draw(): reverse-Z, rows from the bottom, 0 where nothing opaque was drawn.
    std::vector<float> downloadDepth(std::size_t view = 0) const;
    /// The light lists that a view of the latest draw() really used.
    DrawnLists downloadLists(std::size_t view = 0) const;
    /// How the lights of a view of the latest draw() cast shadows; waits for nothing.
    DrawnShadows shadows(std::size_t view = 0) const;
    /// Which textures of materials a view of the latest draw() lacks, and why; empty: none.
    std::string missingTextures(std::size_t view = 0) const;
    /// Over which objects of a view of the latest draw() light is asked to spread and does not; empty: none.
    std::string unseenSpread(std::size_t view = 0) const;

    RenderedFrame render(Technique technique, const frame::FrameSettings& settings) {
        draw(technique, settings);
        return download();
    }

    /// To be called after factors of the scene's materials were changed, not their textures: the next draw() takes them
    /// as they are then. Lights and cameras of the scene may change between draws without notice.
    void materialsChanged() {
        for (Uploaded& uploaded : uploaded_) uploaded.materialsChanged = true;
    }

    /// To be called after vertices of the scene's meshes, transforms of its nodes or factors of its materials were
    /// changed (scenes::applyPose()), but not which instances there are nor their attributes, triangles and textures:
    /// the next draw() uploads them. Programs and textures stay, unless an emission, a layer, transmission or a
    /// texture's transform begins or ends, or other lights reach the view. The latest frame is gone.
    void geometryChanged();

    /// To be called after clips posed the scene anew: either of the two above, or neither.
    void partsMoved(const scenes::MovingParts& parts) {
        if (parts.geometry)
            geometryChanged();
        else if (parts.materials)
            materialsChanged();
    }

    /// To be called after the scene got another map of its environment; how that lies and shines may change without
    /// notice. Who has filtered the map already may bring that.
    void environmentChanged(std::shared_ptr<const frame::FilteredEnvironment> filtered = {});

    /// Light that has spread over surfaces is kept until something changes that it depends on (docs/skin.md), unless
    /// this is off: then each frame spreads it anew, as measuring it asks for.
    void keepSpreadLight(bool keeps) { keepsSpreadLight_ = keeps; }
    /// Of the frames that follow; none: they add all that they lack.
    void limitSpreadLight(std::optional<SpreadLimit> limit) { spreadLimit_ = limit; }
    /// Tells during draw(), of how many objects a view's light has spread of all that it spreads anew: first 0 of them,
    /// where there are any, then after each. Once it has told, the GPU has done so much. May be empty.
    void tellSpread(std::function<void(std::size_t done, std::size_t objects)> told) { spreadTold_ = std::move(told); }
    /// After a view of the latest draw().
    SpreadProgress spreadProgress(std::size_t view = 0) const;

    /// The scene as frames of this spec have it on the GPU.
    const frame::SceneGpu& sceneGpu(const frame::FrameSpec& spec);
    void makeForShadows(const frame::FrameSpec& spec);

    gpu::GraphBackend& backend() { return backend_; }
    shader::ProgramLibrary& programs() { return programs_; }
    /// As the latest frame shows it: with the vertices that its hook has moved.
    const scenes::Scene& scene() const { return shown_; }
    /// The same at a time. Where vertices move, the latest frame is gone.
    const scenes::Scene& sceneAt(double timeSeconds, Excess excess = Excess::Refuse);
    std::span<const frame::SurfaceBounds> bounds() const { return bounds_; }

private:
    struct Drawn;
    const Drawn& latest() const;
    /// Whether a view is to know all light that spreads, seen or not.
    bool spreadsAll(const frame::PreparedView& view) const {
        return spreadLimit_ && spreadLimit_->isOfAll && view.spec.spreadLightBytes() <= kMostOfAllBytes;
    }
    frame::TileSet seenTiles(const frame::SpreadingObject& object, const frame::GpuUvAtlas& atlas,
                             const frame::DrawnView& view) const;
    /// The objects of a view that light spreads over.
    void addSpreadingViews(std::size_t number, frame::DrawnView& view);

    /// Has the frame's views tell, as tellSpread() asks for.
    void tellSpreadOf(std::vector<frame::DrawnView>& views) const;

    void forgetGeometry();
    /// Light that has spread and shadow maps, where an edit of the hook or of shaders has given programs another form.
    void forgetReloaded();

    gpu::Context& context_;
    std::unique_ptr<HookedScene> hooked_; ///< null where no hook moves vertices
    const scenes::Scene& shown_;
    std::vector<frame::SurfaceBounds> bounds_;
    scenes::ClosedMeshes closedMeshes_;
    shader::ProgramLibrary programs_;
    std::size_t reloaded_ = 0; ///< ProgramLibrary::reloaded() as forgetReloaded() knows it
    gpu::GraphBackend backend_;
    std::string keptName_; ///< keepResource()
    frame::LightListMemory listMemory_;
    frame::ShadowMemories shadowMemories_;
    frame::GpuUvAtlases uvAtlases_;
    std::map<std::size_t, frame::DiffusionMemory> diffusionMemories_; ///< by view
    bool keepsSpreadLight_ = true;
    std::optional<SpreadLimit> spreadLimit_;
    std::function<void(std::size_t, std::size_t)> spreadTold_;
    std::shared_ptr<const frame::FilteredEnvironment> filteredEnvironment_; ///< null: not yet, or on the GPU
    std::unique_ptr<frame::EnvironmentGpu> environment_; ///< made with the first frame that has use for it
    frame::LobesGpu lobes_;
    frame::LightPicturesGpu lightPictures_;
    /// The scene as frames of some settings need it.
    struct Uploaded {
        frame::FeatureSet features;
        frame::TextureFilter filter;
        scenes::SubsurfaceRequest subsurface;
        std::unique_ptr<frame::SceneGpu> scene;
        bool materialsChanged = false;
        bool geometryChanged = false;
    };
    std::vector<Uploaded> uploaded_; ///< the latest first, and the one before: two sides of a comparison alternate
    std::unique_ptr<Drawn> drawn_;   ///< the latest frame; null before the first and after one that failed
};

/// What a frame of one view would run, leave out and need, without a context.
graph::Plan planFrame(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings);
/// The passes and resources of a frame of several views, as Renderer::draw() draws it. Throws InputError as that does.
graph::Plan planViews(const scenes::Scene& scene, std::span<const ViewRequest> views, const AfterOpaque& after = {});

/// The programs a frame would use, without a context.
std::vector<shader::ProgramDesc> framePrograms(const scenes::Scene& scene, Technique technique,
                                               const frame::FrameSettings& settings);

} // namespace tessera::engine
