#pragma once
#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Averages the samples of each pixel in linear radiance, before exposure and tone map. A shader of its own rather than
/// a blit, whose filter and order OpenGL leaves to the driver: the sum runs over ascending samples everywhere.
/// Reads   radiance RGBA32F of FrameSpec::samples, linear
/// Writes  resolved RGBA32F of one sample: rgb the mean, alpha the share of the pixel that is covered
struct ResolvePass {
    struct Inputs {
        graph::TextureHandle radiance;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle resolved;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::FrameResources* resources);
};

} // namespace tessera::passes
