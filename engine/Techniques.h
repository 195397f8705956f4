#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameHandles.h"

/// Techniques: how passes are connected to a frame. Passes are independent of each other; only this file connects them.
namespace tessera::engine {

enum class Technique : std::uint8_t {
    Forward,
    ForwardPrepass,
    Deferred,
    DeferredVolumes,
    TiledDeferred,
    ForwardPlus,
    ClusteredDeferred,
    ClusteredForward
};
/// The geometry pass that a technique starts with.
enum class Geometry : std::uint8_t { Shaded, DepthFirst, GBuffer };
std::string_view describe(Geometry geometry);

struct TechniqueInfo {
    Technique technique;
    std::string_view name;
    Geometry geometry;
    std::string_view lighting;                ///< description of which pixels are lit by which lights
    std::span<const culling::Method> methods; ///< supported light culling methods, preferred one first
    bool choosesStage = false;                ///< has a separate lighting pass, in fragment or compute shaders

    bool addsByBlending =
        false; ///< blends the lights into the image one by one, in document order; the driver chooses the rounding

    bool usesGBuffer() const { return geometry == Geometry::GBuffer; }
    bool multisamples() const { return geometry != Geometry::GBuffer; } ///< supports more than one sample per pixel
};
/// In the order of Technique.
std::span<const TechniqueInfo> techniqueTable();
const TechniqueInfo& infoOf(Technique technique);

/// The results of a view. The graph's outputs are radiance, depth, light lists and, if requested, display; both images
/// have one sample per pixel. Alpha of radiance is the covered fraction of the pixel.
struct DeclaredView {
    graph::TextureHandle radiance;                ///< RGBA32F, linear
    graph::TextureHandle depth;                   ///< D32F of opaque surfaces, reverse-Z
    graph::TextureHandle display;                 ///< RGBA8, display code values
    std::optional<frame::LightListHandles> lists; ///< absent where none were built
};

/// The output of the opaque passes.
struct OpaquePicture {
    graph::TextureHandle radiance; ///< RGBA32F, of FrameSpec::samples
    graph::TextureHandle depth;    ///< D32F, with the same samples
    /// If the technique has a G-buffer or AfterOpaque requests one: normals and materials, with single-sampled depth.
    std::optional<frame::GBufferHandles> gbuffer = {};
};

/// Passes between opaque and transparent surfaces, e.g. reflections or those of an application.
struct AfterOpaque {
    bool readsSurfaces = false; ///< requests OpaquePicture::gbuffer from every technique
    /// Declares the passes for a view, counted from 0. Returns the radiance, of FrameSpec::samples, that area lights
    /// and transparent surfaces are drawn over.
    std::function<graph::TextureHandle(graph::Graph& graph, std::size_t view, const frame::FrameSpec& spec,
                                       const OpaquePicture& opaque)>
        add;
};

/// Objects with diffusion are lit as separate views (frame::DrawnView::DiffusionView), numbered after the frame's
/// views, which are fewer than kMostDiffusionObjects.
constexpr std::size_t kMostDiffusionObjects = 4096; ///< per view
constexpr double kMostDiffusionGibibytes = 2.0;     ///< of a view's diffused irradiance atlas
constexpr std::size_t numberOfObject(std::size_t view, std::size_t cell) {
    return kMostDiffusionObjects * (view + 1) + cell;
}

/// The inputs of a view's declaration.
struct ViewSource {
    Technique technique;
    const frame::FrameSpec& spec;
    const frame::DrawnView* drawn = nullptr; ///< null if the frame is only planned; else it must outlive the graph
};

/// Declares the passes of a frame: what its views share, then each view in order. Needs at least one view.
std::vector<DeclaredView> declareFrame(graph::Graph& graph, std::span<const ViewSource> views,
                                       const AfterOpaque& after = {});

} // namespace tessera::engine
