#pragma once
#include "engine/Renderer.h"
#include "renderer/gpu/Framebuffer.h"

namespace tessera::validation {

/// Draws all of a scene's geometry with a depth test and one constant value: the least work of any technique.
/// Reads   the scene
/// Writes  one RGBA32F target, 1 where there is geometry; depth D32F
/// Space   lighting space, through the vertex function that every pass shares
class LowerBoundGeometry {
public:
    /// The renderer must outlive the object. Throws InputError as Renderer::draw does.
    LowerBoundGeometry(engine::Renderer& renderer, const frame::FrameSettings& settings);

    /// Uploads the view's constants and draws for every frame, and draws them.
    void draw(const glm::dvec3& eyeOffsetWS);
    /// The latest image: RGBA, rows from the bottom.
    std::vector<float> download() const { return value_.downloadAs<float>(); }

    static shader::ProgramDesc program(const frame::FrameSpec& spec);

private:
    engine::Renderer& renderer_;
    frame::FrameSpec spec_;
    gpu::Buffer constants_;
    std::optional<gpu::Buffer> rows_, commands_; ///< of the latest frame's draws
    gpu::Texture value_;
    gpu::Texture depth_;
    gpu::Framebuffer framebuffer_;
};

} // namespace tessera::validation
