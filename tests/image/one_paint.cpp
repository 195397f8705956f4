// A ball of one paint in the coarse layouts: in any colour it is as bright as in fp32. Rough enough that what is
// of second order in alpha's step stays below: 0.5 in perceptual roughness, half of that where a texture varies it.
#include <cmath>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "tests/support/GlContext.h"
#include "tests/support/Random.h"
#include "tests/support/TestScenes.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;

scenes::Material randomPaint(test::Random& random) {
    scenes::Material paint;
    paint.baseColor = {random.unit(), random.unit(), random.unit(), 1.0f};
    paint.metallic = float(random.unit());
    paint.perceptualRoughness = float(random.between(0.5, 1.0));
    paint.ior = float(random.between(1.3, 2.0));
    return paint;
}

/// Colours, roughness and metallic that change over the surface, each its own way.
void vary(scenes::Scene& scene, test::Random& random) {
    for (const scenes::TextureSlot slot : {scenes::TextureSlot::BaseColor, scenes::TextureSlot::MetallicRoughness}) {
        scenes::Image& image = scene.images.emplace_back();
        image.name = "paint";
        image.width = image.height = 16;
        for (int i = 0; i < 16 * 16 * 4; ++i) image.texels.push_back(std::byte(random.between(120.0, 255.0)));
        scene.materials[0].texture(slot).image = int(scene.images.size()) - 1;
    }
}

scenes::Scene ballOf(const scenes::Material& paint) {
    scenes::Scene scene = test::quadScene(paint);
    scene.meshes = {test::everythingScene().meshes[1]};
    scene.meshes[0].colors.clear();
    scenes::Light sun;
    sun.type = scenes::LightType::Directional;
    sun.directionWS = glm::normalize(glm::dvec3(-0.4, -0.7, -1.0));
    scene.lights = {sun, test::pointLight({-1.5, 0.5, 2.0}, 3.0f)};
    scene.cameras[0].fovYRadians = 0.8;
    return scene;
}

class OnePaint : public test::GlTest {};

TEST_F(OnePaint, aBallIsAsBrightInACoarseLayoutAsInFp32) {
    test::Random random(31);
    for (int i = 0; i < 16; ++i) {
        scenes::Scene scene = ballOf(randomPaint(random));
        const bool varies = i % 2 == 1;
        if (varies) vary(scene, random);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {320, 320};
        const Picture exact = engine::toPicture(renderer.render(Technique::Deferred, settings));
        for (const frame::LayoutInfo& layout : frame::layoutTable().subspan(1)) {
            settings.layout = layout.layout;
            const Picture coarse = engine::toPicture(renderer.render(Technique::Deferred, settings));
            const validation::ErrorFigures figures = validation::errorFigures(coarse, exact);
            SCOPED_TRACE(fmt::format("paint {} {}", i, layout.name));
            fmt::print("paint {}{} {}: bias {:.2e}, relMse {:.2e}, p99.9 {:.2e}\n", i, varies ? " varying" : "",
                       layout.name, figures.bias, figures.relMse, figures.p999Rel);
            EXPECT_GT(figures.litShare, 0.1);
            EXPECT_LE(std::abs(figures.bias), 1e-4);
        }
    }
}

} // namespace
} // namespace tessera
