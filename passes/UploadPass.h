#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Uploads a view's camera and draws.
/// Writes  the view's constants; rows and commands of the draws that may be visible; constants of the scene's hook
struct UploadViewPass {
    struct Outputs {
        graph::BufferHandle constants, rows, commands;
        std::optional<graph::BufferHandle> hook; ///< shared::HookConstants
    };
    /// `drawn`, null for a plan, must live while the graph runs.
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const frame::DrawnView* drawn);
};

/// Uploads a view's lights.
/// Writes  light texels (shaders/shared/light.h), followed by faces of shadow maps; lighting constants;
///         shared::EnvironmentConstants if an environment lights surfaces or is visible; shared::CasterTreeConstants if
///         shadows are traced; shared::SeenLightTexels if area lights are visible
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
