#pragma once
#include <functional>

#include "scenes/builtin/Pictures.h"

namespace tessera::test {

/// A grey environment map from the radiance of each texel.
inline scenes::Image greyMap(int width, int height, const std::function<double(int, int)>& radiance) {
    return scenes::builtin::drawRadiance("grey", width, height,
                                         [&](int x, int y) { return glm::dvec3(radiance(x, y)); });
}

} // namespace tessera::test
