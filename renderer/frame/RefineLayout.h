#pragma once
#include <string_view>
#include <vector>

#include "renderer/frame/GBufferLayout.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// A channel that a scene needs stored finer than its layout says.
struct Refinement {
    Channel channel;
    Encoding encoding;
    std::string_view why; ///< for plans
};

/// The changes that the layout needs to keep its error bounds for this scene:
/// - albedo is exact where base colour times texture and vertex colour may exceed 1, specular where k_s may: their
///   packed fields are roots of 0 to 1. Pictures of floats count as brighter than 1.
/// - The normal of `slim` has the bits of `packed` if a material has masking-shadowing by the half vector, which
/// divides by n·v.
/// - Emission is exact where light spreads over a surface: it fades by many powers of ten.
std::vector<Refinement> refinements(const GBufferLayout& layout, const scenes::Scene& scene,
                                    scenes::SubsurfaceRequest subsurface = {});

/// The layout with its refinements.
GBufferLayout refined(GBufferLayout layout, const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface = {});

} // namespace tessera::frame
