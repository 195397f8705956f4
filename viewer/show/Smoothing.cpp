#include "viewer/show/Smoothing.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "renderer/frame/VanDerCorput.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/display.h"
#include "shaders/shared/slots.h"

namespace tessera::viewer {
namespace {

shader::ProgramDesc sumProgram() {
    return shader::screenProgram("sum", "passes/sum.frag");
}

shader::ProgramDesc meanProgram(const frame::FrameSettings& settings) {
    return shader::screenProgram("mean", "passes/display.frag",
                                 {{"DISPLAY_MAPPING", std::to_string(DISPLAY_RADIANCE)},
                                  {"TONE_MAP", fmt::format("{}u", unsigned(settings.toneMap))}});
}

/// The second dimension of Sobol's sequence. Combined with van der Corput's, it places one of 2^n points in each of 2^n
/// boxes of any shape. Source: Kollig and Keller 2002, "Efficient Multidimensional Sampling".
double sobol(std::uint32_t number) {
    std::uint32_t fraction = 0;
    for (std::uint32_t direction = 1u << 31u; number != 0; number >>= 1u, direction ^= direction >> 1u)
        if ((number & 1u) != 0) fraction ^= direction;
    return double(fraction) * 0x1p-32;
}

Target& ofSize(std::unique_ptr<Target>& target, const char* label, graph::Format format, glm::ivec2 sizePixels) {
    if (!target || target->sizePixels() != sizePixels) target = std::make_unique<Target>(label, format, sizePixels);
    return *target;
}

} // namespace

glm::vec2 Smoothing::offsetPixels(int number) {
    constexpr double kMiddle = 0.5 / kPictures; // centres each of the 32 points in its strip, in x and in y
    const double x = frame::vanDerCorput(std::uint32_t(number)), y = sobol(std::uint32_t(number));
    return {float(x + kMiddle - 0.5), float(y + kMiddle - 0.5)};
}

void Smoothing::restart() {
    count_ = 0;
    isShown_ = false;
}

void Smoothing::add(shader::ProgramLibrary& programs, const gpu::Texture& radiance) {
    const glm::ivec2 size(radiance.desc().width, radiance.desc().height);
    assert(count_ == 0 || sum()->sizePixels() == size);
    Target& after = ofSize(sums_[std::size_t((count_ + 1) % 2)], "sum", graph::Format::Rgba32Float, size);
    if (count_ == 0) {
        after.copyFrom(radiance);
    } else {
        gpu::bindFramebuffer(after.framebuffer());
        gpu::setState({});
        gpu::useProgram(programs.get(sumProgram()));
        gpu::bindTexture(TEXTURE_UNIT_RADIANCE, sum()->texture());
        gpu::bindTexture(TEXTURE_UNIT_DEPTH, radiance);
        gpu::drawFullscreenTriangle();
    }
    ++count_;
}

void Smoothing::showMean(shader::ProgramLibrary& programs, const frame::FrameSettings& settings) {
    assert(count_ > 0);
    shared::DisplayConstants constants{};
    constants.exposure.x = std::exp2(settings.exposureEV) / float(count_);
    if (!constants_)
        constants_ = std::make_unique<gpu::Buffer>("mean constants", sizeof constants, gpu::BufferUse::Dynamic);
    constants_->uploadValue(constants);
    const Target& display = ofSize(display_, "mean", graph::Format::Rgba8Unorm, sum()->sizePixels());
    gpu::bindFramebuffer(display.framebuffer());
    gpu::setState({});
    gpu::useProgram(programs.get(meanProgram(settings)));
    gpu::bindUniformBuffer(UNIFORM_PASS, *constants_);
    gpu::bindTexture(TEXTURE_UNIT_RADIANCE, sum()->texture());
    gpu::drawFullscreenTriangle();
    isShown_ = true;
}

} // namespace tessera::viewer
