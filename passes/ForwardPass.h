#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Shades surfaces as they are rasterised: all opaque ones, those visible after a depth prepass, or the transparent
/// ones over a lit image.
/// Reads   the scene, the frame's lights and light lists; depth D32F after a prepass or beneath transparent surfaces;
///         for glass bodies the image behind them RGBA32F (BehindGlassPass) and their far sides RGBA32F (FarSidesPass)
/// Writes  radiance RGBA32F, linear, before exposure; depth D32F without a prepass. All are of FrameSpec::samples; the
///         samples that a fragment covers share one shading
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
        std::optional<graph::TextureHandle> depth;    ///< of a prepass, or of opaque surfaces beneath transparent ones
        std::optional<graph::TextureHandle> radiance; ///< image to draw transparent surfaces over
        std::optional<frame::BehindHandles> behind = {};   ///< for transparent surfaces: FrameSpec::showsBehindGlass
        std::optional<graph::TextureHandle> farSides = {}; ///< for transparent surfaces: FrameSpec::drawsFarSides
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
