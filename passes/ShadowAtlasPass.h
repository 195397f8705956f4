#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Shows the shadow atlas for the debug view `shadow_atlas`, which replaces the lit image: centred, with nearest
/// filtering, in vertically stacked strips if that makes its texels larger.
/// Reads   the atlas D32F, if the view has one
/// Writes  radiance RGBA32F: x the stored depth, 0 without a caster; y the caster's proximity to its light, from 1 to
///         1/4; z the number of the face in its light, from 1, negated at its rim, 0 outside of faces; alpha 1 in the
///         atlas, or everywhere if there is none. Depth D32F, 0: nothing of the scene is drawn. Both are of
///         FrameSpec::samples
struct ShadowAtlasPass {
    struct Inputs {
        std::optional<graph::TextureHandle> atlas;
        const frame::DrawnView* drawn = nullptr; ///< null for a plan
    };
    struct Outputs {
        std::optional<graph::TextureHandle> atlas; ///< as read
        graph::TextureHandle radiance;
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program();
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
