#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Shades surfaces as they are rasterised: all opaque ones, those that a prepass left in the depth buffer, or the
/// transparent ones on top of a lit picture.
/// Reads   the scene, the frame's lights and light lists; depth D32F after a prepass or under transparent surfaces, of
///         which bodies of glass look up what is behind, its picture RGBA32F (BehindGlassPass), and their own far
///         sides RGBA32F (FarSidesPass)
/// Writes  radiance RGBA32F, linear, before exposure; depth D32F when it comes first. All are of FrameSpec::samples; a
///         pixel's covered samples share one shading
/// Space   lighting space
/// Source  Walter 2007; Heitz 2014 (shaders/lib/reflectance/brdf.glsl)
struct ForwardPass {
    using Surfaces = frame::SurfaceHandles::Kind;
    struct Params {
        Surfaces surfaces = Surfaces::Opaque;
    };
    struct Inputs {
        frame::SurfaceHandles surfaces;
        frame::LightingInputs lighting;
        std::optional<graph::TextureHandle> depth; ///< of a prepass, or of the opaque surfaces under transparent ones
        std::optional<graph::TextureHandle> radiance;      ///< the picture to draw transparent surfaces on
        std::optional<frame::BehindHandles> behind = {};   ///< of transparent surfaces, FrameSpec::showsBehindGlass
        std::optional<graph::TextureHandle> farSides = {}; ///< of those, FrameSpec::drawsFarSides
    };
    struct Outputs {
        frame::SurfaceHandles surfaces; ///< as read
        frame::LightingInputs lighting; ///< as read
        graph::TextureHandle radiance;
        graph::TextureHandle depth;
        std::optional<frame::BehindHandles> behind;   ///< as read
        std::optional<graph::TextureHandle> farSides; ///< as read
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, const Params& params);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
