#pragma once
#include "renderer/frame/FrameHandles.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Shows the surfaces of area lights: each sample's ray is met with them in closed form, so outlines are those of the
/// shapes. Its depths go into a texture of their own, since all that reads the other one asks for surfaces that lights
/// light.
/// Reads   depth D32F, reverse-Z, of opaque surfaces; shared::SeenLightTexels; where lights have any, their pictures
/// Writes  radiance RGBA32F, linear, before exposure, A 1, the coverage; seen_depth D32F: the nearest of what is opaque
///         and of lights
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
    /// That of the lights, and before it the one that copies depth.
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
