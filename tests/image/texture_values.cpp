#include <functional>
#include <numbers>

#include "tests/image/FlatTest.h"

namespace tessera {
namespace {

using namespace test;
using scenes::Material;
using scenes::Scene;
using scenes::TextureSlot;

class TextureValues : public FlatTest {};

/// Implementations may approximate the decoding of 8-bit sRGB; Mesa's llvmpipe uses a polynomial that is off by up to
/// 1.2e-3. Without decoding, a texel of 128 would be off by 0.29.
constexpr double kDecoding = 1.5e-3;

/// IEC 61966-2-1.
double linearFromSrgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

TEST_F(TextureValues, baseColourTexelsAreSrgbAndRoughnessTexelsLinear) {
    Scene colored = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, uniformImage({128, 64, 255, 255}));
    const glm::vec4 color = center(colored);
    EXPECT_NEAR(color.r, 0.2158605, kDecoding);
    EXPECT_NEAR(color.g, linearFromSrgb(64.0 / 255.0), kDecoding);
    EXPECT_EQ(color.b, 1.0f);

    Material glossy;
    glossy.metallic = 1.0f;
    glossy.perceptualRoughness = 128.0f / 255.0f;
    Scene factor = flatScene(glossy);
    factor.lights = {pointLight({0.3, 0.2, 1.0}, 3.0f)};
    Scene texel = texturedScene(factor, TextureSlot::MetallicRoughness, uniformImage({0, 128, 255, 255}));
    texel.materials[0].perceptualRoughness = 1.0f;
    const glm::vec4 wanted = center(factor), found = center(texel);
    EXPECT_GT(wanted.r, 0.01f);
    EXPECT_NEAR(found.r, wanted.r, 1e-6f * wanted.r); // 0.50196 either way, to a rounding
}

TEST_F(TextureValues, sixteenBitAndFloatTexelsAreReadInFull) {
    scenes::Image image;
    image.width = image.height = 1;
    image.format = scenes::TexelFormat::Rgba16Unorm;
    const std::array<std::uint16_t, 4> words = {1000, 30001, 65535, 65535};
    image.texels.assign(reinterpret_cast<const std::byte*>(words.data()),
                        reinterpret_cast<const std::byte*>(words.data() + 4));
    const glm::vec4 sixteen = center(texturedScene(flatScene(unlit()), TextureSlot::BaseColor, image));
    for (int c = 0; c < 3; ++c) {
        const double wanted = linearFromSrgb(words[std::size_t(c)] / 65535.0);
        EXPECT_NEAR(sixteen[c], wanted, 1e-3 * wanted) << c; // eight bits would be off by 1 % in red
    }
    image.format = scenes::TexelFormat::Rgba32Float;
    const std::array<float, 4> floats = {0.123456f, 7.5f, 1e-4f, 1.0f};
    image.texels.assign(reinterpret_cast<const std::byte*>(floats.data()),
                        reinterpret_cast<const std::byte*>(floats.data() + 4));
    // Float textures are linear: no transfer function in any slot.
    const glm::vec4 found = center(texturedScene(flatScene(unlit()), TextureSlot::BaseColor, image));
    for (int c = 0; c < 3; ++c) EXPECT_EQ(found[c], floats[std::size_t(c)]) << c;
}

struct Place {
    int x, y;
};

/// Expects pixel (x, y) to show texel texelOf(x, y).
void expectTexels(const engine::RenderedFrame& frame, const std::function<Place(int, int)>& texelOf) {
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Place texel = texelOf(x, y);
            const float* p = &frame.radiance[std::size_t(4 * (y * kSide + x))];
            EXPECT_NEAR(p[0], linearFromSrgb(30.0 * texel.x / 255.0), kDecoding) << "column at " << x << "," << y;
            EXPECT_NEAR(p[1], linearFromSrgb(30.0 * texel.y / 255.0), kDecoding) << "row at " << x << "," << y;
        }
}

class Transforms : public FlatTest {
protected:
    engine::RenderedFrame moved(scenes::TextureTransform transform, scenes::Wrap wrap = scenes::Wrap::Repeat) {
        Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, mapImage());
        scenes::TextureUse& use = scene.materials[0].texture(TextureSlot::BaseColor);
        use.transform = transform;
        use.sampler.wrapU = use.sampler.wrapV = wrap;
        return frame(scene);
    }
};

TEST_F(Transforms, anUntransformedPictureIsShownTexelForPixel) {
    expectTexels(moved({}), [](int x, int y) { return Place{x, y}; });
}

TEST_F(Transforms, anOffsetMovesThePictureAgainstIt) {
    expectTexels(moved({{0.25f, 0.5f}, {1, 1}, 0}), [](int x, int y) { return Place{(x + 2) % 8, (y + 4) % 8}; });
}

TEST_F(Transforms, aScaleRepeatsThePictureThatOften) {
    // The texel coordinate 2x + 1/2 of pixel x's centre lies on an edge; a shift of a quarter moves it inside.
    expectTexels(moved({{0.03125f, 0.03125f}, {2, 2}, 0}), [](int x, int y) {
        return Place{(2 * x + 1) % 8, (2 * y + 1) % 8};
    });
}

TEST_F(Transforms, aQuarterTurnTurnsThePictureClockwise) {
    // KHR_texture_transform: coordinates turn counter-clockwise about the top-left corner, the image clockwise; the
    // offset brings it back. The image's top-left texel ends up at the top right.
    const float quarter = float(std::numbers::pi / 2.0);
    expectTexels(moved({{0.0f, 1.0f}, {1, 1}, quarter}), [](int x, int y) { return Place{y, 7 - x}; });
}

TEST_F(Transforms, wrapModesContinueThePictureTheirWay) {
    // Two image widths side by side, shifted so that a whole period shows on both sides of the edge.
    const scenes::TextureTransform wide{{-0.46875f, -0.46875f}, {2, 2}, 0};
    const auto column = [](int x) { return 2 * x + 1 - 4; }; // texel column of pixel x, before wrapping
    expectTexels(moved(wide, scenes::Wrap::Repeat), [&](int x, int y) {
        return Place{(column(x) + 8) % 8, (column(y) + 8) % 8};
    });
    expectTexels(moved(wide, scenes::Wrap::ClampToEdge), [&](int x, int y) {
        return Place{std::clamp(column(x), 0, 7), std::clamp(column(y), 0, 7)};
    });
    const auto mirrored = [](int texel) { return texel < 0 ? -1 - texel : texel > 7 ? 15 - texel : texel; };
    expectTexels(moved(wide, scenes::Wrap::MirroredRepeat), [&](int x, int y) {
        return Place{mirrored(column(x)), mirrored(column(y))};
    });
}

TEST_F(TextureValues, linearMagnificationBlendsAndNearestNeverDoes) {
    Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, image8([](int x, int) {
                                    return std::array<int, 4>{x < 4 ? 0 : 255, 0, 0, 255};
                                }));
    scenes::TextureUse& use = scene.materials[0].texture(TextureSlot::BaseColor);
    use.transform = {{0.25f, 0.0f}, {0.5f, 1.0f}, 0.0f}; // two pixels per texel
    const auto shades = [&] {
        const engine::RenderedFrame shown = frame(scene);
        return std::ranges::count_if(shown.radiance, [](float v) { return v > 0.01f && v < 0.99f; });
    };
    EXPECT_EQ(shades(), 0);
    use.sampler.magnification = scenes::Filter::Linear;
    EXPECT_EQ(shades(), 2 * kSide); // the two columns beside the step
}

TEST_F(TextureValues, secondUvSetAndVertexColoursCountExactly) {
    Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, mapImage());
    scene.materials[0].texture(TextureSlot::BaseColor).texCoordSet = 1;
    scene.meshes[0].texCoords[1] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}}; // the first set, mirrored in u
    expectTexels(frame(scene), [](int x, int y) { return Place{7 - x, y}; });

    Scene colored = flatScene(unlit());
    colored.materials[0].baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
    colored.meshes[0].colors.assign(4, {0.25f, 0.5f, 1.0f, 1.0f});
    EXPECT_NEAR(glm::distance(center(colored), glm::vec4(0.125f, 0.25f, 0.5f, 1.0f)), 0.0f,
                1e-6f); // interpolation rounds
}

class ExactFilter : public FlatTest {
protected:
    static constexpr int kWidth = 8, kHeight = 4; ///< texels

    /// Every texel's colour is its own position.
    static scenes::Image placeImage() {
        std::vector<glm::vec4> texels;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) texels.emplace_back(float(x), float(y), 0.0f, 1.0f);
        scenes::Image image;
        image.name = "places";
        image.width = kWidth;
        image.height = kHeight;
        image.format = scenes::TexelFormat::Rgba32Float;
        const auto* bytes = reinterpret_cast<const std::byte*>(texels.data());
        image.texels.assign(bytes, bytes + texels.size() * sizeof(glm::vec4));
        return image;
    }

    /// OpenGL 4.5 core, section 8.14.2, "Coordinate Wrapping and Texel Selection".
    static int wrapped(int index, int size, scenes::Wrap wrap) {
        const auto modulo = [](int i, int n) { return i - n * int(std::floor(double(i) / n)); };
        if (wrap == scenes::Wrap::ClampToEdge) return std::clamp(index, 0, size - 1);
        if (wrap == scenes::Wrap::Repeat) return modulo(index, size);
        const int beyond = modulo(index, 2 * size) - size;
        return size - 1 - (beyond >= 0 ? beyond : -(1 + beyond));
    }

    /// The wrapped index, interpolated between texel centres, which lie at integers.
    static double blended(double place, int size, scenes::Wrap wrap) {
        const int first = int(std::floor(place));
        const double weight = place - first;
        return (1.0 - weight) * wrapped(first, size, wrap) + weight * wrapped(first + 1, size, wrap);
    }
};

TEST_F(ExactFilter, everyPairOfWrapModesFindsAndBlendsItsOwnTexels) {
    frame::FrameSettings settings;
    settings.filter = frame::TextureFilter::Exact;
    Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, placeImage());
    scenes::TextureUse& use = scene.materials[0].texture(TextureSlot::BaseColor);
    use.sampler.magnification = use.sampler.minification = scenes::Filter::Linear;
    // Pixel (x, y) reads the place (5x, 3y) + start: more than a period before the image and after it, each way.
    const glm::dvec2 step(5.0, 3.0), size(kWidth, kHeight);
    constexpr scenes::Wrap kModes[] = {scenes::Wrap::Repeat, scenes::Wrap::ClampToEdge, scenes::Wrap::MirroredRepeat};
    for (const glm::dvec2 start : {glm::dvec2(-17.0, -11.0), glm::dvec2(-17.25, -11.625)}) {
        use.transform.scale = double(kSide) * step / size;
        use.transform.offset = (start + 0.5 - 0.5 * step) / size;
        for (const scenes::Wrap wrapU : kModes)
            for (const scenes::Wrap wrapV : kModes) {
                SCOPED_TRACE(testing::Message() << "u " << int(wrapU) << ", v " << int(wrapV) << ", start " << start.x);
                use.sampler.wrapU = wrapU;
                use.sampler.wrapV = wrapV;
                const engine::RenderedFrame shown = frame(scene, settings);
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x) {
                        const glm::dvec2 place = step * glm::dvec2(x, y) + start;
                        const glm::vec4 found = pixel(shown, x, y);
                        // Coordinates of up to 4 are rounded to 2^-22; times 8 texels, whose neighbours differ by up
                        // to 7.
                        constexpr double kRounding = 2e-5;
                        EXPECT_NEAR(found.r, blended(place.x, kWidth, wrapU), kRounding) << "column " << x;
                        EXPECT_NEAR(found.g, blended(place.y, kHeight, wrapV), kRounding) << "row " << y;
                    }
            }
    }
}

TEST_F(ExactFilter, theSecondSetOfCoordinatesAlsoSaysWhetherTexelsAreTakenSingly) {
    frame::FrameSettings settings;
    settings.filter = frame::TextureFilter::Exact;
    Scene scene = texturedScene(flatScene(unlit()), TextureSlot::BaseColor, placeImage());
    scene.meshes[0].texCoords[1] = scene.meshes[0].texCoords[0];
    scenes::TextureUse& use = scene.materials[0].texture(TextureSlot::BaseColor);
    use.texCoordSet = 1;
    use.sampler.magnification = scenes::Filter::Linear;
    use.sampler.minification = scenes::Filter::Nearest;
    // As above; a pixel steps over 5 and 3 texels, so the texture is minified.
    const glm::dvec2 step(5.0, 3.0), size(kWidth, kHeight), start(-17.25, -11.625);
    use.transform.scale = double(kSide) * step / size;
    use.transform.offset = (start + 0.5 - 0.5 * step) / size;
    const engine::RenderedFrame shown = frame(scene, settings);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec2 texel = glm::floor(step * glm::dvec2(x, y) + start + 0.5);
            const glm::vec4 found = pixel(shown, x, y);
            EXPECT_EQ(found.r, float(wrapped(int(texel.x), kWidth, use.sampler.wrapU))) << "column " << x;
            EXPECT_EQ(found.g, float(wrapped(int(texel.y), kHeight, use.sampler.wrapV))) << "row " << y;
        }
}

} // namespace
} // namespace tessera
