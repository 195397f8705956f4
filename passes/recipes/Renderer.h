#pragma once
#include <memory>
#include <vector>

#include "passes/recipes/Techniques.h"
#include "renderer/gpu/Context.h"
#include "renderer/gpu/GraphBackend.h"

namespace tessera::recipes {

/// A picture read back from the GPU. Rows run from the top.
struct RenderedFrame {
    int width = 0;
    int height = 0;
    std::vector<float> radiance;       ///< RGBA, linear, before exposure; A is the share of the pixel that is covered
    std::vector<std::uint8_t> display; ///< RGBA, display code values
};

/// Renders pictures of one scene, with any technique and settings, on the context that is current. Everything derived
/// from the scene is made once and kept.
class Renderer {
public:
    /// The scene must outlive the renderer.
    Renderer(gpu::Context& context, const scenes::Scene& scene, shader::SourceTree shaders = shader::SourceTree());
    ~Renderer();

    /// Draws one frame and waits for nothing; download() reads it, passTimings() times it. Throws InputError when the
    /// settings name what the scene lacks, std::runtime_error when GL fails.
    void draw(Technique technique, const frame::FrameSettings& settings);

    /// The picture of the latest draw().
    RenderedFrame download() const;

    RenderedFrame render(Technique technique, const frame::FrameSettings& settings) {
        draw(technique, settings);
        return download();
    }

    gpu::GraphBackend& backend() { return backend_; }
    shader::ProgramLibrary& programs() { return programs_; }
    const scenes::Scene& scene() const { return scene_; }

private:
    struct Drawn;
    void prepareScene(const frame::FrameSpec& spec);
    void uploadLights(const frame::PackedLights& lights);

    gpu::Context& context_;
    const scenes::Scene& scene_;
    shader::ProgramLibrary programs_;
    gpu::GraphBackend backend_;
    gpu::Buffer frameConstants_;
    gpu::Buffer displayConstants_;
    frame::LightListBuffers lightLists_;
    std::unique_ptr<gpu::Buffer> lightBuffer_;
    std::unique_ptr<gpu::TexelBuffer> lightTexels_;
    std::unique_ptr<frame::SceneGpu> sceneGpu_;
    frame::FeatureSet sceneFeatures_; ///< what sceneGpu_ was made with
    std::unique_ptr<Drawn> drawn_;    ///< the latest frame
};

/// What a frame would run, leave out and need, without a context.
graph::Plan planFrame(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings);

/// The programs a frame would use, without a context.
std::vector<shader::ProgramDesc> framePrograms(const scenes::Scene& scene, Technique technique,
                                               const frame::FrameSettings& settings);

} // namespace tessera::recipes
