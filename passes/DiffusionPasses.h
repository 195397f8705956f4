#pragma once
#include <array>
#include <string>

#include "renderer/frame/DiffusionSchedule.h"
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Diffuses an object's irradiance over its surface, in its UV atlas, and stores it in the view's diffused irradiance
/// atlas (docs/skin.md).
/// Reads   the scene, the lights that reach the object, and its irradiance kept from earlier frames
/// Writes  a cell of the atlas, RGBA32F: rgb diffused irradiance over pi times albedo^preScatterShare, a 1 where known;
///         and the constants of the cell. entering_light and undiffused_light, kept for later frames: the same before
///         diffusion, and the part of it that leaves the texels where it enters
/// Space   UV atlas; lights around the object, in world axes
/// Source  d'Eon and Luebke 2007, GPU Gems 3, chapter 14; Green 2004, GPU Gems, chapter 16
struct DiffusionPasses {
    /// An object's undiffused light, kept across frames: entering irradiance, and the part that leaves where it enters.
    struct Light {
        graph::TextureHandle entering, undiffused;
    };
    struct Params {
        std::size_t cell = 0;
        frame::DiffusionTask task;
    };
    struct Inputs {
        frame::SurfaceHandles surfaces; ///< as drawn by the object's diffusion view
        frame::LightingInputs lighting;
        graph::TextureHandle diffusionAtlas;
        Light light;                                ///< kept()
        const frame::GpuUvAtlas* uvAtlas = nullptr; ///< null for a plan
    };
    struct Outputs {
        graph::TextureHandle diffusionAtlas;
    };
    /// Names of a cell's persistent textures besides the diffused irradiance atlas.
    static std::array<std::string, 2> keptNames(std::size_t view, std::size_t cell);
    static Light kept(graph::Graph& graph, const frame::FrameSpec& view, std::size_t viewNumber, std::size_t cell);
    static graph::TextureDesc diffusionAtlas(const frame::FrameSpec& view);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& view, const Params& params, const Inputs& inputs);
};

} // namespace tessera::passes
