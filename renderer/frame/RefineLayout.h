#pragma once
#include <string_view>
#include <vector>

#include "renderer/frame/GBufferLayout.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// A channel that a scene needs stored finer than in its layout.
struct Refinement {
    Channel channel;
    Encoding encoding;
    std::string_view why; ///< for plans
};

/// The changes that the layout needs to keep its error bounds for this scene, for example:
/// - Albedo is exact if base colour times texture and vertex colour may exceed 1, specular if k_s may: their packed
///   fields are roots of 0 to 1. Float images count as brighter than 1.
/// - The normal of `slim` has the bits of `packed` if a material has masking-shadowing by the half vector, which
///   divides by n·v.
/// - Emission is exact with diffusing objects: diffused light spans many powers of ten.
std::vector<Refinement> refinements(const GBufferLayout& layout, const scenes::Scene& scene,
                                    scenes::SubsurfaceRequest subsurface = {});

/// The layout with its refinements.
GBufferLayout refined(GBufferLayout layout, const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface = {});

} // namespace tessera::frame
