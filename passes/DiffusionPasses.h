#pragma once
#include <array>
#include <string>

#include "renderer/frame/DiffusionSchedule.h"
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Spreads the light of an object over its surface, in the object's atlas of texture coordinates, the UV atlas, into
/// the view's atlas of spread light (docs/skin.md). Reads   the scene, the lights that reach the object, and what is
/// known of its light from earlier frames Writes  a cell of the atlas of spread light, RGBA32F: rgb irradiance over pi
/// times the albedo to the power of
///         preScatterShare, spread, a 1 where it is known; and what pixels ask of the cell. entering_light and
///         unspread_light, which are kept for later frames: the same as lit, and the part of it that leaves the texels
///         where it is lit
/// Space   of the UV atlas; lights around the object, in world axes
/// Source  d'Eon and Luebke 2007, GPU Gems 3, chapter 14; Green 2004, GPU Gems, chapter 16
struct DiffusionPasses {
    /// What is kept of an object's light as it is lit: what enters its surface, and the part of it that leaves there.
    struct Light {
        graph::TextureHandle entering, unspread;
    };
    struct Params {
        std::size_t cell = 0;
        frame::DiffusionTask task;
    };
    struct Inputs {
        frame::SurfaceHandles surfaces; ///< as the object's own view draws it
        frame::LightingInputs lighting;
        graph::TextureHandle spreadLightAtlas;
        Light light;                                ///< kept()
        const frame::GpuUvAtlas* uvAtlas = nullptr; ///< null for a plan
    };
    struct Outputs {
        graph::TextureHandle spreadLightAtlas;
    };
    /// Names of what is kept of a cell besides the atlas of spread light.
    static std::array<std::string, 2> keptNames(std::size_t view, std::size_t cell);
    static Light kept(graph::Graph& graph, const frame::FrameSpec& view, std::size_t viewNumber, std::size_t cell);
    static graph::TextureDesc spreadLightAtlas(const frame::FrameSpec& view);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& view, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
