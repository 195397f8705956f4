#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Spreads the light of an object over its surface, in an atlas of its texture coordinates (docs/skin.md).
/// Reads   the scene, the lights that reach the object, and what is known of its light from earlier frames
/// Writes  a cell of the view's atlas, RGBA32F: rgb what enters the surface, spread, times the albedo's power before
///         spreading; per model as its BRDF takes it (irradiance of Lambert's k_d); and what it knows of the cell
/// Space   of the atlas; lights around the object, in world axes
struct DiffusionPasses {
    struct Inputs {
        frame::SurfaceHandles surfaces; ///< as the object's own view draws it
        frame::LightingInputs lighting;
        graph::TextureHandle atlas;
        const frame::DrawnView* drawn = nullptr; ///< the view; null for a plan
        std::string viewSuffix;                  ///< of what is kept for the view
    };
    struct Outputs {
        graph::TextureHandle atlas;
    };
    static graph::TextureDesc atlas(const frame::FrameSpec& view);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& view, std::size_t cell, const Inputs& inputs);
};

} // namespace tessera::passes
