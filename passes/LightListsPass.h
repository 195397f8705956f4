#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Builds the light lists of FrameSpec::culling on the CPU from the depths at which surfaces will be lit.
/// Reads   the depths at which opaque and transparent surfaces are lit (frame::LitDepths); normals of opaque ones
/// Writes  light tiles, cells and entries (shaders/shared/light_lists.h)
/// Space   culling space (shaders/shared/culling.h)
/// Source  Harada 2012, "A 2.5D Culling for Forward+"; Olsson 2012, "Clustered Deferred and Forward Shading"; Drobot
/// 2017, "Improved Culling for Tiled and Clustered Rendering"
struct LightListsPass {
    /// The G-buffer's texture with normals.
    struct Normals {
        graph::TextureHandle texture;
        culling::NormalEncoding encoding;
    };
    struct Inputs {
        frame::LitDepths depths;
        std::optional<Normals> normals; ///< if and only if FrameSpec::culling uses them
    };
    struct Outputs {
        Inputs read;
        frame::LightListHandles lists;
    };
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::DrawnView* drawn);
};

} // namespace tessera::passes
