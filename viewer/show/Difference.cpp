#include "viewer/show/Difference.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/display.h"
#include "shaders/shared/slots.h"

namespace tessera::viewer {
namespace {

shader::ProgramDesc program() {
    return shader::screenProgram("difference", "passes/difference.frag");
}

} // namespace

void Difference::update(shader::ProgramLibrary& programs, const Target& radianceA, const Target& radianceB,
                        float factor) {
    if (!image_ || image_->sizePixels() != radianceA.sizePixels())
        image_ = std::make_unique<Target>("difference", graph::Format::Rgba8Unorm, radianceA.sizePixels());
    shared::DisplayConstants constants{};
    constants.exposure.x = factor;
    if (!constants_)
        constants_ = std::make_unique<gpu::Buffer>("difference constants", sizeof constants, gpu::BufferUse::Dynamic);
    constants_->uploadValue(constants);
    gpu::bindFramebuffer(image_->framebuffer());
    gpu::setState({});
    gpu::useProgram(programs.get(program()));
    gpu::bindUniformBuffer(UNIFORM_PASS, *constants_);
    gpu::bindTexture(TEXTURE_UNIT_RADIANCE, radianceA.texture());
    gpu::bindTexture(TEXTURE_UNIT_DEPTH, radianceB.texture());
    gpu::drawFullscreenTriangle();
}

} // namespace tessera::viewer
