#include "engine/Rendering.h"

#include <cmath>

#include "shaders/shared/tonemap.h"

namespace tessera::engine {

Picture toPicture(const RenderedFrame& frame) {
    Picture picture;
    picture.width = frame.width;
    picture.height = frame.height;
    picture.rgba = frame.radiance;
    picture.covered.resize(picture.pixelCount());
    for (std::size_t i = 0; i < picture.covered.size(); ++i)
        picture.covered[i] = frame.radiance[4 * i + 3] > 0.0f ? 1 : 0;
    return picture;
}

DisplayImage toDisplayImage(const RenderedFrame& frame) {
    DisplayImage image;
    image.width = frame.width;
    image.height = frame.height;
    image.rgb.reserve(image.pixelCount() * 3);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) image.rgb.push_back(frame.display[4 * i + channel]);
    }
    return image;
}

DisplayImage toDisplayImage(const Picture& picture, const frame::FrameSettings& settings) {
    DisplayImage image;
    image.width = picture.width;
    image.height = picture.height;
    image.rgb.reserve(image.pixelCount() * 3);
    const float scale = std::exp2(settings.exposureEV);
    const frame::ToneMap map = frame::showsLitPicture(settings.view) ? settings.toneMap : frame::ToneMap::None;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const glm::vec3 radiance = scale * glm::vec3(picture.pixel(i)[0], picture.pixel(i)[1], picture.pixel(i)[2]);
        const glm::vec3 code = shared::encodeSrgb(shared::toneMapped(radiance, std::uint32_t(map)));
        for (int channel = 0; channel < 3; ++channel)
            image.rgb.push_back(std::uint8_t(std::isnan(code[channel]) ? 0 : std::lround(255.0f * code[channel])));
    }
    return image;
}

} // namespace tessera::engine
