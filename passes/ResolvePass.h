#pragma once
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Reduces a pixel's samples to one value: of radiance the mean, linear, before exposure and tone map; of depths the
/// range. A shader of its own rather than a blit, whose filter and order OpenGL leaves to the driver: the sum runs over
/// ascending samples everywhere.
/// Reads   samples, of FrameSpec::samples: radiance RGBA32F, or depths RG32F, nearest and negated farthest
/// Writes  resolved, in the same format with one sample: rgb the mean, alpha the share of the pixel that is covered;
///         or the largest of each, so x nearest depth, y farthest depth negated; x is 0 where nothing was drawn
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
