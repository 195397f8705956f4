#pragma once
#include <cstring>

#include "scenes/LightTexture.h"

namespace tessera::test {

/// A light texture with the value `factor(x, y)` per texel, from the top left.
template <typename Factor>
scenes::LightTexture lightTexture(int width, int height, Factor factor) {
    scenes::LightPicture picture;
    picture.source = "/none/of_a_test.pfm";
    picture.map = {"of_a_test.pfm", scenes::TexelFormat::Rgba32Float, width, height, {}};
    picture.map.texels.resize(std::size_t(width) * std::size_t(height) * sizeof(glm::vec4));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec4 texel(glm::vec3(factor(x, y)), 1.0f);
            std::memcpy(picture.map.texels.data() + std::size_t(y * width + x) * sizeof texel, &texel, sizeof texel);
        }
    return scenes::LightTexture(std::move(picture));
}

inline scenes::LightTexture evenLightTexture(const glm::vec3& factor, int side = 4) {
    return lightTexture(side, side, [&](int, int) { return factor; });
}

} // namespace tessera::test
