#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Shows one channel of the G-buffer as stored, for the debug views `gbuffer.*`, which replace the lit image.
/// Reads   the G-buffer in the layout's formats, depth D32F
/// Writes  radiance RGBA32F: rgb the first three stored components, or the fourth three times; alpha 1; 0 where nothing
///         was drawn. Components of a packed channel are its fields, each as a fraction of its largest code
struct StoredChannelPass {
    struct Params {
        frame::StoredComponents shown;
    };
    struct Inputs {
        frame::GBufferHandles gbuffer;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle radiance;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, const Params& params);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
