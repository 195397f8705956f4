#pragma once
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Resolves a pixel's samples to one value: the mean of radiance, linear, before exposure and tone map, or the range of
/// depths. Uses a shader instead of a blit, whose filter and order OpenGL leaves to the driver, so that the sum always
/// runs over ascending samples.
/// Reads   samples, of FrameSpec::samples: radiance RGBA32F, or depths RG32F, nearest and negated farthest
/// Writes  resolved, in the same format with one sample: rgb the mean, alpha the covered fraction of the pixel; or the
///         maximum of each depth: x nearest, y farthest negated; x is 0 where nothing was drawn
struct ResolvePass {
    enum class Kind { Radiance, Depths, TransparentDepths };
    struct Params {
        Kind kind = Kind::Radiance;
    };
    struct Inputs {
        graph::TextureHandle samples;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle resolved;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, const Params& params);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
