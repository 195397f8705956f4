// Textured area lights: parity of techniques, pruning, known answers, and the reference.
#include <numbers>

#include "engine/PrepareView.h"
#include "renderer/graph/Plan.h"
#include "tests/image/AreaLightTest.h"
#include "tests/support/LightPictures.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using namespace test;

scenes::Light picturedArea(LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS,
                           const scenes::LightTexture& texture) {
    scenes::Light light = areaLight(type, positionWS, directionWS, 3.0f);
    light.radiusMetres = type == LightType::Disk ? 0.5f : 0.0f;
    light.texture = texture;
    return light;
}

/// Four by four fields of different colours, of four by four texels each.
scenes::LightTexture fieldsTexture() {
    return lightTexture(16, 16, [](int x, int y) {
        const int field = x / 4 + 4 * (y / 4);
        return glm::vec3(0.1f * float(field % 5), 0.05f * float(field), field % 3 == 0 ? 2.0f : 0.25f);
    });
}

scenes::Scene withPictures(scenes::Scene scene) {
    double x = -1.0;
    for (const LightType type : kFlatTypes) {
        scenes::Light light = picturedArea(type, {x, 0.6, 1.2}, {-0.3 * x, -0.4, -1.0}, fieldsTexture());
        light.isTwoSided = type == LightType::Disk;
        light.rangeMetres = type == LightType::Disk ? 4.0f : scenes::kInfinity;
        scene.lights.push_back(light);
        x += 1.0;
    }
    scenes::Light plain = picturedArea(LightType::Rectangle, {0.0, -0.8, 1.0}, {0.0, 0.5, -1.0}, {});
    plain.rangeMetres = 3.0f;
    scene.lights.push_back(plain);
    return scene;
}

class LightPictures : public EnvironmentTest {
protected:
    std::vector<float> radianceOf(const scenes::Scene& scene, bool prune = true) {
        frame::FrameSettings settings = ofSize(96, 54);
        settings.prune = prune;
        return drawn(scene, settings, Technique::TiledDeferred);
    }
};

TEST_SWEEP(LightPictures, everyTechniqueGivesTheSamePictureToTheLastBit) {
    std::vector<scenes::Scene> all{withPictures(quadScene(twoSided(lambert())))};
    if (isWholeSweep()) all.push_back(withPictures(quadScene({})));
    for (scenes::Scene& scene : all) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(96, 54);
        expectParity(renderer, settings, isWholeSweep() ? std::vector<Technique>{} : techniquesInTurn(3));
        for (scenes::Light& light : scene.lights) light.rangeMetres = scenes::kInfinity;
        settings.rangeTolerance = 0.05; // truncates lights in the lists
        engine::Renderer tolerant(context(), scene);
        expectParity(tolerant, settings, {Technique::ClusteredDeferred});
        settings.area = {frame::AreaLights::Sampled, 4};
        expectParity(tolerant, settings, {Technique::ClusteredDeferred});
    }
}

TEST_F(LightPictures, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    const scenes::Scene scene = withPictures(quadScene({}));
    EXPECT_EQ(radianceOf(scene, true), radianceOf(scene, false));
}

TEST_F(LightPictures, aSceneWithoutThemHasNoTraceOfThem) {
    scenes::Scene scene = withPictures(quadScene(twoSided(lambert())));
    const auto isDefined = [&] {
        return std::ranges::count(definedValues(scene, "HAS_LIGHT_PICTURES"), "1") +
                   std::ranges::count(definedValues(scene, "SEEN_PICTURES"), "1") >
               0;
    };
    const auto isPlanned = [&] {
        return planText(engine::planFrame(scene, Technique::Deferred, {})).find("light_pictures") != std::string::npos;
    };
    EXPECT_TRUE(isDefined());
    EXPECT_TRUE(isPlanned());
    for (scenes::Light& light : scene.lights) light.texture = {};
    EXPECT_FALSE(isDefined());
    EXPECT_FALSE(isPlanned());
}

TEST_F(LightPictures, aWhiteOneChangesNoBitAndAnEvenOneIsAFactor) {
    for (const LightType type : kFlatTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        scenes::Scene scene = quadScene(twoSidedMetal(0.5, 0.4));
        scene.lights = {picturedArea(type, {0.3, 0.2, 0.8}, {0.1, -0.2, -1.0}, {})};
        const std::vector<float> plain = radianceOf(scene);
        EXPECT_GT(*std::ranges::max_element(plain), 0.1f);
        scene.lights[0].texture = evenLightTexture(glm::vec3(1.0f), 7);
        EXPECT_EQ(radianceOf(scene), plain);
        const glm::vec3 factor(0.3f, 1.7f, 0.01f);
        scene.lights[0].texture = evenLightTexture(factor, 7);
        const std::vector<float> even = radianceOf(scene);
        scene.lights[0].texture = {};
        scene.lights[0].color *= factor;
        const std::vector<float> tinted = radianceOf(scene);
        for (std::size_t i = 0; i < even.size(); ++i) ASSERT_NEAR(even[i], tinted[i], 1e-6f * (1e-3f + tinted[i])) << i;
    }
}

TEST_F(LightPictures, aPictureIsSeenSharpAndTheRightWayRound) {
    for (const LightType type : kFlatTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        // Viewed from the front, x to the right and y up: red is left, green at the top.
        scenes::Light light = picturedArea(type, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {});
        light.alongWS = {1.0, 0.0, 0.0};
        light.intensity = 1.0f;
        light.texture = lightTexture(
            2, 2, [](int x, int y) { return glm::vec3(x == 0 ? 1.0f : 0.0f, y == 0 ? 1.0f : 0.0f, 0.5f); });
        scenes::Scene scene = quadScene(twoSided(lambert()));
        scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, -5.0, 1.0);
        scene.lights = {light};
        makeOrthographic(scene.cameras[0], 0.5);
        const std::vector<float> radiance = drawn(scene, ofSize(64, 64));
        const double half = type == LightType::Polygon ? std::sqrt(0.5) : 0.5; // half extent of the corners
        int compared = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const float* const pixel = pixelAt(radiance, 64, x, y);
                if (pixel[2] != 0.5f) continue;
                ++compared;
                // Metres from the centre; the factor is linear between the two texel centres.
                const double right = (x + 0.5) / 64.0 - 0.5, up = 0.5 - (y + 0.5) / 64.0;
                ASSERT_NEAR(pixel[0], std::clamp(0.5 - right / half, 0.0, 1.0), 1e-4) << x << ", " << y;
                ASSERT_NEAR(pixel[1], std::clamp(0.5 + up / half, 0.0, 1.0), 1e-4) << x << ", " << y;
            }
        EXPECT_GT(compared, type == LightType::Disk ? 3000 : 4000);
    }
}

TEST_F(LightPictures, surfacesAreSeenAsTheReferenceSeesThem) {
    scenes::Material black = twoSided(lambert());
    black.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    scenes::Scene scene = withPictures(quadScene(black));
    for (scenes::Light& light : scene.lights) {
        light.directionWS *= -1.0;
        light.isTwoSided = true;
    }
    scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.2, 0.4, 4.0}, {0.0, 0.2, 1.0});
    const std::vector<float> radiance = drawn(scene, ofSize(96, 54));
    const validation::ReferencePicture truth = strictReference(scene, ofSize(96, 54));
    int bright = 0, wrong = 0;
    for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
        if (!(truth.picture.rgba[4 * i + 2] > 0.7f)) continue; // blue is 0.25 or 2, times 3
        ++bright;
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(radiance[4 * i + c] - truth.picture.rgba[4 * i + c]) > 1e-3f) {
                ++wrong;
                break;
            }
    }
    fmt::print("{} of {} differ\n", wrong, bright);
    EXPECT_GT(bright, 300);
    EXPECT_LE(wrong, bright / 20); // on outlines
}

/// Irradiance at the centre of a matte quad in z = 0.
class LightPictureTruth : public MiddleOfQuadTest {
protected:
    double irradiance(const scenes::Light& light) { return seen(matte(), {light}); }
    /// Error of an image of a ball under a rectangle at this distance, against the integral over the light.
    BallError onBall(const scenes::Material& material, double distanceMetres, const scenes::LightTexture& texture) {
        scenes::Scene scene = ballUnderSky(material);
        const glm::dvec3 towards = glm::normalize(glm::dvec3(1.2, 1.5, 2.0));
        scene.lights = {picturedArea(LightType::Rectangle, (1.0 + distanceMetres) * towards, -towards, texture)};
        scene.lights[0].isSeen = false;
        return errorOfBall(scene, 32, 1);
    }
};

/// Sampled textured lights against the integral over light and texture, at one point that 256 pixels show.
TEST_F(LightPictureTruth, samplesAgreeWithTheIntegralWithinThreeStandardErrors) {
    const scenes::Material metal = twoSided(metalOf(0.4));
    for (const LightType type : inTurn(kFlatTypes, 2)) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        scenes::Scene scene = quadScene(metal);
        makeOrthographic(scene.cameras[0], 1e-5);
        scene.lights = {picturedArea(type, {0.3, 0.2, 0.8}, {-0.2, -0.1, -1.0}, fieldsTexture())};
        scene.lights[0].isSeen = false;
        const std::vector<float> truth = strictRadiance(scene, ofSize(1, 1));
        frame::FrameSettings settings = ofSize(16, 16);
        settings.area = {frame::AreaLights::Sampled, 64};
        const std::vector<float> shown = drawn(scene, settings);
        const double count = double(shown.size()) / 4.0;
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0, squares = 0.0;
            for (std::size_t i = c; i < shown.size(); i += 4) {
                sum += double(shown[i]);
                squares += double(shown[i]) * double(shown[i]);
            }
            const double mean = sum / count, standardError = std::sqrt((squares / count - mean * mean) / count);
            EXPECT_NEAR(mean, double(truth[c]), 3.0 * standardError + 1e-4 * mean);
            EXPECT_LE(standardError, 0.01 * mean);
        }
    }
}

/// The truth is the closed form of a rectangle of half the width.
TEST_F(LightPictureTruth, halfOfAPictureLightsAsHalfOfTheRectangleFromAfar) {
    const scenes::LightTexture half = lightTexture(64, 1, [](int x, int) { return glm::vec3(x < 32 ? 1.0f : 0.0f); });
    for (const double distance : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0})
        for (const double aside : {0.0, 0.5, 1.0}) {
            scenes::Light whole =
                picturedArea(LightType::Rectangle, {aside * distance, 0.0, distance}, {-0.2 * aside, 0.0, -1.0}, half);
            scenes::Light left = whole;
            left.texture = {};
            left.widthMetres = 0.5f;
            left.positionWS -= 0.25 * left.alongWS;
            const double found = irradiance(whole), wanted = irradiance(left), error = found / wanted - 1.0;
            fmt::print("{:4} m away, {:4} m aside: {:+.1e}\n", distance, aside * distance, error);
            // Straight ahead both halves contribute the same. From afar the weighted mean position is accurate to the
            // square of the width over the distance; nearby it is approximate, with a Gaussian around it.
            EXPECT_NEAR(error, 0.0, aside == 0.0 ? 2e-3 : distance < 2.0 ? 0.2 : 5e-3);
        }
}

/// Configuration factor of a square of this side for a point below its centre, at this distance, from four quarters.
/// Siegel and Howell 1972, "Thermal Radiation Heat Transfer".
double factorOfSquareAbove(double sideMetres, double distanceMetres) {
    const double x = 0.5 * sideMetres / distanceMetres, root = std::sqrt(1.0 + x * x);
    return 4.0 / std::numbers::pi * x / root * std::atan(x / root);
}

/// A square with a bright middle, straight ahead: the Gaussian's error is 7 % more at 0.2 m and 9 % less at 0.5 m. One
/// of half or twice the width errs by a third and more from 0.2 to 0.5 m.
TEST_F(LightPictureTruth, aBrightMiddleIsSeenAsWideAsACosineSeesIt) {
    const scenes::LightTexture middle = lightTexture(64, 64, [](int x, int y) {
        const bool isWithin = x >= 16 && x < 48 && y >= 16 && y < 48;
        return glm::vec3(isWithin ? 1.0f : 0.0f);
    });
    for (const double distance : {0.2, 0.3, 0.5, 1.0, 2.0, 8.0}) {
        scenes::Light light = picturedArea(LightType::Rectangle, {0.0, 0.0, distance}, {0.0, 0.0, -1.0}, {});
        const double plain = irradiance(light);
        light.texture = middle;
        const double wanted = factorOfSquareAbove(0.5, distance) / factorOfSquareAbove(1.0, distance);
        const double error = irradiance(light) / plain / wanted - 1.0;
        fmt::print("{:4} m away: {:+.1f} %\n", distance, 100.0 * error);
        EXPECT_NEAR(error, 0.0, 0.18) << distance;
    }
}

/// docs/area-lights.md contains the printed table.
TEST_SWEEP(LightPictureTruth, onABallPicturesAreNearTheirIntegral) {
    const std::vector<double> distances = isWholeSweep() ? std::vector{0.25, 1.0, 4.0} : std::vector{1.0};
    const std::vector<double> roughnesses = isWholeSweep() ? std::vector{0.0, 0.25, 0.5, 0.75, 1.0} : std::vector{0.5};
    for (const double distance : distances)
        for (const double roughness : roughnesses) {
            const scenes::Material metal = metalOf(roughness);
            const BallError plain = onBall(metal, distance, {}), pictured = onBall(metal, distance, fieldsTexture());
            fmt::print("| {} m | {:.2f} | {:+.1f} %, {:.0e} | {:+.1f} %, {:.0e} |\n", distance, roughness,
                       100.0 * pictured.bias, pictured.relMse, 100.0 * plain.bias, plain.relMse);
            EXPECT_LE(std::abs(pictured.bias), 0.1);
            EXPECT_LE(pictured.relMse, 0.2);
        }
}

TEST_F(LightPictureTruth, lightsOfAnySizeAndPlaceGiveFiniteLight) {
    const scenes::LightTexture texture = fieldsTexture();
    for (const LightType type : kFlatTypes)
        for (const float size : {1e-6f, 1e-2f, 1.0f, 1e3f, 1e6f})
            for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1e-5), glm::dvec3(0.5, 0.0, 0.0),
                                         glm::dvec3(0.0, 0.0, -0.1), glm::dvec3(1e5, 0.0, 1.0)}) {
                scenes::Light light = picturedArea(type, at, {0.3, 0.0, -1.0}, {});
                light.widthMetres = light.heightMetres = light.radiusMetres = size;
                for (glm::vec2& corner : light.corners.metres) corner *= size;
                const double plain = irradiance(light);
                light.texture = texture;
                const double pictured = irradiance(light);
                EXPECT_TRUE(std::isfinite(pictured) && pictured >= 0.0 && pictured <= 0.41 * plain)
                    << scenes::infoOf(type).name << " of " << size << " at " << at.x << " " << at.z << ": " << pictured
                    << " of " << plain;
            }
}

} // namespace
} // namespace tessera
