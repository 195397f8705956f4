#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Shows the shadow atlas for the view `shadow_atlas`, which replaces the lit picture: in the middle, by the nearest
/// texel, in strips below one another where it is so wide that its texels become larger then.
/// Reads   the atlas D32F, where the view has one
/// Writes  radiance RGBA32F: x the depth as stored, 0 where there is no caster; y how near the caster is to its light,
///         from 1 to 1/4; z the number of the face in its light, from 1, negated at its rim, 0 of texels of no face;
///         alpha 1 in the atlas, or anywhere where there is none. Depth D32F, 0: nothing of the scene is drawn. Both
///         are of FrameSpec::samples
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
