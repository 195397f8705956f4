#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

/// The techniques: how passes are wired into a frame. Passes know nothing of each other; here is the only place that
/// connects them.
namespace tessera::recipes {

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
struct TechniqueInfo {
    Technique technique;
    std::string_view name;
    std::string_view geometry; ///< what is rasterised, in words
    std::string_view lighting; ///< who lights what, in words
    bool usesGBuffer;
    std::span<const culling::Method> methods; ///< of light culling that it takes, the one it prefers first
    bool multisamples = false;                ///< takes more than one sample a pixel
};
std::span<const TechniqueInfo> techniqueTable();
const TechniqueInfo& infoOf(Technique technique);

/// A declared frame. The graph's outputs are radiance and, where the settings ask for it, display; both of one sample a
/// pixel. Alpha of radiance is the covered share of the pixel.
struct DeclaredFrame {
    graph::Graph graph;
    graph::TextureHandle radiance;                ///< RGBA32F, linear
    graph::TextureHandle depth;                   ///< D32F of opaque surfaces, reverse-Z
    graph::TextureHandle display;                 ///< RGBA8, display code values
    std::vector<shader::ProgramDesc> programs;    ///< every program its passes use
    std::optional<frame::LightListHandles> lists; ///< imported; absent where every pixel visits every light
};

/// Declares the frame of a technique. `resources` may be null when the graph is only planned; else it must be valid
/// while the graph runs.
DeclaredFrame declareFrame(Technique technique, const frame::FrameSpec& spec, const frame::FrameResources* resources);

} // namespace tessera::recipes
