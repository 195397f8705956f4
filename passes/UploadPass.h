#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Uploads a view's camera and its draws.
/// Writes  the view's constants; rows and commands of the draws that it may see; what the scene's hook reads
struct UploadViewPass {
    struct Outputs {
        graph::BufferHandle constants, rows, commands;
        std::optional<graph::BufferHandle> hook; ///< shared::HookConstants
    };
    /// `drawn`, null for a plan, must live while the graph runs.
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const frame::DrawnView* drawn);
};

/// Puts a view's lights on the GPU.
/// Writes  light texels (shaders/shared/light.h), faces of shadow maps behind them, the constants of lighting; where an
///         environment shines or is seen, shared::EnvironmentConstants; where shadows are traced,
///         shared::CasterTreeConstants; where area lights are seen, shared::SeenLightTexels
/// Space   lighting space
struct UploadLightsPass {
    struct Outputs {
        graph::BufferHandle constants, lights;
        std::optional<graph::BufferHandle> environment; ///< shared::EnvironmentConstants
        std::optional<graph::BufferHandle> casterTree;
        std::optional<graph::BufferHandle> seenLights;
    };
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const frame::DrawnView* drawn);
};

} // namespace tessera::passes
