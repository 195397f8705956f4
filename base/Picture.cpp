#include "base/Picture.h"

#include <algorithm>
#include <cmath>

#include "base/Srgb.h"

namespace tessera {

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

} // namespace tessera
