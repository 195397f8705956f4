#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/FlatTest.h"

namespace tessera {
namespace {

using namespace test;
using scenes::Material;
using scenes::Scene;

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
