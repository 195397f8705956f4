#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Stores the nearest opaque or alpha-masked surface of each pixel.
/// Reads   the scene; depth D32F if another pass has drawn it, with one sample per pixel
/// Writes  the channels of FrameSpec::channels in the layout's textures (renderer/frame/GBufferLayout.h), depth D32F
///         reverse-Z if no other pass has
/// Space   lighting space
struct GBufferPass {
    struct Inputs {
        frame::SurfaceHandles surfaces;
        std::optional<graph::TextureHandle> depth = {}; ///< of the same surfaces, if drawn already
    };
    struct Outputs {
        Inputs read;
        frame::GBufferHandles gbuffer;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
