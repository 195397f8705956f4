#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameHandles.h"

/// The techniques: how passes are wired into a frame. Passes know nothing of each other; here is the only place that
/// connects them.
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
/// What a technique rasterises first.
enum class Geometry : std::uint8_t { Shaded, DepthFirst, GBuffer };
std::string_view describe(Geometry geometry);

struct TechniqueInfo {
    Technique technique;
    std::string_view name;
    Geometry geometry;
    std::string_view lighting;                ///< what is lit by which lights, in words
    std::span<const culling::Method> methods; ///< of light culling that it takes, the one it prefers first
    bool choosesStage = false; ///< lights in a pass of its own, which may be of fragment or of compute shaders

    bool addsByBlending =
        false; ///< adds light after light to the picture, in the document's order; the driver chooses the rounding

    bool usesGBuffer() const { return geometry == Geometry::GBuffer; }
    bool multisamples() const { return geometry != Geometry::GBuffer; } ///< takes more than one sample per pixel
};
/// In the order of Technique.
std::span<const TechniqueInfo> techniqueTable();
const TechniqueInfo& infoOf(Technique technique);

/// The results of a view. The graph's outputs are radiance, depth, light lists and, where the settings ask for
/// it, display; both pictures have one sample per pixel. Alpha of radiance is the covered fraction of the pixel.
struct DeclaredView {
    graph::TextureHandle radiance;                ///< RGBA32F, linear
    graph::TextureHandle depth;                   ///< D32F of opaque surfaces, reverse-Z
    graph::TextureHandle display;                 ///< RGBA8, display code values
    std::optional<frame::LightListHandles> lists; ///< absent where none were built
};

/// What opaque geometry leaves for the passes after it.
struct OpaquePicture {
    graph::TextureHandle radiance; ///< RGBA32F, of FrameSpec::samples
    graph::TextureHandle depth;    ///< D32F, of the same
    /// Where the technique stores surfaces, or somebody asks for them: normals and materials, with depths of one sample
    /// a pixel.
    std::optional<frame::GBufferHandles> gbuffer = {};
};

/// Passes between opaque and transparent surfaces: reflections, say, or what an application adds.
struct AfterOpaque {
    bool readsSurfaces = false; ///< OpaquePicture::gbuffer is there whatever the technique
    /// Declares them for a view, counted from 0. Returns the radiance, of FrameSpec::samples, that area lights and
    /// transparent surfaces are drawn over.
    std::function<graph::TextureHandle(graph::Graph& graph, std::size_t view, const frame::FrameSpec& spec,
                                       const OpaquePicture& opaque)>
        add;
};

/// Objects that light spreads over are lit as views of their own (frame::DrawnView::SpreadingView), which are numbered
/// behind those of the frame, of which there are fewer.
constexpr std::size_t kMostSpreadingObjects = 4096; ///< of a view
constexpr double kMostSpreadLightGibibytes = 2.0;   ///< of the texture that holds the light of all of them
constexpr std::size_t numberOfObject(std::size_t view, std::size_t cell) {
    return kMostSpreadingObjects * (view + 1) + cell;
}

/// What a view is declared from.
struct ViewSource {
    Technique technique;
    const frame::FrameSpec& spec;
    const frame::DrawnView* drawn = nullptr; ///< null if the frame is only planned; else it must outlive the graph
};

/// Declares the passes of a frame: what its views share, then each view in order. There is at least one.
std::vector<DeclaredView> declareFrame(graph::Graph& graph, std::span<const ViewSource> views,
                                       const AfterOpaque& after = {});

} // namespace tessera::engine
