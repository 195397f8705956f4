#pragma once
#include <set>

#include "tests/image/ImageTest.h"

namespace tessera::test {

/// Images with several samples per pixel.
class MultisamplingTest : public ImageTest {
protected:
    static frame::FrameSettings sampled(glm::ivec2 sizePixels, int samples = 4) {
        frame::FrameSettings settings = withSamples(ofSize(sizePixels), samples);
        return settings;
    }
    Picture picture(const scenes::Scene& scene, const frame::FrameSettings& settings,
                    engine::Technique technique = engine::Technique::Forward) {
        return ImageTest::picture(scene, settings, technique);
    }
    static std::set<float> alphasOf(const Picture& picture) {
        std::set<float> alphas;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i) alphas.insert(picture.pixel(i)[3]);
        return alphas;
    }
};

} // namespace tessera::test
