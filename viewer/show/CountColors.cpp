#include "viewer/show/CountColors.h"

#include <string>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/display.h"
#include "shaders/shared/slots.h"

namespace tessera::viewer {
namespace {

shader::ProgramDesc countColorsProgram() {
    return shader::screenProgram(
        "count_colors", "passes/display.frag",
        {{"DISPLAY_MAPPING", std::to_string(DISPLAY_COUNT)}, {"TONE_MAP", std::to_string(TONEMAP_NONE) + "u"}});
}

} // namespace

void CountColors::update(shader::ProgramLibrary& programs, const Target& radiance, const Target& display,
                         float log2Most) {
    shared::DisplayConstants constants{};
    constants.scales.x = log2Most;
    if (!constants_)
        constants_ = std::make_unique<gpu::Buffer>("count colors constants", sizeof constants, gpu::BufferUse::Dynamic);
    constants_->uploadValue(constants);
    gpu::bindFramebuffer(display.framebuffer());
    gpu::setState({});
    gpu::useProgram(programs.get(countColorsProgram()));
    gpu::bindUniformBuffer(UNIFORM_PASS, *constants_);
    gpu::bindTexture(TEXTURE_UNIT_RADIANCE, radiance.texture());
    gpu::drawFullscreenTriangle();
}

} // namespace tessera::viewer
