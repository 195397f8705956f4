#include "engine/Rendering.h"

#include <limits>

#include <gtest/gtest.h>

namespace tessera::engine {
namespace {

TEST(DisplayImages, ofInfiniteRadianceAreWhiteAndOfNoNumberBlackByEveryToneMap) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
    Picture picture;
    picture.width = 3;
    picture.height = 1;
    picture.rgba = {kInfinity, kInfinity, kInfinity, 1.0f, kNaN, kNaN, kNaN, 1.0f, 3e38f, 3e38f, 3e38f, 1.0f};
    picture.covered = {1, 1, 1};
    for (const frame::ToneMapInfo& info : frame::toneMapTable()) {
        frame::FrameSettings settings;
        settings.toneMap = info.toneMap;
        const DisplayImage image = toDisplayImage(picture, settings);
        EXPECT_EQ(image.rgb, (std::vector<std::uint8_t>{255, 255, 255, 0, 0, 0, 255, 255, 255})) << info.name;
    }
}

} // namespace
} // namespace tessera::engine
