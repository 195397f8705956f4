#include "renderer/frame/LightPictures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/frame/LightRange.h"
#include "shaders/shared/light_pictures.h"
#include "tests/support/AreaLights.h"
#include "tests/support/LightPictures.h"

namespace tessera::frame {
namespace {

using scenes::LightType;

scenes::Light picturedLight(LightType type, const scenes::LightTexture& texture) {
    scenes::Light light;
    light.type = type;
    light.radiusMetres = 0.5f;
    light.texture = texture;
    return light;
}

/// Reads a texel of a level.
glm::vec3 texelOf(const std::vector<glm::vec4>& texels, std::size_t picture, std::size_t level, int x, int y) {
    const glm::vec4 record = texels[picture * LIGHT_PICTURE_HEADER_TEXELS + LIGHT_PICTURE_FIRST_LEVEL + level];
    return glm::vec3(texels[std::size_t(record.x) + std::size_t(y) * std::size_t(record.y) + std::size_t(x)]);
}

TEST(LightPictures, lightsOfOnePictureAndOutlineShareAnEntry) {
    const scenes::LightTexture one = test::evenLightTexture(glm::vec3(1.0f)),
                               other = test::evenLightTexture(glm::vec3(0.5f));
    scenes::Scene scene;
    EXPECT_TRUE(lightPictures(scene).shown.empty());
    scene.lights.emplace_back();
    EXPECT_EQ(lightPictures(scene).numberOf(0), -1);
    for (int i = 0; i < 1000; ++i) scene.lights.push_back(picturedLight(LightType::Rectangle, one));
    scene.lights.push_back(picturedLight(LightType::Disk, one));
    scene.lights.push_back(picturedLight(LightType::Rectangle, other));
    scene.lights.push_back(picturedLight(LightType::Sphere, other)); // spheres show no image
    const LightPictures pictures = lightPictures(scene);
    EXPECT_EQ(pictures.shown.size(), 3u);
    for (const auto& [light, picture] : {std::pair(0, -1), {1, 0}, {1000, 0}, {1001, 1}, {1002, 2}, {1003, -1}})
        EXPECT_EQ(pictures.ofLight[std::size_t(light)], picture) << light;
}

TEST(LightPictures, sidesAndNumbersAreReadAsTheyWerePacked) {
    for (const bool isTwoSided : {false, true})
        for (const int picture : {-1, 0, 1, 4095}) {
            const float sides = packSides(isTwoSided, picture);
            EXPECT_EQ(shared::shinesFromBothSides(sides), isTwoSided);
            EXPECT_EQ(shared::lightPictureOf(sides), picture);
        }
    EXPECT_EQ(packSides(false, -1), 0.0f);
    EXPECT_EQ(packSides(true, -1), 1.0f);
}

TEST(LightPictures, anEvenPictureIsTheSameNumberEverywhere) {
    const glm::vec3 factor(0.1f, 1.0f, 3.7f);
    for (const LightType type : test::kFlatTypes) {
        const std::vector<ShownPicture> shown{
            {test::lightTexture(37, 5, [&](int, int) { return factor; }), type, scenes::LightCorners()}};
        const std::vector<glm::vec4> texels = prefilteredPictures(shown);
        EXPECT_EQ(texels.size() * sizeof(glm::vec4), lightPictureBytes(shown));
        EXPECT_EQ(glm::vec3(texels[0]), factor);
        EXPECT_EQ(texels[0].a, 37.0f);
        for (std::size_t i = LIGHT_PICTURE_HEADER_TEXELS; i < texels.size(); ++i)
            ASSERT_EQ(glm::vec3(texels[i]), factor) << i;
    }
}

TEST(LightPictures, levelsBlurAsTheirGaussiansSay) {
    const std::vector<ShownPicture> shown{
        {test::lightTexture(64, 64, [](int x, int) { return glm::vec3(x < 32 ? 1.0f : 0.0f); }),
         LightType::Rectangle,
         {}}};
    const std::vector<glm::vec4> texels = prefilteredPictures(shown);
    const std::vector<PictureLevel> levels = pictureLevels(64, 64);
    EXPECT_EQ(glm::vec3(texels[0]), glm::vec3(0.5f));
    EXPECT_EQ(levels.back().deviation, 1.0);
    EXPECT_EQ(texelOf(texels, 0, 0, 31, 7), glm::vec3(1.0f));
    EXPECT_EQ(texelOf(texels, 0, 0, 32, 7), glm::vec3(0.0f));
    // Far from the image's edges, a filtered step is the cumulative normal distribution.
    for (std::size_t i = 1; i + 4 < levels.size(); ++i) {
        SCOPED_TRACE(i);
        const PictureLevel& level = levels[i];
        const int x = level.width / 2;
        const double away = (x + 0.5) / level.width - 0.5;
        EXPECT_NEAR(texelOf(texels, 0, i, x, level.height / 2).g,
                    0.5 * std::erfc(away / (level.deviation * std::sqrt(2.0))), 0.01);
    }
}

TEST(LightPictures, levelsTakeFourTimesTheTexelsOfAPictureAtMost) {
    const auto texelsOf = [](int width, int height) {
        std::size_t texels = 0;
        for (const PictureLevel& level : pictureLevels(width, height))
            texels += std::size_t(level.width) * std::size_t(level.height);
        return texels;
    };
    for (const int width : {64, 65, 100, 128, 1000, 2048, 16384})
        for (const int height : {64, 70, 256}) {
            EXPECT_LE(texelsOf(width, height), std::size_t(4 * width * height)) << width << " x " << height;
            EXPECT_GE(texelsOf(width, height), std::size_t(3 * width * height)) << "the first two are as fine";
        }
    EXPECT_EQ(texelsOf(1, 1), 1u + 256u);
    EXPECT_EQ(texelsOf(2, 2), 4u + 2u * 256u);
    EXPECT_EQ(texelsOf(8, 8), 64u + 4u * 256u);
}

TEST(LightPictures, aRampStaysTheSameRampInAllLevels) {
    const std::vector<ShownPicture> shown{
        {test::lightTexture(64, 64,
                            [](int x, int y) { return glm::vec3(float(x) + 0.5f, float(y) + 0.5f, 0.0f) / 64.0f; }),
         LightType::Rectangle,
         {}}};
    const std::vector<glm::vec4> texels = prefilteredPictures(shown);
    const std::vector<PictureLevel> levels = pictureLevels(64, 64);
    for (std::size_t i = 0; i < levels.size(); ++i)
        for (int y = 0; y < levels[i].height; ++y)
            for (int x = 0; x < levels[i].width; ++x) {
                const glm::vec3 texel = texelOf(texels, 0, i, x, y);
                ASSERT_NEAR(texel.x, (x + 0.5) / levels[i].width, 2e-3) << i << ": " << x << ", " << y;
                ASSERT_NEAR(texel.y, (y + 0.5) / levels[i].height, 2e-3) << i << ": " << x << ", " << y;
            }
}

TEST(LightPictures, whatLiesBesideTheOutlineIsNotPartOfTheLight) {
    const auto corner = [](int x, int y) { return glm::vec3(x < 2 && y < 2 ? 1.0f : 0.25f); };
    const scenes::LightTexture texture = test::lightTexture(32, 32, corner);
    const scenes::LightCorners right = test::cornersOf({{0.0f, -1.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}});
    const std::vector<ShownPicture> shown{
        {texture, LightType::Rectangle, {}}, {texture, LightType::Disk, {}}, {texture, LightType::Polygon, right}};
    const std::vector<glm::vec4> texels = prefilteredPictures(shown);
    EXPECT_GT(texels[0].g, 0.25f);
    EXPECT_EQ(texels[LIGHT_PICTURE_HEADER_TEXELS].g, 0.25f);
    EXPECT_EQ(texels[2 * LIGHT_PICTURE_HEADER_TEXELS].g, 0.25f);
    // An outline between all samples of texels shows the whole texture.
    const scenes::LightCorners thin = test::cornersOf({{-1.0f, 0.01f}, {1.0f, 0.01f}, {1.0f, 0.011f}});
    const std::vector<ShownPicture> line{
        {test::lightTexture(4, 4, [](int, int) { return glm::vec3(0.25f); }), LightType::Polygon, thin}};
    EXPECT_EQ(prefilteredPictures(line)[0].g, 0.25f);
}

/// Compares with sums over a fine grid.
TEST(LightPictures, theVariancesOfAnOutlineAreThoseOfItsPlaces) {
    const scenes::LightTexture texture = test::evenLightTexture(glm::vec3(1.0f));
    const scenes::LightCorners ell =
        test::cornersOf({{-0.6f, -0.5f}, {0.8f, -0.5f}, {0.8f, -0.1f}, {0.1f, 0.0f}, {0.0f, 0.9f}, {-0.6f, 0.7f}});
    double reach = 0.0;
    for (const glm::vec2& at : ell.all()) reach = std::max(reach, double(glm::length(at)));
    const std::vector<glm::vec4> texels = prefilteredPictures(std::vector<ShownPicture>{
        {texture, LightType::Rectangle, {}}, {texture, LightType::Disk, {}}, {texture, LightType::Polygon, ell}});
    const auto isWithin = [&](std::size_t shape, const glm::dvec2& at) {
        if (shape == 0) return true;
        if (shape == 1) return glm::dot(at, at) <= 1.0;
        const glm::dvec2 p = at * reach;
        if (p.x < -0.6 || p.y < -0.5 || p.x > 0.8) return false;
        if (p.x > 0.1) return p.y < -0.1 + (0.8 - p.x) / 0.7 * 0.1;
        if (p.x > 0.0) return p.y < (0.1 - p.x) * 9.0;
        return p.y < 0.9 + p.x / 0.6 * 0.2;
    };
    constexpr int kSteps = 1000;
    for (std::size_t shape = 0; shape < 3; ++shape) {
        double all = 0.0;
        glm::dvec2 sum(0.0), squares(0.0);
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const glm::dvec2 at = (glm::dvec2(i % kSteps, i / kSteps) + 0.5) * (2.0 / kSteps) - 1.0;
            if (!isWithin(shape, at)) continue;
            all += 1.0;
            sum += at;
            squares += at * at;
        }
        const glm::dvec2 wanted = squares / all - sum * sum / (all * all);
        const glm::vec4 found = texels[shape * LIGHT_PICTURE_HEADER_TEXELS + LIGHT_PICTURE_VARIANCES];
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(found[i], wanted[i], 5e-4) << shape << ", " << i;
    }
}

TEST(LightPictures, rangesReachAsFarAsTheBrightestTexel) {
    scenes::Light light = picturedLight(LightType::Rectangle, {});
    const double plain = reachMetres(light, 0.01);
    light.texture = test::lightTexture(8, 8, [](int x, int y) { return glm::vec3(x == 3 && y == 5 ? 4.0f : 0.0f); });
    scenes::Light bright = picturedLight(LightType::Rectangle, {});
    bright.intensity = 4.0f;
    EXPECT_EQ(reachMetres(light, 0.01), reachMetres(bright, 0.01));
    EXPECT_GT(reachMetres(light, 0.01), plain);
    light.intensity = 1e30f;
    EXPECT_LE(mostColor(light).g, 1.0001e30);
    light.texture = test::evenLightTexture(glm::vec3(0.0f));
    EXPECT_EQ(mostColor(light), glm::dvec3(0.0));
}

} // namespace
} // namespace tessera::frame
