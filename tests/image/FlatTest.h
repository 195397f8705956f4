#pragma once
#include <array>

#include "tests/image/ImageTest.h"

namespace tessera::test {

inline constexpr int kSide = 8; ///< side of an image in pixels, and of its texture in texels

/// A quad that exactly fills the image of an orthographic camera: pixel (x, y) is texel (x, y).
class FlatTest : public ImageTest {
protected:
    static scenes::Scene flatScene(const scenes::Material& material) {
        scenes::Scene scene = quadScene(material);
        makeOrthographic(scene.cameras[0], 1.0);
        return scene;
    }
    /// The quad under one directional light of one lux.
    static scenes::Scene underTheSun(const scenes::Material& material, const glm::dvec3& directionWS) {
        scenes::Scene scene = flatScene(material);
        scene.lights = {sunLight(directionWS)};
        return scene;
    }
    engine::RenderedFrame frame(const scenes::Scene& scene, frame::FrameSettings settings = {}) {
        settings.sizePixels = {kSide, kSide};
        const engine::RenderedFrame forward = frameOf(scene, settings, engine::Technique::Forward);
        const engine::RenderedFrame deferred = frameOf(scene, settings);
        EXPECT_EQ(forward.radiance, deferred.radiance);
        EXPECT_EQ(forward.display, deferred.display);
        return deferred;
    }
    static glm::vec4 pixel(const engine::RenderedFrame& frame, int x, int y) {
        const float* const p = pixelAt(frame.radiance, kSide, x, y);
        return {p[0], p[1], p[2], p[3]};
    }
    glm::vec4 center(const scenes::Scene& scene) { return pixel(frame(scene), kSide / 2, kSide / 2); }
};

/// An image whose texel (x, y) is value(x, y).
template <class Value>
scenes::Image image8(Value value) {
    scenes::Image image;
    image.name = "texels";
    image.width = image.height = kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (const int c : std::array<int, 4>(value(x, y))) image.texels.push_back(std::byte(c));
    return image;
}
inline scenes::Image uniformImage(std::array<int, 4> texel) {
    return image8([=](int, int) { return texel; });
}
/// Texels of four floats, row by row.
inline scenes::Image floatImage(int width, const std::vector<glm::vec4>& texels) {
    scenes::Image image;
    image.name = "floats";
    image.width = width;
    image.height = int(texels.size()) / width;
    image.format = scenes::TexelFormat::Rgba32Float;
    const auto* const bytes = reinterpret_cast<const std::byte*>(texels.data());
    image.texels.assign(bytes, bytes + texels.size() * sizeof(glm::vec4));
    return image;
}
inline scenes::Image floatImage(const glm::vec4& texel) {
    return floatImage(1, {texel});
}
/// An image with a different colour per texel: red encodes the column, green the row.
inline scenes::Image mapImage() {
    return image8([](int x, int y) { return std::array<int, 4>{30 * x, 30 * y, 0, 255}; });
}

inline scenes::TextureUse nearest() {
    scenes::TextureUse use;
    use.image = 0;
    use.sampler.magnification = use.sampler.minification = scenes::Filter::Nearest;
    return use;
}

inline scenes::Scene texturedScene(scenes::Scene scene, scenes::TextureSlot slot, scenes::Image image) {
    scene.images = {std::move(image)};
    scene.materials[0].texture(slot) = nearest();
    return scene;
}

} // namespace tessera::test
