#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws shadow casters as seen from lights into the faces of an atlas (renderer/frame/ShadowMaps.h). The atlas
/// persists across frames: only faces that it lacks are drawn, and if it has all, there is no pass.
/// Reads   the scene
/// Writes  the atlas D32F, reverse-Z, 0 without a caster; both sides of casters, each triangle biased away from the
///         light by its change of depth over half a texel or more, so that no triangle shadows itself within a texel
/// Space   of each face
struct ShadowMapsPass {
    struct Inputs {
        frame::SceneHandles scene;
        const frame::DrawnView* drawn = nullptr; ///< null for a plan
        std::size_t view = 0;                    ///< counted from 0; numbers the atlas of a plan
    };
    struct Outputs {
        graph::TextureHandle atlas;
    };
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
