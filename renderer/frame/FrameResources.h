#pragma once
#include <span>

#include "renderer/frame/LightBuffers.h"
#include "renderer/frame/LightListBuffers.h"
#include "renderer/frame/SceneGpu.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Framebuffer.h"
#include "renderer/shader/ProgramLibrary.h"

namespace tessera::frame {

/// What passes draw with while a frame executes. Passes get a pointer when they are declared; it is null when only a
/// plan is wanted and must be valid when the graph runs.
struct FrameResources {
    const SceneGpu& scene;
    const gpu::Buffer& frameConstants;
    const gpu::Buffer& displayConstants;
    const LightBuffers& lights;
    LightListBuffers& lightLists;
    const shared::FrameConstants& constants;       ///< what frameConstants holds
    std::span<const shared::CullLight> cullLights; ///< parallel to `lights`
    glm::vec4 background; ///< what the radiance target is cleared to where no pass writes the background itself
    shader::ProgramLibrary& programs;
    gpu::FramebufferCache& framebuffers;
};

} // namespace tessera::frame
