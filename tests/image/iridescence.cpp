// Thin films on surfaces: against closed forms, between techniques, and against the reference.

#include <gmock/gmock.h>

#include "tests/image/EnvironmentTest.h"
#include "tests/image/FlatTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Material;
using scenes::Scene;
using namespace test;

/// A film on a dielectric without diffuse reflection.
Material filmOnGlass(float thicknessNm, float ior = 1.3f, float roughness = 0.0f) {
    Material material = blackDielectric(roughness);
    material.name = "film on glass";
    material.iridescence = 1.0f;
    material.iridescenceIor = ior;
    material.iridescenceThicknessNm = thicknessNm;
    return material;
}

Material filmOnMetal(float thicknessNm, float ior = 1.8f, float roughness = 0.0f) {
    Material material = filmOnGlass(thicknessNm, ior, roughness);
    material.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
    material.metallic = 1.0f;
    return material;
}

class FlatFilms : public FlatTest {
protected:
    /// Reflection of uniform light by a mirror, viewed straight on or at an angle.
    glm::vec4 shown(const Material& material, double cosView = 1.0) {
        Scene scene = flatScene(material);
        scene.environment = evenEnvironment(1.0);
        if (cosView < 1.0) lookAtCosine(scene.cameras[0], cosView, 0.02);
        return center(scene);
    }
};

/// The eye's sensitivities average out interference there; the light of both sides adds up.
TEST_F(FlatFilms, tooThickToInterfereReflectWhatBothSidesDo) {
    for (const float ior : {1.3f, 1.8f})
        for (const Material& material : {filmOnGlass(2e4f, ior), filmOnMetal(2e4f, ior)}) {
            const glm::vec4 found = shown(material);
            for (int c = 0; c < 3; ++c) {
                const double bare = material.metallic > 0.0f ? double(material.baseColor[c]) : 0.04;
                const double below = (1.0 + std::sqrt(bare)) / (1.0 - std::sqrt(bare));
                const auto side = [](double a, double b) { return (a - b) * (a - b) / ((a + b) * (a + b)); };
                const double outer = side(1.0, double(ior)), inner = side(double(ior), below);
                EXPECT_NEAR(found[c], (outer + inner - 2.0 * outer * inner) / (1.0 - outer * inner), 1e-5)
                    << material.name << ", " << ior << ", " << c;
            }
        }
}

TEST_F(FlatFilms, aQuarterOfAWaveTakesTheReflectionFromGlass) {
    const float ior = std::sqrt(1.5f), quarterNm = 0.25f * 557.0f / ior;
    EXPECT_NEAR(shown(filmOnGlass(0.0f)).g, 0.04f, 1e-5f);
    const glm::vec4 coated = shown(filmOnGlass(quarterNm, ior));
    EXPECT_LT(coated.g, 0.001f);
    EXPECT_GT(coated.b, 0.004f);
    Material half = filmOnGlass(quarterNm, ior);
    half.iridescence = 0.5f;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown(half)[c], 0.5f * (0.04f + coated[c]), 1e-5f) << "half of it";
}

/// Below a cosine of 0.1, Schlick's curve through the reflectance at 0.1 replaces the film, with an F0 of at least 0:
/// the film itself would show 0.005 more red at 0.05, and 0.06 less blue at 0.1.
TEST_F(FlatFilms, nearTheHorizonAreThoseAtACosineOfATenth) {
    const Material film = filmOnGlass(400.0f);
    const auto risen = [](double straight, double cosView) {
        return straight + (1.0 - straight) * std::pow(1.0 - cosView, 5.0);
    };
    const double rise = risen(0.0, 0.1);
    const glm::vec4 least = shown(film, 0.1), nearer = shown(film, 0.05);
    const double red = (double(least.r) - rise) / (1.0 - rise);
    EXPECT_GT(red, 0.15);
    EXPECT_NEAR(nearer.r, risen(red, 0.05), 1e-3);
    EXPECT_NEAR(least.b, rise, 1e-3);
    EXPECT_NEAR(nearer.b, risen(0.0, 0.05), 1e-3);
}

/// A film of a thousandth of a wavelength has no effect: glass of index 1.5 reflects 0.04 below any film, also where
/// the film's index approaches its index from above, so that light keeps its phase at their border.
TEST_F(FlatFilms, muchThinnerThanAWaveAreNotSeen) {
    for (const float ior : {1.2f, 1.45f, 1.4997f, 1.5003f, 1.505f, 1.55f, 1.62f, 1.9f})
        EXPECT_NEAR(shown(filmOnGlass(0.1f, ior)).g, 0.04f, 2e-5f) << ior;
}

/// Reflectance at a cosine of 0.1 and above of a film too thick to interfere, by Schlick's factor at either side: down
/// to there the film itself is evaluated.
TEST_F(FlatFilms, areShownThemselvesUpToACosineOfATenth) {
    const auto schlick = [](double straight, double cosine) {
        return straight + (1.0 - straight) * std::pow(1.0 - cosine, 5.0);
    };
    for (const float ior : {1.3f, 1.8f})
        for (const double cosine : {0.1, 0.11, 0.3}) {
            const Material metal = filmOnMetal(2e4f, ior);
            const glm::vec4 found = shown(metal, cosine);
            const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (double(ior) * double(ior)));
            for (int c = 0; c < 3; ++c) {
                const double root = std::sqrt(double(metal.baseColor[c])), below = (1.0 + root) / (1.0 - root);
                const auto side = [](double a, double b) { return (a - b) * (a - b) / ((a + b) * (a + b)); };
                const double outer = schlick(side(1.0, double(ior)), cosine);
                const double inner = schlick(side(double(ior), below), inside);
                EXPECT_NEAR(found[c], (outer + inner - 2.0 * outer * inner) / (1.0 - outer * inner), 1e-4)
                    << ior << ", cosine " << cosine << ", " << c;
            }
        }
}

/// A film of no thickness, or with the index of air, has no effect.
TEST_F(FlatFilms, thatAreNoneChangeNothing) {
    Material bare = filmOnMetal(400.0f);
    bare.iridescence = 0.0f;
    const glm::vec4 wanted = shown(bare);
    EXPECT_EQ(shown(filmOnMetal(0.0f)), wanted);
    const glm::vec4 air = shown(filmOnMetal(400.0f, 1.0f));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(air[c], wanted[c], 1e-5f);
}

/// R scales the film's fraction, G its thickness from the least to that of the material.
TEST_F(FlatFilms, haveTheShareAndTheThicknessThatTexturesSay) {
    using scenes::TextureSlot;
    Material film = filmOnMetal(500.0f, 1.5f);
    film.iridescence = 0.8f;
    film.iridescenceLeastThicknessNm = 100.0f;
    const auto textured = [&](const Material& material, float share, float thickness) {
        Scene scene = flatScene(material);
        scene.environment = evenEnvironment(1.0);
        scene.images = {floatImage({share, 0.7f, 0.3f, 0.1f}), floatImage({0.7f, thickness, 0.3f, 0.1f})};
        scene.materials[0].texture(TextureSlot::Iridescence).image = 0;
        scene.materials[0].texture(TextureSlot::IridescenceThickness).image = 1;
        return center(scene);
    };
    EXPECT_EQ(textured(film, 1.0f, 1.0f), shown(film)) << "white changes no bit";
    Material partly = film;
    partly.iridescence = 0.4f;
    for (const float texel : {0.0f, 0.25f, 0.75f}) {
        partly.iridescenceThicknessNm = 100.0f + texel * 400.0f;
        const glm::vec4 found = textured(film, 0.5f, texel), wanted = shown(partly);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 1e-5f) << texel << ", " << c;
    }
    Material bare = film;
    bare.iridescence = 0.0f;
    const auto expectBare = [&](const glm::vec4& found) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], shown(bare)[c], 1e-5f) << c;
    };
    expectBare(textured(film, 0.0f, 1.0f));
    film.iridescenceLeastThicknessNm = 0.0f;
    expectBare(textured(film, 1.0f, 0.0f)); // no thickness
    // Inverted: a film only where the texture is dark.
    film.iridescenceThicknessNm = 0.0f;
    film.iridescenceLeastThicknessNm = 300.0f;
    partly.iridescence = 0.8f;
    partly.iridescenceThicknessNm = 300.0f;
    const glm::vec4 dark = textured(film, 1.0f, 0.0f), wanted = shown(partly);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(dark[c], wanted[c], 1e-5f) << c;
}

class Films : public EnvironmentTest {
protected:
    /// Counts over a ball that fills the image, without its rim: its pixels, and those that differ from the reference.
    struct Judged {
        int pixels = 0, wrong = 0;
        double colorful = 0.0; ///< the largest difference of red and blue
    };
    Judged judged(const Scene& scene) {
        constexpr int kBallPixels = 48;
        frame::FrameSettings settings = exactOfSize(kBallPixels, kBallPixels);
        const Picture truth = strictReference(scene, settings).picture;
        const std::vector<float> shown = drawn(scene, settings);
        Judged result;
        for (int y = 0; y < kBallPixels; ++y)
            for (int x = 0; x < kBallPixels; ++x) {
                const glm::dvec2 at = 1.02 * (glm::dvec2(2.0 * x + 1.0, 2.0 * y + 1.0) / double(kBallPixels) - 1.0);
                if (glm::length(at) > 0.97) continue;
                ++result.pixels;
                const std::size_t first = std::size_t(4 * (y * kBallPixels + x));
                bool differs = false;
                for (std::size_t i = first; i < first + 3; ++i) {
                    const double own = double(shown[i]), other = double(truth.rgba[i]);
                    differs = differs || !(std::abs(own - other) <= 1e-3 * other + 1e-4);
                }
                result.wrong += differs ? 1 : 0;
                result.colorful = std::max(result.colorful, double(std::abs(shown[first] - shown[first + 2])));
            }
        return result;
    }
};

/// Mirrors under uniform light show a film's reflection at each angle.
TEST_SWEEP(Films, ofMirrorsAgreeWithTheReferenceAtEveryAngle) {
    Material transparentBelow = filmOnGlass(550.0f, 1.5f);
    transparentBelow.specularFactor = 0.5f;
    transparentBelow.ior = 2.0f;
    Material partly = filmOnMetal(350.0f, 1.4f);
    partly.iridescence = 0.6f;
    // A film with the index of the glass reflects at its inner side only at an angle, by Schlick's factor.
    const std::vector<Material> all{filmOnGlass(300.0f),
                                    filmOnGlass(400.0f, 1.5f),
                                    filmOnGlass(600.0f, 1.9f),
                                    filmOnMetal(250.0f),
                                    filmOnMetal(500.0f, 2.4f),
                                    transparentBelow,
                                    partly};
    for (const Material& material : everyNth(all, 2)) {
        SCOPED_TRACE(
            fmt::format("{} of {} nm and {}", material.name, material.iridescenceThicknessNm, material.iridescenceIor));
        Scene scene = ballUnderSky(material);
        scene.environment = evenEnvironment(1.0);
        const Judged found = judged(scene);
        EXPECT_GT(found.pixels, 1000);
        EXPECT_EQ(found.wrong, 0);
        EXPECT_GT(found.colorful, 0.01);
    }
}

/// Highlights, and the light that the film transmits to the body below.
TEST_F(Films, underLightsAgreeWithTheReference) {
    Material matte = filmOnGlass(350.0f, 1.7f, 0.5f);
    matte.baseColor = {0.8f, 0.4f, 0.2f, 1.0f};
    matte.metallic = 0.4f;
    Material coated = filmOnMetal(450.0f, 1.5f, 0.4f);
    coated.clearcoat = 0.7f;
    coated.clearcoatPerceptualRoughness = 0.2f;
    coated.sheenColor = {0.2f, 0.3f, 0.4f};
    coated.sheenPerceptualRoughness = 0.5f;
    Material brushed = filmOnMetal(300.0f, 1.6f, 0.5f);
    brushed.anisotropyStrength = 0.7f;
    for (const Material& material : {matte, coated, brushed}) {
        SCOPED_TRACE(material.iridescenceThicknessNm);
        Scene scene = ballUnderSky(material);
        scene.lights = {pointLight({1.0, 1.5, 3.0}, 20.0f), pointLight({-3.0, -1.0, 1.0}, 20.0f)};
        const Judged found = judged(scene);
        EXPECT_LE(found.wrong, found.pixels / 50); // tangents at poles
        EXPECT_GT(found.colorful, 0.01);
    }
}

/// A texture with different values in every channel and texel.
TEST_F(Films, withTexturesAgreeWithTheReference) {
    Material film = filmOnMetal(600.0f, 1.6f);
    film.iridescenceLeastThicknessNm = 200.0f;
    Scene scene = ballUnderSky(film);
    scene.environment = evenEnvironment(1.0);
    const auto ramp = [](int x, int y) { return std::array<int, 4>{255 - 20 * x, 30 * y, 40 * (x ^ y) % 256, 90}; };
    scene.images = {image8(ramp)};
    scenes::Mesh& ball = scene.meshes[0];
    ball.texCoords[0].clear();
    for (const glm::vec3& position : ball.positionsOS) ball.texCoords[0].push_back(0.5f * glm::vec2(position) + 0.5f);
    for (const auto slot : {scenes::TextureSlot::Iridescence, scenes::TextureSlot::IridescenceThickness})
        scene.materials[0].texture(slot).image = 0;
    const Judged found = judged(scene);
    EXPECT_GT(found.pixels, 1000);
    EXPECT_EQ(found.wrong, 0);
    EXPECT_GT(found.colorful, 0.01);
}

/// The light of each channel that a film does not reflect is transmitted.
TEST_F(Films, onClearGlassInEvenLightShowExactlyThatLight) {
    constexpr int kFurnacePixels = 32;
    frame::FrameSettings settings = ofSize(kFurnacePixels, kFurnacePixels);
    Material glass = filmOnGlass(400.0f, 1.6f);
    glass.baseColor = glm::vec4(1.0f);
    glass.transmission = 1.0f;
    Scene scene = ballUnderSky(glass);
    scene.environment = evenEnvironment(1.0);
    const std::vector<float> shown = drawn(scene, settings);
    for (int y = 0; y < kFurnacePixels; ++y)
        for (int x = 0; x < kFurnacePixels; ++x) {
            const glm::dvec2 at = 1.02 * (glm::dvec2(2.0 * x + 1.0, 2.0 * y + 1.0) / double(kFurnacePixels) - 1.0);
            if (glm::length(at) > 0.95) continue; // interpolated normals turn away from the viewer
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(shown[std::size_t(4 * (y * kFurnacePixels + x) + c)], 1.0f, 1e-3f) << x << ", " << y;
        }
}

/// Films among all other materials, or only on metal, a mask and panes of glass.
Scene sceneWithFilms() {
    Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    for (const std::size_t material : {3u, 4u, 5u, 6u, 11u}) {
        scene.materials[material].iridescence = 0.8f;
        scene.materials[material].iridescenceThicknessNm = 200.0f + 50.0f * float(material);
        if (material % 2 == 0) continue;
        for (const auto slot : {scenes::TextureSlot::Iridescence, scenes::TextureSlot::IridescenceThickness})
            scene.materials[material].texture(slot).image = 0;
    }
    return scene;
}

/// Every technique, or only `deferred`, which is drawn anyway.
TEST_SWEEP(Films, everyTechniqueGivesTheSamePictureAndPruningChangesNoBit) {
    frame::FrameSettings settings = ofSize(96, 54);
    const Scene scene = sceneWithFilms();
    engine::Renderer renderer(context(), scene);
    expectParity(renderer, settings, isWholeSweep() ? techniquesInTurn(0) : std::vector{Technique::Deferred});
    EXPECT_NE(renderer.render(Technique::Deferred, settings).radiance,
              drawn(isWholeSweep() ? everythingScene() : metalScene(), settings))
        << "shows no film";
    expectPruningIsUnseen(renderer, settings);
}

/// Other surfaces take another code path beside one, with the same bits.
TEST_F(Films, elsewhereInASceneChangeNoBit) {
    Material plain;
    plain.metallic = 0.3f;
    plain.perceptualRoughness = 0.4f;
    Scene scene = quadScene(plain);
    scene.lights = {pointLight({0.3, 0.4, 1.0}, 3.0f)};
    frame::FrameSettings settings = ofSize(32, 32);
    const std::vector<float> alone = drawn(scene, settings, Technique::Forward);
    addNode(scene, filmOnMetal(300.0f)).parentFromNode[3].z = 50.0; // behind the camera
    EXPECT_EQ(drawn(scene, settings, Technique::Forward), alone);
}

TEST_F(Films, aSceneWithoutThemHasNoTraceOfThem) {
    const auto valuesOf = [](const Scene& scene) { return definedValues(scene, "HAS_IRIDESCENCE"); };
    Scene scene = quadScene(filmOnMetal(0.0f));
    EXPECT_FALSE(valuesOf(scene).empty());
    EXPECT_THAT(valuesOf(scene), ::testing::Each("0"));
    scene.materials[0].iridescenceThicknessNm = 100.0f;
    EXPECT_THAT(valuesOf(scene), ::testing::Contains("1"));
}

} // namespace
} // namespace tessera
