#include "engine/Rendering.h"

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

} // namespace tessera::engine
