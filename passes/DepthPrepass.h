#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws the depth of opaque and alpha-masked geometry, so that later passes shade each pixel once.
/// Reads   the scene
/// Writes  depth D32F, reverse-Z, cleared to 0; on request shading_depth RG32F, the depth at which each sample's
///         fragment is lit (shaders/lib/raster/shading_place.glsl) and its negative, cleared to (0, -2). Both are of
///         FrameSpec::samples. With several samples a fragment is lit once, at the mean position of its covered
///         samples, so its depth may differ from all of theirs
/// Space   lighting space, through the vertex function that every pass shares
struct DepthPrepass {
    struct Params {
        bool shadingDepth = false;
    };
    struct Inputs {
        frame::SurfaceHandles surfaces;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle depth;
        std::optional<graph::TextureHandle> shadingDepth; ///< if Params::shadingDepth
    };
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec, const Params& params);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
