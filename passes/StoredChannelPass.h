#pragma once
#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Shows one channel of the G-buffer as it is stored, for the views `gbuffer.*`, which replace the lit picture.
/// Reads   one G-buffer channel in the layout's format, depth D32F
/// Writes  radiance RGBA32F: rgb the first three stored components, or the fourth three times; alpha 1; 0 where nothing
///         was drawn. A word of 32 bits counts as four components of 8, two words as four of 16
struct StoredChannelPass {
    struct Params {
        frame::StoredComponents shown;
    };
    struct Inputs {
        graph::TextureHandle channel;
        graph::TextureHandle depth;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle radiance;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, const Params& params);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs,
                       const frame::FrameResources* resources);
};

} // namespace tessera::passes
