#include "viewer/show/DrawnPicture.h"

#include "renderer/gpu/Commands.h"

namespace tessera::viewer {
namespace {

void copyInto(std::unique_ptr<Target>& target, const char* label, const gpu::Texture& source) {
    const glm::ivec2 size(source.desc().width, source.desc().height);
    if (!target || target->sizePixels() != size) target = std::make_unique<Target>(label, source.desc().format, size);
    target->copyFrom(source);
}

} // namespace

Target::Target(const char* label, graph::Format format, glm::ivec2 sizePixels)
    : texture_(label, graph::TextureDesc{format, sizePixels.x, sizePixels.y, 1}),
      framebuffer_(gpu::Attachments{{&texture_}}) {}

void Target::copyFrom(const gpu::Texture& source) {
    gpu::blit(gpu::Framebuffer(gpu::Attachments{{&source}}), framebuffer_, true, false);
}

void DrawnPicture::take(const engine::Renderer& renderer, const Look& look, Kept kept) {
    look_ = look;
    copyInto(display_, "shown display", renderer.displayTexture());
    countScaleLog2_ = float(frame::countScaleLog2(look.settings.view));
    hasRadiance_ = kept.radiance;
    lights_.reset();
    if (kept.lights && PictureLights::areCounted(look)) lights_.emplace(renderer);
    if (kept.radiance) copyInto(radiance_, "shown radiance", renderer.radianceTexture());
}

void DrawnPicture::clear() {
    display_.reset();
    radiance_.reset();
    hasRadiance_ = false;
    lights_.reset();
}

} // namespace tessera::viewer
