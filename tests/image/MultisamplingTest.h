#pragma once
#include <set>

#include "engine/Rendering.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"

namespace tessera::test {

/// Pictures of several samples a pixel.
class MultisamplingTest : public GlTest {
protected:
    static frame::FrameSettings sampled(glm::ivec2 sizePixels, int samples = 4) {
        frame::FrameSettings settings;
        settings.sizePixels = sizePixels;
        settings.samples = samples;
        return settings;
    }
    Picture picture(const scenes::Scene& scene, const frame::FrameSettings& settings,
                    engine::Technique technique = engine::Technique::Forward) {
        engine::Renderer renderer(context(), scene);
        return engine::toPicture(renderer.render(technique, settings));
    }
    static std::set<float> alphasOf(const Picture& picture) {
        std::set<float> alphas;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i) alphas.insert(picture.pixel(i)[3]);
        return alphas;
    }
};

} // namespace tessera::test
