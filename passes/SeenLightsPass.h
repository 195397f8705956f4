#pragma once
#include "renderer/frame/FrameHandles.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Draws the visible surfaces of area lights. Intersects each sample's ray with them in closed form, so outlines are
/// exact. Their depth goes to a separate texture, since all readers of the scene's depth expect lit surfaces.
/// Reads   depth D32F, reverse-Z, of opaque surfaces; shared::SeenLightTexels; images of the lights, if any
/// Writes  radiance RGBA32F, linear, before exposure, A 1, the coverage; seen_depth D32F: the nearest of opaque
///         surfaces and lights
/// Space   lighting space
struct SeenLightsPass {
    struct Inputs {
        frame::ViewHandles view;
        graph::BufferHandle lights;
        std::optional<graph::BufferHandle> pictures; ///< shaders/shared/light_pictures.h
        graph::TextureHandle depth;
        graph::TextureHandle radiance;
    };
    struct Outputs {
        frame::ViewHandles view;                     ///< as read
        graph::BufferHandle lights;                  ///< as read
        std::optional<graph::BufferHandle> pictures; ///< as read
        graph::TextureHandle depth;                  ///< as read
        graph::TextureHandle radiance;
        graph::TextureHandle seenDepth;
    };
    /// The program that copies depth, then the one that draws lights.
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
