// Thin sheets that transmit light: known answers.

#include "tests/image/FlatTest.h"
#include "tests/image/GlassTest.h"
#include "tests/image/Textbook.h"
#include "validation/reference/Lobes.h"

namespace tessera {
namespace {

using scenes::Material;
using scenes::Scene;
using namespace test;

/// Error of the fit of a sheen's albedo, 0 to 1 (tests/gpu/shaders/layers.cpp).
constexpr double kSheenFit = 0.035;

class GlassSheets : public FlatTest {
protected:
    void expectShown(const Scene& scene, const glm::dvec3& wanted, float coverage = 1.0f) {
        const glm::vec4 shown = center(scene);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], wanted[c], kGlassRounding * std::max(wanted[c], 1e-3)) << c;
        EXPECT_EQ(shown.a, coverage);
    }
};

TEST_F(GlassSheets, showWhatLiesBehindByChannel) {
    Material sheet = clearGlass();
    sheet.baseColor = {0.5f, 0.8f, 0.2f, 0.25f}; // this opacity is unused
    sheet.transmission = 0.7f;
    sheet.metallic = 0.25f;
    Scene scene = flatScene(sheet);
    scene.background = {0.25f, 0.5f, 0.75f};
    glm::dvec3 wanted;
    for (int c = 0; c < 3; ++c) {
        const double color = double(sheet.baseColor[c]), straight = std::lerp(0.04, color, 0.25);
        wanted[c] = double(0.7f) * 0.75 * color * (1.0 - straight) * double(scene.background[c]);
    }
    expectShown(scene, wanted);
    // With blending, opacity covers: the rest of the background stays as it is.
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    expectShown(scene, 0.25 * wanted + 0.75 * glm::dvec3(scene.background), 0.25f);
    // A body without anything to refract absorbs too.
    scene.materials[0].alphaMode = scenes::AlphaMode::Opaque;
    scene.materials[0].thicknessMetres = 0.5f;
    scene.materials[0].attenuationDistanceMetres = 0.25f;
    scene.materials[0].attenuationColor = {0.5f, 1.0f, 0.0f};
    expectShown(scene, wanted * glm::dvec3(0.25, 1.0, 0.0));
}

TEST_F(GlassSheets, almostEdgeOnPassWhatFresnelsFactorLeaves) {
    Scene scene = flatScene(clearGlass());
    scene.background = glm::vec3(1.0f);
    for (const double cosine : {0.2, 0.006}) {
        lookAtCosine(scene.cameras[0], cosine, 1e-4);
        const double wanted = 0.96 * (1.0 - std::pow(1.0 - cosine, 5.0));
        EXPECT_NEAR(double(center(scene).x), wanted, 2e-6) << "cosine " << cosine;
    }
}

/// R scales transmission, G thickness; a texel of 0 gives a body without absorption.
TEST_F(GlassSheets, areScaledByTheirTextures) {
    using scenes::TextureSlot;
    Material sheet = clearGlass();
    sheet.transmission = 0.8f;
    sheet.thicknessMetres = 0.5f;
    sheet.attenuationDistanceMetres = 0.25f;
    sheet.attenuationColor = {0.5f, 0.8f, 0.0f};
    const auto scaled = [&](float transmission, float thickness) {
        Scene scene = flatScene(sheet);
        scene.background = {0.25f, 0.5f, 0.75f};
        scene.images = {floatImage({transmission, 0.7f, 0.3f, 0.1f}), floatImage({0.7f, thickness, 0.3f, 0.1f})};
        scene.materials[0].texture(TextureSlot::Transmission).image = 0;
        scene.materials[0].texture(TextureSlot::Thickness).image = 1;
        return scene;
    };
    Scene plain = flatScene(sheet);
    plain.background = {0.25f, 0.5f, 0.75f};
    EXPECT_EQ(center(scaled(1.0f, 1.0f)), center(plain)) << "white changes no bit";
    for (const float thickness : {0.0f, 0.25f, 0.5f}) {
        const Scene scene = scaled(0.5f, thickness);
        const glm::vec4 shown = center(scene);
        for (int c = 0; c < 3; ++c) {
            const double left = std::pow(double(sheet.attenuationColor[c]), 2.0 * double(thickness));
            const double expected = 0.96 * double(sheet.transmission) * 0.5 * left * double(scene.background[c]);
            EXPECT_NEAR(shown[c], expected, 1e-3 * expected + 1e-6) << thickness << ", " << c;
        }
    }
    // At full thickness the transmitted light underflows single precision; thinner glass shows a colour.
    sheet.attenuationDistanceMetres = 1.0f / 1024.0f; // 512 times
    for (const float thickness : {1.0f, 1.0f / 128.0f, 1.0f / 512.0f}) {
        const Scene scene = scaled(1.0f, thickness);
        const glm::vec4 shown = center(scene);
        for (int c = 0; c < 3; ++c) {
            const double left = std::pow(double(sheet.attenuationColor[c]), 512.0 * double(thickness));
            const double expected = 0.96 * double(sheet.transmission) * left * double(scene.background[c]);
            EXPECT_NEAR(shown[c], expected, 1e-3 * expected + 1e-6) << "strong, " << thickness << ", " << c;
        }
    }
}

TEST_F(GlassSheets, behindEachOtherMultiply) {
    Material sheet = clearGlass();
    sheet.baseColor = {0.5f, 0.8f, 0.2f, 1.0f};
    Scene scene = flatScene(sheet);
    scene.background = {0.25f, 0.5f, 0.75f};
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().parentFromNode[3].z = -0.5;
    expectShown(scene,
                glm::dvec3(scene.background) * glm::dvec3(sheet.baseColor) * glm::dvec3(sheet.baseColor) * 0.96 * 0.96);
}

/// Only the highlight reflects light: that of a black body with the same reflectance.
TEST_F(GlassSheets, reflectLightsAsTheirHighlightDoes) {
    const auto lit = [](const Material& material) {
        Scene scene = underTheSun(material, glm::normalize(glm::dvec3(-0.1, -0.15, -1.0)));
        scene.background = glm::vec3(0.0f);
        return scene;
    };
    const Material black = blackDielectric(0.4);
    const glm::vec4 highlight = center(lit(black));
    EXPECT_GT(highlight.g, 0.01f);
    Material sheet = black;
    sheet.baseColor = glm::vec4(1.0f);
    sheet.transmission = 1.0f;
    expectShown(lit(sheet), glm::dvec3(highlight));
    sheet.transmission = 0.25f; // three quarters of a matte body remain
    Material matte = sheet;
    matte.transmission = 0.0f;
    const glm::vec4 whole = center(lit(matte));
    expectShown(lit(sheet), glm::mix(glm::dvec3(highlight), glm::dvec3(whole), 0.75));
}

/// Under uniform light a black sheet reflects its sheen alone, and transmits the rest. The truth is the integral of the
/// sheen's lobe; the renderer uses a fit of it.
TEST_F(GlassSheets, underASheenPassWhatItsLobeDoesNotReflect) {
    double most = 0.0;
    for (const double roughness : {0.3, 0.5, 1.0})
        for (const double tiltRadians : {0.0, 0.8, 1.2}) {
            Material sheet = bareGlass(1.5);
            sheet.thicknessMetres = 0.0f;
            sheet.sheenColor = {0.3f, 0.8f, 0.5f};
            sheet.sheenPerceptualRoughness = float(roughness);
            Scene scene = flatScene(sheet);
            glm::dmat4& placed = scene.nodes[0].parentFromNode;
            const double cosView = std::cos(tiltRadians), sine = std::sin(tiltRadians);
            placed[0] = 4.0 * glm::dvec4(cosView, 0.0, -sine, 0.0);
            placed[2] = {sine, 0.0, cosView, 0.0};
            scene.background = {0.25f, 0.5f, 0.75f};
            const double alpha = roughness * roughness;
            constexpr int kSteps = 200;
            double albedo = 0.0; // of a white sheen
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const double cosLight = (i + 0.5) / kSteps, turn = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
                    const double level = std::sqrt(1.0 - cosLight * cosLight);
                    const glm::dvec3 toLight(level * std::cos(turn), level * std::sin(turn), cosLight);
                    const glm::dvec3 half = glm::normalize(toLight + glm::dvec3(sine, 0.0, cosView));
                    albedo += reference::distributionCharlie(alpha, half.z) *
                              reference::visibilityCharlie(alpha, cosLight, cosView) * cosLight;
                }
            albedo *= 2.0 * std::numbers::pi / (kSteps * kSteps);
            const glm::vec4 shown = center(scene);
            // KHR_materials_sheen: below the sheen all channels lose the reflection of its strongest one.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(shown[c] / scene.background[c], 1.0 - double(0.8f) * albedo, kSheenFit)
                    << roughness << ", " << tiltRadians << ", " << c;
            most = std::max(most, albedo);
        }
    EXPECT_GT(most, 10.0 * kSheenFit);
}

} // namespace
} // namespace tessera
