#include "validation/Rendering.h"

#include <algorithm>
#include <cmath>

#include "validation/Srgb.h"

namespace tessera::validation {

Picture toPicture(const recipes::RenderedFrame& frame) {
    Picture picture;
    picture.width = frame.width;
    picture.height = frame.height;
    picture.rgba = frame.radiance;
    picture.covered.resize(picture.pixelCount());
    for (std::size_t i = 0; i < picture.covered.size(); ++i)
        picture.covered[i] = frame.radiance[4 * i + 3] > 0.0f ? 1 : 0;
    return picture;
}

DisplayImage toDisplayImage(const recipes::RenderedFrame& frame) {
    DisplayImage image;
    image.width = frame.width;
    image.height = frame.height;
    image.rgb.reserve(image.pixelCount() * 3);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) image.rgb.push_back(frame.display[4 * i + channel]);
    }
    return image;
}

DisplayImage toDisplayImage(const Picture& picture) {
    DisplayImage image;
    image.width = picture.width;
    image.height = picture.height;
    image.rgb.reserve(image.pixelCount() * 3);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double value = picture.pixel(i)[channel];
            // The order of the operands makes NaN black.
            const double shown = srgbFromLinear(std::min(1.0, std::max(0.0, value)));
            image.rgb.push_back(std::uint8_t(std::lround(255.0 * shown)));
        }
    }
    return image;
}

} // namespace tessera::validation
