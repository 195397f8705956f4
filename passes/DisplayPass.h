#pragma once
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Converts radiance to display code values: exposure, tone map, sRGB transfer function.
/// Reads   radiance RGBA32F, linear
/// Writes  display RGBA8, sRGB code values
/// Source  of each curve: shaders/shared/tonemap.h
struct DisplayPass {
    struct Inputs {
        graph::TextureHandle radiance;
    };
    struct Outputs {
        graph::TextureHandle radiance; ///< as read
        graph::TextureHandle display;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
