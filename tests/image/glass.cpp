// Light that passes through surfaces: against closed forms, between techniques, and against the reference.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/image/FlatTest.h"
#include "tests/image/GlassTest.h"
#include "tests/image/Textbook.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using scenes::Material;
using scenes::Scene;
using namespace test;

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
    sheet.baseColor = {0.5f, 0.8f, 0.2f, 0.25f}; // an opacity that nothing asks for
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
    // Opacity covers where it blends: the rest of what lies behind stays as it is.
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    expectShown(scene, 0.25 * wanted + 0.75 * glm::dvec3(scene.background), 0.25f);
    // A body that nothing bends light into absorbs all the same.
    scene.materials[0].alphaMode = scenes::AlphaMode::Opaque;
    scene.materials[0].thicknessMetres = 0.5f;
    scene.materials[0].attenuationDistanceMetres = 0.25f;
    scene.materials[0].attenuationColor = {0.5f, 1.0f, 0.0f};
    expectShown(scene, wanted * glm::dvec3(0.25, 1.0, 0.0));
}

/// Transmission by R, thickness by G; a texel of 0 leaves a body that absorbs nothing.
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
    // As thick as the material says it leaves less than single precision holds, and where it is thinner a colour.
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

/// All that is left of light is the highlight: that of a black body with the same reflectance.
TEST_F(GlassSheets, reflectLightsAsTheirHighlightDoes) {
    const auto lit = [](const Material& material) {
        Scene scene = underTheSun(material, glm::normalize(glm::dvec3(-0.1, -0.15, -1.0)));
        scene.background = glm::vec3(0.0f);
        return scene;
    };
    Material black = clearGlass();
    black.perceptualRoughness = 0.4f;
    black.transmission = 0.0f;
    black.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
    const glm::vec4 highlight = center(lit(black));
    EXPECT_GT(highlight.g, 0.01f);
    Material sheet = black;
    sheet.baseColor = glm::vec4(1.0f);
    sheet.transmission = 1.0f;
    expectShown(lit(sheet), glm::dvec3(highlight));
    sheet.transmission = 0.25f; // of a matte body three quarters stay
    Material matte = sheet;
    matte.transmission = 0.0f;
    const glm::vec4 whole = center(lit(matte));
    expectShown(lit(sheet), glm::mix(glm::dvec3(highlight), glm::dvec3(whole), 0.75));
}

class Glass : public GlassTest {
protected:
    /// For rough bodies of several indices, in pictures of half the side unless the sweep is a whole one.
    void expectRoughAsTheReference();
    /// Of a scene of everything, by itself and under a sky, or of a few surfaces, with every technique in either, and
    /// of everything with one.
    void expectAllTechniquesAlike();
};
using GlassSlow = Glass;

/// Whatever it lets through and reflects is the same light.
TEST_F(Glass, clearInEvenLightShowsExactlyThatLight) {
    constexpr int kFurnacePixels = 48;
    for (const float thickness : {0.0f, 0.1f})
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            Material glass = clearGlass();
            glass.thicknessMetres = thickness;
            glass.clearcoat = 0.5f;
            Scene scene = ballUnderSky(glass);
            scene.environment = evenEnvironment(1.0);
            const std::vector<float> shown = drawn(scene, ofSide(kFurnacePixels, light));
            for (int y = 0; y < kFurnacePixels; ++y)
                for (int x = 0; x < kFurnacePixels; ++x) {
                    const glm::dvec2 at =
                        1.02 * (glm::dvec2(2.0 * x + 1.0, 2.0 * y + 1.0) / double(kFurnacePixels) - 1.0);
                    // At its rim interpolated normals turn away from the viewer.
                    if (std::abs(glm::length(at) - 1.0) < 0.03) continue;
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(shown[std::size_t(4 * (y * kFurnacePixels + x) + c)], 1.0f, 1e-3f)
                            << thickness << ", " << infoOf(light).name << " at " << x << ", " << y;
                }
        }
}

/// What a mirror reflects and what passes add up to 1 at any angle. The ball above is seen up to a cosine of 0.24.
TEST_F(Glass, clearInEvenLightShowsThatLightAtGrazingAnglesToo) {
    constexpr double kSteepRadians = 1.0, kLeastCosine = 0.05;
    for (const float thickness : {0.0f, 0.1f})
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            Material glass = clearGlass();
            glass.thicknessMetres = thickness;
            Scene scene = bentPlane(glass, kSteepRadians);
            scene.environment = evenEnvironment(1.0);
            const std::vector<float> shown = drawn(scene, ofSide(kBentPixels, light));
            int judged = 0, grazing = 0;
            for (int y = 0; y < kBentPixels; ++y)
                for (int x = 0; x < kBentPixels; ++x) {
                    const double cosView = glm::dot(bentNormal(kSteepRadians), toViewerOfBent(x, y));
                    if (cosView < kLeastCosine) continue;
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(shown[std::size_t(4 * (y * kBentPixels + x) + c)], 1.0f, 1e-3f)
                            << thickness << ", " << infoOf(light).name << ", cosine " << cosView;
                    ++judged;
                    grazing += cosView < 0.15 ? 1 : 0;
                }
            EXPECT_GT(judged, kBentPixels * kBentPixels / 2);
            EXPECT_GT(grazing, 2 * kBentPixels);
        }
}

/// What a GGX lobe with height-correlated masking and Schlick's factor reflects of even light. Half vectors are drawn
/// by their distribution, whose share below a slope s is s^2 / (s^2 + alpha^2).
double reflectedOfEvenLight(double alpha, double cosView, double straight) {
    constexpr int kSteps = 96;
    const glm::dvec3 toViewer(std::sqrt(1.0 - cosView * cosView), 0.0, cosView);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double below = (i + 0.5) / kSteps, turn = std::numbers::pi * (j + 0.5) / kSteps;
            const double lean = std::atan(alpha * std::sqrt(below / (1.0 - below)));
            const glm::dvec3 half(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
            const double incidence = glm::dot(half, toViewer), cosLight = 2.0 * incidence * half.z - cosView;
            if (incidence <= 0.0 || cosLight <= 0.0) continue;
            const double fresnel = straight + (1.0 - straight) * std::pow(1.0 - incidence, 5.0);
            // F D G / (4 l v) l over the density D h / (4 (h.v)).
            sum += fresnel * textbook::correlatedMasking(alpha, cosLight, cosView) * incidence / (cosView * half.z);
        }
    return sum / (kSteps * kSteps);
}

/// What a lobe reflects and what passes add up to 1 at any angle, up to the noise of samples, which alone see the lobe
/// itself.
TEST_F(Glass, roughInEvenLightShowsThatLightAtAnyAngle) {
    constexpr double kSteepRadians = 1.0, kLeastCosine = 0.05;
    for (const auto& [light, leeway] :
         {std::pair(EnvironmentLight::SplitSum, 1e-3f), {EnvironmentLight::Sampled, 8e-3f}})
        for (const float thickness : {0.0f, 0.1f}) {
            Material glass = clearGlass();
            glass.thicknessMetres = thickness;
            glass.perceptualRoughness = 0.3f;
            Scene scene = bentPlane(glass, kSteepRadians);
            scene.environment = evenEnvironment(1.0);
            engine::Renderer renderer(context(), scene);
            frame::FrameSettings settings = ofSide(kBentPixels, light);
            settings.environment.samples = 256;
            for (const float roughness : {0.05f, 0.3f, 0.5f, 1.0f}) {
                scene.materials[0].perceptualRoughness = roughness;
                renderer.materialsChanged();
                const std::vector<float> shown = renderer.render(Technique::Deferred, settings).radiance;
                int grazing = 0;
                for (int y = 0; y < kBentPixels; ++y)
                    for (int x = 0; x < kBentPixels; ++x) {
                        const double cosView = glm::dot(bentNormal(kSteepRadians), toViewerOfBent(x, y));
                        if (cosView < kLeastCosine) continue;
                        ASSERT_NEAR(shown[std::size_t(4 * (y * kBentPixels + x))], 1.0f, leeway)
                            << thickness << ", " << infoOf(light).name << ", " << roughness << ", cosine " << cosView;
                        grazing += cosView < 0.15 ? 1 : 0;
                    }
                EXPECT_GT(grazing, 2 * kBentPixels);
            }
        }
}

/// Seen alone, where nothing lights the surface: what passes is all but the integral of the lobe.
TEST_F(Glass, roughPassesWhatItsLobeDoesNotReflect) {
    constexpr double kSteepRadians = 1.0, kLeastCosine = 0.1, kStraight = 0.04;
    Scene scene = bentPlane(clearGlass(), kSteepRadians);
    scene.environment.reset();
    scene.background = glm::vec3(1.0f);
    engine::Renderer renderer(context(), scene);
    for (const double roughness : {0.2, 0.3, 0.5, 1.0}) {
        scene.materials[0].perceptualRoughness = float(roughness);
        renderer.materialsChanged();
        const std::vector<float> shown = renderer.render(Technique::Deferred, ofSide(kBentPixels)).radiance;
        double unlikeMirror = 0.0;
        for (int y = 0; y < kBentPixels; y += 3)
            for (int x = 0; x < kBentPixels; x += 3) {
                const double cosView = glm::dot(bentNormal(kSteepRadians), toViewerOfBent(x, y));
                if (cosView < kLeastCosine) continue;
                const double wanted = 1.0 - reflectedOfEvenLight(roughness * roughness, cosView, kStraight);
                // The table's error between its places is 2e-4, the integral's 1e-4.
                ASSERT_NEAR(shown[std::size_t(4 * (y * kBentPixels + x))], wanted, 4e-4)
                    << roughness << ", cosine " << cosView;
                const double mirrored = kStraight + (1.0 - kStraight) * std::pow(1.0 - cosView, 5.0);
                unlikeMirror = std::max(unlikeMirror, std::abs(wanted - (1.0 - mirrored)));
            }
        EXPECT_GT(unlikeMirror, 0.1) << roughness << ": grazing angles are among them";
    }
}

/// Roughness beside it takes other code, and a mirror the same bits.
TEST_F(Glass, roughGlassElsewhereInASceneChangesNoBitOfSmoothGlass) {
    Scene scene = bentPlane(clearGlass());
    const std::vector<float> alone = drawn(scene, ofSide(kBentPixels));
    scene.materials.push_back(clearGlass());
    scene.materials.back().perceptualRoughness = 0.5f;
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().instances[0].material = 1;
    scene.nodes.back().parentFromNode[3] = {0.0, 0.0, 500.0, 1.0}; // behind the camera
    EXPECT_EQ(drawn(scene, ofSide(kBentPixels)), alone);
}

TEST_F(Glass, aBodyShowsTheEnvironmentWhereSnellsLawSays) {
    for (const double ior : {1.0, 1.5, 2.4, 0.75, 0.0})
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            const std::vector<float> shown = drawn(bentPlane(bareGlass(ior)), ofSide(kBentPixels, light));
            int judged = 0, dark = 0;
            for (int y = 0; y < kBentPixels; ++y)
                for (int x = 0; x < kBentPixels; ++x) {
                    const float* const pixel = &shown[std::size_t(4 * (y * kBentPixels + x))];
                    const glm::dvec3 toViewer = toViewerOfBent(x, y);
                    const double cosView = glm::dot(kBentNormal, toViewer);
                    // Beyond the plane's edge, and where total reflection begins, which steepens what rounding does.
                    if (cosView < 0.05 || std::abs(std::sqrt(1.0 - cosView * cosView) - ior) < 1e-3) continue;
                    const std::optional<glm::dvec3> bent = bentDirection(toViewer, ior);
                    // Angles in fp32 are good to 1e-5, and the sky changes by less than 3 per rad.
                    ASSERT_NEAR(pixel[0], bent ? bentSkyAlong(*bent) : 0.0, 1e-3)
                        << ior << ", " << infoOf(light).name << " at " << x << ", " << y;
                    ++judged;
                    dark += bent ? 0 : 1;
                }
            EXPECT_GT(judged, kBentPixels * kBentPixels / 2);
            EXPECT_EQ(dark > 0, ior > 0.0 && ior < 1.0) << ior << ": total reflection";
        }
}

/// KHR_materials_dispersion, by the Abbe number: n_F - n_C = (n_d - 1) / V.
TEST_F(Glass, aBodyThatDispersesBendsEachColorByItsOwnIndex) {
    struct Body {
        double ior, abbeNumber;
        glm::dvec3 wanted;
    };
    const Body bodies[] = {{1.5, 20.0, {1.4875, 1.5, 1.5125}},
                           {2.0, 5.0, {1.9, 2.0, 2.1}},
                           {1.5, 0.25, {1.0, 1.5, 2.5}}, // held to 1, as by KHR_materials_dispersion
                           {0.0, 5.0, {0.0, 0.0, 0.0}}};
    for (const auto& [ior, abbeNumber, wanted] : bodies)
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            Material glass = bareGlass(ior);
            glass.dispersion = float(20.0 / abbeNumber);
            const std::vector<float> shown = drawn(bentPlane(glass), ofSide(kBentPixels, light));
            double apart = 0.0;
            for (int y = 0; y < kBentPixels; ++y)
                for (int x = 0; x < kBentPixels; ++x) {
                    const float* const pixel = &shown[std::size_t(4 * (y * kBentPixels + x))];
                    const glm::dvec3 toViewer = toViewerOfBent(x, y);
                    if (glm::dot(kBentNormal, toViewer) < 0.05) continue;
                    for (int c = 0; c < 3; ++c)
                        // As without dispersion.
                        ASSERT_NEAR(pixel[c], bentSkyAlong(*bentDirection(toViewer, wanted[c])), 1e-3)
                            << ior << ", " << abbeNumber << ", " << infoOf(light).name << " at " << x << ", " << y;
                    apart = std::max(apart, double(std::abs(pixel[0] - pixel[2])));
                }
            EXPECT_EQ(apart > 5e-3, ior > 0.0) << apart;
        }
}

/// Bodies that bend all colours alike take other code beside one that does not, and the same bits.
TEST_F(Glass, dispersionElsewhereInASceneChangesNoBit) {
    Scene scene = bentPlane(bareGlass(1.5, 0.3));
    const std::vector<float> alone = drawn(scene, ofSide(kBentPixels));
    Material dispersing = bareGlass(1.5, 0.3);
    dispersing.dispersion = 1.0f;
    scene.materials.push_back(dispersing);
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().instances[0].material = 1;
    scene.nodes.back().parentFromNode[3] = {0.0, 0.0, 500.0, 1.0}; // behind the camera
    EXPECT_EQ(drawn(scene, ofSide(kBentPixels)), alone);
}

/// Roughness spreads light by the index of refraction: none at 1, all from 1.5 on and at 0, which has no bound.
void Glass::expectRoughAsTheReference() {
    for (const double ior : {1.0, 1.25, 1.5, 2.0, 0.0}) {
        if (!isWholeSweep() && (ior == 1.25 || ior == 1.5)) continue;
        Material rough = bareGlass(ior, 0.6);
        if (ior == 2.0) rough.dispersion = 4.0f; // indices of 1.9, 2 and 2.1
        rough.baseColor = {0.9f, 0.7f, 0.5f, 1.0f};
        rough.attenuationDistanceMetres = 0.2f;
        rough.attenuationColor = {0.25f, 0.5f, 0.75f};
        const Scene scene = bentPlane(rough);
        frame::FrameSettings settings = ofSide(isWholeSweep() ? kBentPixels : kBentPixels / 2);
        settings.environment.samples = 1024;
        settings.filter = frame::TextureFilter::Exact;
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::None);
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            settings.environment.light = light;
            const std::vector<float> shown = drawn(scene, settings);
            double own = 0.0, other = 0.0, worst = 0.0;
            for (std::size_t i = 0; i < shown.size(); ++i) {
                if (i % 4 == 3 || truth.picture.covered[i / 4] == 0) continue;
                own += double(shown[i]);
                other += double(truth.picture.rgba[i]);
                worst = std::max(worst, double(std::abs(shown[i] - truth.picture.rgba[i])));
            }
            EXPECT_GT(other, 100.0);
            // At 0 all pixels look one way, so that what the filtered map's texels round there, 3.3 %, does not average
            // out.
            EXPECT_NEAR(own, other, (ior > 0.0 ? 0.01 : 0.05) * other) << ior << ", " << infoOf(light).name;
            EXPECT_LE(worst, 0.1) << ior << ", " << infoOf(light).name; // noise of both; levels between alphas
        }
    }
}
TEST_F(Glass, aRoughBodyAgreesWithTheReference) {
    expectRoughAsTheReference();
}
TEST_F(GlassSlow, aRoughBodyAgreesWithTheReference) {
    expectRoughAsTheReference();
}

/// Sheets and bodies among all other materials.
Scene sceneWithGlass() {
    Scene scene = everythingScene();
    Material& sheet = scene.materials[3]; // a textured sphere
    sheet.transmission = 0.8f;
    sheet.metallic = 0.2f;
    Material& masked = scene.materials[5];
    masked.transmission = 0.5f;
    Material& coated = scene.materials[11];
    coated.transmission = 0.9f;
    coated.thicknessMetres = 0.1f;
    coated.attenuationDistanceMetres = 0.2f;
    coated.attenuationColor = {0.9f, 0.4f, 0.2f};
    coated.dispersion = 1.0f;
    for (const scenes::TextureSlot slot : {scenes::TextureSlot::Transmission, scenes::TextureSlot::Thickness})
        coated.texture(slot).image = 0;
    return scene;
}

void Glass::expectAllTechniquesAlike() {
    const auto expectAlike = [&](Scene scene, bool isUnderSky, const std::vector<Technique>& techniques,
                                 bool comparesUnpruned) {
        SCOPED_TRACE(fmt::format("{}, under a sky: {}", scene.name, isUnderSky));
        if (isUnderSky) scene.environment = builtinEnvironment("studio");
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        engine::Renderer renderer(context(), scene);
        expectParity(renderer, settings, techniques);
        if (!comparesUnpruned) return;
        const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
        settings.prune = false;
        EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, pruned);
    };
    // Compiling takes nearly all of the time: with the environment two suffice.
    if (isWholeSweep()) {
        expectAlike(sceneWithGlass(), false, {}, true);
        expectAlike(sceneWithGlass(), true, {Technique::Deferred, Technique::ClusteredForward}, true);
        return;
    }
    // Programs of all features are those of other tests too, where there is no environment.
    expectAlike(fewWithGlass(), false, techniquesInTurn(0), false);
    expectAlike(fewWithGlass(), true, techniquesInTurn(1), false);
    expectAlike(sceneWithGlass(), false, {Technique::Deferred}, true);
}
TEST_F(Glass, everyTechniqueGivesTheSamePictureAndPruningChangesNoBit) {
    expectAllTechniquesAlike();
}
TEST_F(GlassSlow, everyTechniqueGivesTheSamePictureAndPruningChangesNoBit) {
    expectAllTechniquesAlike();
}

/// Each alone, where it changes the picture: what surrounds it would outnumber its errors.
TEST_F(Glass, sheetsAmongAllMaterialsAgreeWithTheReference) {
    frame::FrameSettings settings;
    settings.sizePixels = {96, 54};
    settings.filter = frame::TextureFilter::Exact;
    settings.refraction = frame::Refraction::Environment; // what else bodies show hangs on the picture
    const auto truthOf = [&](const Scene& scene) {
        return validation::referencePicture(
                   scene, settings, [] {}, validation::Leeway::None)
            .picture;
    };
    const Scene without = everythingScene(), all = sceneWithGlass();
    const Picture before = truthOf(without);
    const auto expectAgreement = [&](std::size_t number, const Material& material, double leeway) {
        SCOPED_TRACE(fmt::format("{}, leeway {}", material.name, leeway));
        Scene scene = without;
        scene.materials[number] = material;
        const Picture truth = truthOf(scene);
        const engine::RenderedFrame shown = engine::Renderer(context(), scene).render(Technique::Forward, settings);
        constexpr double kSame = 1e-3;
        const auto differs = [&](const std::vector<float>& picture, std::size_t pixel, double share) {
            for (std::size_t i = 4 * pixel; i < 4 * pixel + 3; ++i) {
                const double own = double(picture[i]), other = double(truth.rgba[i]);
                if (!(std::abs(own - other) <= share * other + 1e-4)) return true;
            }
            return false;
        };
        int glass = 0, wrong = 0;
        for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
            if (!differs(before.rgba, pixel, kSame)) continue;
            ++glass;
            wrong += differs(shown.radiance, pixel, leeway) ? 1 : 0;
        }
        fmt::print("{}: {} of {} pixels differ\n", material.name, wrong, glass);
        EXPECT_GT(glass, 40);
        // At edges, of masks too, rasterisers show another triangle or texel than rays hit.
        EXPECT_LE(wrong, glass / 20);
    };
    for (std::size_t number = 0; number < all.materials.size(); ++number) {
        Material material = all.materials[number];
        if (!scenes::isTransmissive(material)) continue;
        // What passes is that of one alpha in place of two, which a metal lets little through of.
        if (scenes::isAnisotropic(material)) expectAgreement(number, material, 0.05);
        material.anisotropyStrength = 0.0f;
        expectAgreement(number, material, 1e-3);
    }
}

/// Other surfaces of the transparent pass take other code beside it, and the same bits.
TEST_F(Glass, elsewhereInASceneChangesNoBitOfBlendedSurfaces) {
    Material blended;
    blended.baseColor = {0.4f, 0.6f, 0.9f, 0.3f};
    blended.metallic = 0.0f;
    blended.alphaMode = scenes::AlphaMode::Blend;
    Scene scene = quadScene(blended);
    scene.lights = {pointLight({0.3, 0.4, 1.0}, 3.0f)};
    scene.background = {0.2f, 0.3f, 0.1f};
    const std::vector<float> alone = drawn(scene, ofSide(32));
    scene.materials.push_back(clearGlass());
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().instances[0].material = 1;
    scene.nodes.back().parentFromNode[3] = {0.0, 0.0, 50.0, 1.0}; // behind the camera
    EXPECT_EQ(drawn(scene, ofSide(32)), alone);
}

TEST_F(Glass, materialsMayBecomeItWhileASceneIsShown) {
    Scene scene = everythingScene();
    frame::FrameSettings settings = ofSide(64);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> before = renderer.render(Technique::Deferred, settings).radiance;
    scene.materials = sceneWithGlass().materials;
    renderer.materialsChanged();
    const std::vector<float> edited = renderer.render(Technique::Deferred, settings).radiance;
    EXPECT_NE(edited, before);
    EXPECT_EQ(edited, drawn(scene, settings));
    scene.materials = everythingScene().materials;
    renderer.materialsChanged();
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, before);
}

TEST_F(Glass, aSceneWithoutItHasNoTraceOfIt) {
    const auto valuesOf = [](const Scene& scene, const std::string& define) {
        std::vector<std::string> values;
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::Deferred, {}))
            for (const auto& [name, value] : program.defines)
                if (name == define) values.push_back(value);
        return values;
    };
    using ::testing::Each;
    Scene scene = quadScene({});
    EXPECT_THAT(valuesOf(scene, "HAS_TRANSMISSION"), Each("0"));
    EXPECT_FALSE(valuesOf(scene, "HAS_TRANSMISSION").empty());
    EXPECT_THAT(valuesOf(scene, "HAS_VOLUME"), Each("0"));
    EXPECT_THAT(planText(engine::planFrame(scene, Technique::Deferred, {})), ::testing::HasSubstr("transmission"))
        << "told as left out";
    scene.materials[0].transmission = 0.5f;
    scene.materials[0].dispersion = 1.0f;
    EXPECT_THAT(valuesOf(scene, "HAS_TRANSMISSION"), ::testing::Contains("1"));
    EXPECT_THAT(valuesOf(scene, "HAS_VOLUME"), Each("0"));
    EXPECT_THAT(valuesOf(scene, "HAS_DISPERSION"), Each("0")) << "a sheet bends no light";
    scene.materials[0].thicknessMetres = 0.1f;
    EXPECT_THAT(valuesOf(scene, "HAS_DISPERSION"), ::testing::Contains("1"));
}

TEST_F(Glass, thatIsSmoothOrNotThereAsksForNoTableOfLobes) {
    const auto asks = [](const Scene& scene) {
        const std::string plan = planText(engine::planFrame(scene, Technique::Deferred, {}));
        const bool isThere = plan.find("lobe_table") != std::string::npos;
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::Deferred, {}))
            for (const auto& [name, value] : program.defines)
                EXPECT_TRUE(name != "HAS_PASSING_LOBES" || (value == "1") == isThere) << program.name;
        return isThere;
    };
    Scene scene = quadScene({});
    EXPECT_FALSE(asks(scene));
    scene.materials[0] = clearGlass();
    EXPECT_FALSE(asks(scene));
    scene.materials[0].anisotropyStrength = 0.5f;
    EXPECT_TRUE(asks(scene));
    scene.materials[0] = clearGlass();
    scene.materials[0].perceptualRoughness = 0.1f;
    EXPECT_TRUE(asks(scene));
    scene.materials[0].transmission = 0.0f;
    EXPECT_FALSE(asks(scene));
}

} // namespace
} // namespace tessera
