#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/FlatTest.h"

namespace tessera {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;
using scenes::TextureSlot;
using std::numbers::pi;
using namespace test;

/// A dozen fp32 roundings of 2^-24 each, relative.
constexpr double kRounding = 1e-6;

/// Eye and sun both straight above the surface: n = l = v = h, so D = 1/(pi alpha^2), G = 1 and F = F0.
class MaterialValues : public FlatTest {
protected:
    static Scene underTheSun(const Material& material, const glm::dvec3& directionWS = {0, 0, -1}) {
        return FlatTest::underTheSun(material, directionWS);
    }
    void expectColor(const Scene& scene, const glm::dvec3& wanted) {
        const glm::vec4 found = center(scene);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], kRounding * (1.0 + wanted[c])) << c;
    }
};

/// blackDielectric() with the widest lobe: the radiance is F0 / (4 pi).
Material blackMicrofacet() {
    Material material = blackDielectric();
    material.model = MaterialModel::Microfacet;
    material.alpha = 1.0f;
    return material;
}

TEST_F(MaterialValues, aMirrorHasTheLeastAlpha) {
    constexpr double kLeastAlpha = 1e-3; // the shading formulas' own bound
    const double peak = 1.0 / (4.0 * pi * kLeastAlpha * kLeastAlpha);
    Material glossy = blackMicrofacet();
    glossy.alpha = 0.0f;
    expectColor(underTheSun(glossy), glm::dvec3(0.04 * peak));
    Material metal;
    metal.perceptualRoughness = 0.0f;
    metal.baseColor = {1.0f, 0.5f, 0.25f, 1.0f};
    expectColor(underTheSun(metal), glm::dvec3(1.0, 0.5, 0.25) * peak);
}

TEST_F(MaterialValues, theTintedDielectricReflectanceIsHeldToOneAndThenScaled) {
    Material material = blackDielectric();
    material.specularColor = {40.0f, 2.0f, 1.0f};
    material.specularFactor = 0.5f;
    expectColor(underTheSun(material), 0.5 * glm::dvec3(1.0, 0.08, 0.04) / (4.0 * pi));
}

TEST_F(MaterialValues, aDielectricReflectsItsF90TheMoreTheLowerTheSunStands) {
    // Alpha 1: D = 1/pi and, with n.v = 1, V = 1 / (2 (1 + n.l)); F by the cosine between sun and half vector.
    for (const double angle : {0.5, 1.0, 1.4})
        for (const float f90 : {1.0f, 0.5f}) {
            SCOPED_TRACE(testing::Message() << angle << " radians from the normal, F90 " << f90);
            Material material = blackDielectric();
            material.specularFactor = f90; // scales F0 too
            const double nl = std::cos(angle), grazing = std::pow(1.0 - std::cos(0.5 * angle), 5.0);
            const double f = double(f90) * (0.04 + 0.96 * grazing);
            const Scene plain = underTheSun(material, {-std::sin(angle), 0.0, -nl});
            const glm::dvec3 wanted(f * nl / (2.0 * pi * (1.0 + nl)));
            expectColor(plain, wanted);
            // With varying colours, other channels store the surface.
            expectColor(texturedScene(plain, TextureSlot::BaseColor, uniformImage({0, 0, 0, 255})), wanted);
        }
}

TEST_F(MaterialValues, anIorTextureMultipliesTheIorByItsRed) {
    for (Material material : {blackDielectric(), blackMicrofacet()}) {
        SCOPED_TRACE(material.model == MaterialModel::Microfacet ? "microfacet" : "metallic_roughness");
        material.ior = 1.25f;
        const Scene scene =
            texturedScene(underTheSun(material), TextureSlot::Ior, floatImage({1.6f, 1.2f, 1.1f, 0.5f}));
        expectColor(scene, glm::dvec3(1.0 / 9.0 / (4.0 * pi))); // ior 2
    }
}

TEST_F(MaterialValues, aSpecularFactorTextureCountsByItsAlpha) {
    Material material = blackDielectric();
    material.specularFactor = 0.5f;
    const Scene scene =
        texturedScene(underTheSun(material), TextureSlot::SpecularFactor, floatImage({0.9f, 0.8f, 0.7f, 0.25f}));
    expectColor(scene, glm::dvec3(0.04 * 0.125 / (4.0 * pi)));
}

TEST_F(MaterialValues, anUnlitSurfaceThatEmitsShowsBoth) {
    Material material = unlit();
    material.baseColor = {0.5f, 0.25f, 0.125f, 1.0f};
    material.emissive = {0.25f, 0.5f, 1.0f};
    EXPECT_EQ(glm::vec3(center(flatScene(material))), glm::vec3(0.75f, 0.75f, 1.125f));
}

TEST_F(MaterialValues, theNormalViewIsInWorldSpace) {
    const glm::dmat4 turn = glm::rotate(glm::rotate(glm::dmat4(1.0), 0.7, {0, 1, 0}), 0.4, {1, 0, 0});
    Scene scene = flatScene({});
    scene.nodes[0].parentFromNode = turn * scene.nodes[0].parentFromNode;
    scene.cameras[0].worldFromCamera = turn * scene.cameras[0].worldFromCamera;
    const glm::dvec3 facingWS(turn[2]);
    for (const frame::LightingSpace space : {frame::LightingSpace::World, frame::LightingSpace::View}) {
        frame::FrameSettings settings;
        settings.space = space;
        settings.view = frame::DebugView::Normal;
        const glm::vec4 shown = pixel(frame(scene, settings), kSide / 2, kSide / 2);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], facingWS[c], kRounding) << c;
    }
}

TEST_F(MaterialValues, opacityBeyondZeroAndOneIsHeldToThem) {
    Material material = unlit();
    material.alphaMode = scenes::AlphaMode::Blend;
    Scene scene = flatScene(material);
    scene.background = {0.25f, 0.5f, 0.75f};
    const auto blended = [&](float opacity) {
        return glm::vec3(
            center(texturedScene(scene, TextureSlot::BaseColor, floatImage({1.0f, 0.5f, 0.125f, opacity}))));
    };
    EXPECT_EQ(blended(2.0f), glm::vec3(1.0f, 0.5f, 0.125f));
    EXPECT_EQ(blended(-1.0f), scene.background);
}

/// A unit vector, and its texel.
const glm::dvec3 kTilted = glm::normalize(glm::dvec3(0.4, 0.2, 1.0));
scenes::Image tiltedImage() {
    return floatImage(glm::vec4(glm::vec3(kTilted * 0.5 + 0.5), 1.0f));
}
const glm::dvec3 kSlantedWS = glm::normalize(glm::dvec3(-0.3, -0.8, -1.0));

TEST_F(MaterialValues, anObjectSpaceNormalTurnsAndStretchesWithItsNode) {
    Material material = lambert();
    material.normalMapSpace = scenes::NormalMapSpace::Object;
    Scene scene = texturedScene(underTheSun(material, kSlantedWS), TextureSlot::Normal, tiltedImage());
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0, 0, 1));
    const glm::dvec3 stretch(2.0, 1.5, 1.0);
    scene.nodes[0].parentFromNode = glm::scale(turn, stretch);
    const glm::dvec3 normalWS = glm::normalize(glm::dmat3(turn) * (kTilted / stretch));
    expectColor(scene, glm::dvec3(-glm::dot(normalWS, kSlantedWS)));
}

TEST_F(MaterialValues, theNormalScaleScalesBothTiltsAndNeverTheHeight) {
    Material material = lambert();
    material.normalScale = 0.5f;
    const Scene scene = texturedScene(underTheSun(material, kSlantedWS), TextureSlot::Normal, tiltedImage());
    const glm::dvec3 normalWS = glm::normalize(kTilted * glm::dvec3(0.5, 0.5, 1.0));
    expectColor(scene, glm::dvec3(-glm::dot(normalWS, kSlantedWS)));
}

TEST_F(MaterialValues, aLightNearerThanACentimetreShinesAsFromACentimetre) {
    Material material = lambert();
    Scene scene = flatScene(material);
    scene.cameras[0].farMetres = 4.0; // an orthographic depth has steps of its range / 2^24
    const double centerOfPixel = 1.0 / kSide;
    scene.lights = {pointLight({centerOfPixel, -centerOfPixel, 0.005}, 1e-4f)};
    expectColor(scene, glm::dvec3(1.0)); // 1e-4 cd over 1e-4 m^2
    scene.lights[0].falloff = scenes::Falloff::Attenuation;
    scene.lights[0].attenuation = {0.0f, 0.0f, 1.0f};
    expectColor(scene, glm::dvec3(1.0));
}

class DisplayValues : public FlatTest {
protected:
    int code(float grey, const frame::FrameSettings& settings) {
        Material material = unlit();
        material.baseColor = {grey, grey, grey, 1.0f};
        const engine::RenderedFrame shown = frame(flatScene(material), settings);
        EXPECT_EQ(shown.display[0], shown.display[1]);
        EXPECT_EQ(shown.display[3], 255);
        return shown.display[0];
    }
};

int srgbCode(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return int(std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055)));
}

TEST_F(DisplayValues, sRgbCodesAreThePublishedOnes) {
    EXPECT_EQ(code(0.5f, {}), 188);
    EXPECT_EQ(code(0.0f, {}), 0);
    EXPECT_EQ(code(1.0f, {}), 255);
    EXPECT_EQ(code(7.0f, {}), 255);
    for (const float grey : {0.002f, 0.01f, 0.18f, 0.73f}) EXPECT_EQ(code(grey, {}), srgbCode(grey));
}

TEST_F(DisplayValues, exposureIsAPowerOfTwo) {
    frame::FrameSettings settings;
    settings.exposureEV = 1.0f;
    EXPECT_EQ(code(0.25f, settings), 188);
    settings.exposureEV = -2.0f;
    EXPECT_EQ(code(2.0f, settings), 188);
}

TEST_F(DisplayValues, khronosNeutralKeepsColoursBelowItsShoulder) {
    frame::FrameSettings settings;
    settings.toneMap = frame::ToneMap::KhronosNeutral;
    for (const float grey : {0.1f, 0.3f, 0.5f, 0.79f})
        EXPECT_EQ(code(grey, settings), srgbCode(grey - 0.04)) << grey; // less the toe
    EXPECT_EQ(code(0.04f, settings), srgbCode(6.25 * 0.04 * 0.04));
    EXPECT_LT(code(4.0f, settings), 255);
    EXPECT_GT(code(4.0f, settings), code(1.0f, settings));
}

TEST_F(DisplayValues, acesAndAgxRiseFromBlackToWhite) {
    for (const frame::ToneMap toneMap : {frame::ToneMap::Aces, frame::ToneMap::Agx}) {
        frame::FrameSettings settings;
        settings.toneMap = toneMap;
        int last = -1;
        for (const float grey : {0.0f, 0.02f, 0.18f, 0.5f, 1.0f, 4.0f}) {
            const int now = code(grey, settings);
            EXPECT_GT(now, last) << grey;
            last = now;
        }
        EXPECT_LE(code(0.0f, settings), 2);
        EXPECT_GE(code(30.0f, settings), 245);
    }
}

TEST_F(DisplayValues, theNormalViewIsHalfTheNormalPlusAHalf) {
    frame::FrameSettings settings;
    settings.view = frame::DebugView::Normal;
    Material material;
    material.doubleSided = true;
    Scene scene = flatScene(material);
    for (const double turn : {0.0, 0.6, -0.9}) {
        scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0, 1, 0));
        const engine::RenderedFrame shown = frame(scene, settings);
        const std::size_t middle = 4 * std::size_t(kSide / 2 * kSide + kSide / 2);
        const glm::dvec3 normalWS(std::sin(turn), 0.0, std::cos(turn));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(shown.radiance[middle + std::size_t(c)], normalWS[c], 1e-6);
            EXPECT_NEAR(shown.display[middle + std::size_t(c)], 255.0 * (normalWS[c] * 0.5 + 0.5), 0.51); // rounding
        }
    }
}

} // namespace
} // namespace tessera
