// Images that are shifted by fractions of a pixel, and their mean.
#include "viewer/show/Smoothing.h"

#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using engine::Technique;
using viewer::Smoothing;
using namespace test;

class Smoothed : public ImageTest {
protected:
    static frame::FrameSettings settings() { return ofSize(96, 54); }
};

TEST_F(Smoothed, isTheMeanOfTheShiftedPicturesRenderedOneByOneToTheLastBit) {
    const scenes::Scene scene = scenes::loadScene("room");
    for (const Technique technique : {Technique::Forward, Technique::ClusteredDeferred}) {
        engine::Renderer renderer(context(), scene);
        Smoothing smoothing;
        frame::FrameSettings shifted = settings();
        for (int i = 0; i < Smoothing::kPictures; ++i) {
            shifted.offsetPixels = Smoothing::offsetPixels(i);
            renderer.draw(technique, shifted);
            smoothing.add(renderer.programs(), renderer.radianceTexture());
        }
        ASSERT_TRUE(smoothing.isDone());
        smoothing.showMean(renderer.programs(), settings());
        const engine::RenderedFrame mean = engine::readBack(smoothing.sum()->texture(), &smoothing.shown()->texture());

        std::vector<float> sum;
        for (int i = 0; i < Smoothing::kPictures; ++i) {
            shifted.offsetPixels = Smoothing::offsetPixels(i);
            const std::vector<float> radiance = drawn(scene, shifted, technique);
            if (sum.empty())
                sum = radiance;
            else
                std::ranges::transform(sum, radiance, sum.begin(), std::plus<>());
        }
        EXPECT_TRUE(mean.radiance == sum) << infoOf(technique).name;
        int wrong = 0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            if (i % 4 == 3) continue;
            const double linear = std::clamp(double(sum[i]) / Smoothing::kPictures, 0.0, 1.0);
            const double code = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
            wrong += std::abs(255.0 * code - double(mean.display[i])) > 0.51;
        }
        EXPECT_EQ(wrong, 0) << infoOf(technique).name;
    }
}

TEST_F(Smoothed, aShiftByAWholePixelMovesThePictureOfEveryTechniqueByThat) {
    const scenes::Scene scene = scenes::loadScene("room");
    engine::Renderer renderer(context(), scene);
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        frame::FrameSettings shifted = settings();
        const engine::RenderedFrame still = renderer.render(info.technique, shifted);
        shifted.offsetPixels = {2.0f, 1.0f}; // to the right and up
        const engine::RenderedFrame moved = renderer.render(info.technique, shifted);
        int differing = 0, all = 0;
        for (int y = 1; y < still.height; ++y)
            for (int x = 0; x + 2 < still.width; ++x) {
                const float* const from = &still.radiance[4 * std::size_t(y * still.width + x)];
                const float* const to = &moved.radiance[4 * std::size_t((y - 1) * still.width + x + 2)];
                const bool isEqual = std::equal(from, from + 3, to, [](float a, float b) {
                    return std::abs(a - b) <= 1e-3f * std::max(std::abs(a), std::abs(b));
                });
                differing += !isEqual;
                ++all;
            }
        // Pixels with an edge very close to their centres.
        EXPECT_LT(differing, all / 200) << info.name;
    }
}

TEST_F(Smoothed, theShiftsSpreadEvenlyOverThePixelAndSoDoTheFirst) {
    for (const int count : {8, Smoothing::kPictures}) {
        glm::dvec2 sum(0.0);
        std::vector<int> columns(4), rows(4);
        for (int i = 0; i < count; ++i) {
            const glm::vec2 offset = Smoothing::offsetPixels(i);
            ASSERT_LE(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5f);
            sum += glm::dvec2(offset);
            ++columns.at(std::size_t(4.0f * (offset.x + 0.5f)));
            ++rows.at(std::min<std::size_t>(std::size_t(4.0f * (offset.y + 0.5f)), 3));
        }
        EXPECT_LT(glm::length(sum / double(count)), 0.1) << count;
        for (const std::vector<int>& parts : {columns, rows})
            for (const int part : parts) EXPECT_NEAR(part, count / 4, 1) << count;
    }
}

} // namespace
} // namespace tessera
