// The GPU's picture against the reference renderer's, pixel by pixel, with the same filtering on both sides.
#include <fmt/format.h>

#include "scenes/Load.h"
#include "tests/image/FlatTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/ErrorFigures.h"
#include "validation/ReferencePicture.h"
#include "validation/TechniqueCompare.h"
#include "validation/reference/Texels.h"

namespace tessera {
namespace {

using recipes::Technique;
using scenes::TextureSlot;

class Reference : public test::GlTest {
protected:
    /// Forward alone: that the other techniques draw the same is the parity tests' business.
    std::vector<validation::ComparePair> compared(const scenes::Scene& scene, frame::FrameSettings settings) {
        settings.filter = frame::TextureFilter::Exact;
        recipes::Renderer renderer(context(), scene);
        validation::CompareRequest request;
        request.techniques = {Technique::Forward};
        request.against = validation::Reference{};
        request.settings = settings;
        return validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
    }

    void expectAgreement(const std::string& what, const scenes::Scene& scene, const frame::FrameSettings& settings) {
        // The second pair, where there are textures, is that of hardware filtering.
        for (const validation::ComparePair& pair : compared(scene, settings)) {
            SCOPED_TRACE(what + ", " + pair.a);
            const validation::ErrorFigures& figures = pair.figures;
            fmt::print("{:<24} {:<26} p99.9 {:.1e}  relMse {:.1e}  bias {:+.1e}  max {:.1e}  excluded {:.3f} %\n", what,
                       pair.a, figures.p999Rel, figures.relMse, figures.bias, figures.maxRel, 100.0 * figures.excluded);
            // The bars and their reasons are referenceTolerance()'s.
            EXPECT_TRUE(pair.tolerance.p999Rel && pair.tolerance.relMse && pair.tolerance.bias);
            EXPECT_TRUE(pair.verdict.ok) << testing::PrintToString(pair.verdict.missed);
            // Silhouettes: an edge moved by the rasteriser's 1/256 of a pixel, and triangles no larger than a pixel.
            EXPECT_LT(figures.excluded, 0.02);
        }
    }
};

frame::FrameSettings ofSize(int width, int height) {
    frame::FrameSettings settings;
    settings.sizePixels = {width, height};
    return settings;
}

TEST_F(Reference, everyBuiltinSceneAlwaysAgreesWithIt) {
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        const scenes::Scene scene = scenes::loadScene(std::string(builtin.name));
        expectAgreement(std::string(builtin.name), scene, ofSize(160, 90));
    }
}

using ReferenceSlow = Reference;

/// At the size at which the programs render by themselves: single pixels that miss by much are rare.
TEST_F(ReferenceSlow, everyBuiltinSceneAlwaysAgreesWithItAtTheDefaultSize) {
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes())
        expectAgreement(std::string(builtin.name), scenes::loadScene(std::string(builtin.name)), {});
}

TEST_F(Reference, aSceneOfEveryFeatureAlwaysAgreesWithIt) {
    scenes::Scene scene = test::everythingScene();
    expectAgreement("everything", scene, ofSize(161, 89));
    frame::FrameSettings settings = ofSize(160, 90);
    settings.specular = false;
    expectAgreement("everything, no specular", scene, settings);
    settings.specular = true;
    settings.rangeTolerance = 0.05;
    settings.timeSeconds = 1.5;
    expectAgreement("everything, tolerance", scene, settings);
    settings.rangeTolerance = 0.0;
    settings.soloLight = 1;
    settings.space = frame::LightingSpace::View;
    expectAgreement("everything, one light", scene, settings);
    scene.cameras[0].projection = scenes::Projection::Orthographic;
    scene.cameras[0].halfHeightMetres = 2.5;
    expectAgreement("everything, orthographic", scene, ofSize(161, 90));
    scene.cameras[0].farMetres = 20.0;
    expectAgreement("the same, far plane", scene, ofSize(161, 90));
}

TEST_F(Reference, aSceneFarFromTheOriginAlwaysAgreesWithIt) {
    scenes::Scene scene = test::everythingScene();
    const glm::dvec3 away(0x1p20, 0.0, -0x1p20);
    for (scenes::Node& node : scene.nodes) node.parentFromNode[3] += glm::dvec4(away, 0.0);
    for (scenes::Light& light : scene.lights) light.positionWS += away;
    scene.cameras[0].worldFromCamera[3] += glm::dvec4(away, 0.0);
    expectAgreement("everything at 2^20 m", scene, ofSize(160, 90));
}

/// Glass before glass before an opaque ball: each layer counts with its own weight.
TEST_F(Reference, transparentSurfacesOnTopOfEachOtherAlwaysAgreeWithIt) {
    scenes::Scene scene = test::everythingScene();
    const scenes::Material glass = scene.materials[std::size_t(scene.nodes.back().instances.front().material)];
    for (const double z : {0.5, 3.0, 1.25}) {
        scene.nodes.push_back(scene.nodes.back());
        scene.nodes.back().parentFromNode[3] = glm::dvec4(-0.2 * z, 0.3, z, 1.0);
        scene.nodes.back().instances.front().material = int(scene.materials.size());
        scene.materials.push_back(glass);
        scene.materials.back().baseColor.a = float(0.1 + 0.2 * z);
    }
    expectAgreement("panes of glass", scene, ofSize(160, 90));
}

/// One wrong number in a scene is found: here one light in a hundred of its strength.
TEST_F(Reference, aLightThatDiffersByOnePercentNeverPasses) {
    scenes::Scene scene = scenes::loadScene("room");
    frame::FrameSettings settings = ofSize(96, 54);
    const validation::ReferencePicture truth = validation::referencePicture(scene, settings);
    scene.lights[0].intensity *= 1.01f;
    recipes::Renderer renderer(context(), scene);
    const validation::Picture picture = validation::toPicture(renderer.render(Technique::Forward, settings));
    const validation::ErrorFigures figures =
        validation::errorFigures(picture, truth.picture, validation::differingTriangles(renderer, settings, truth.ids));
    EXPECT_FALSE(validation::checkTolerance(figures, validation::referenceTolerance(scene, settings.filter)).ok);
}

TEST_F(Reference, hardwareFilteringIsAlwaysAPairOfItsOwnAndHolds) {
    const scenes::Scene scene = test::everythingScene();
    recipes::Renderer renderer(context(), scene);
    validation::CompareRequest request;
    request.techniques = {Technique::Deferred, Technique::Forward};
    request.against = validation::Reference{};
    request.settings = ofSize(96, 54);
    request.settings.filter = frame::TextureFilter::Exact;
    const auto pairs = validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
    ASSERT_EQ(pairs.size(), 3u);
    EXPECT_EQ(pairs[2].a, validation::hardwareFilterName("deferred"));
    EXPECT_TRUE(pairs[2].tolerance.p999Rel && pairs[2].tolerance.relMse && pairs[2].tolerance.bias);
    EXPECT_TRUE(pairs[2].verdict.ok) << testing::PrintToString(pairs[2].verdict.missed);
    EXPECT_EQ(pairs[0].figures.relMse, pairs[1].figures.relMse); // one picture, whoever draws it
}

/// In whole scenes too, where little is minified and most of a pixel is not its texture.
TEST_F(Reference, aTextureWithoutItsSmallerLevelsNeverPassesAsHardwareFiltering) {
    const scenes::Scene scene = test::everythingScene();
    const test::ShaderMutant shaders;
    shaders.replace("lib/texture_filter.glsl", "texture(image, uv)", "textureLod(image, uv, 0.0)");
    recipes::Renderer renderer(context(), scene, shaders.tree());
    const frame::FrameSettings settings = ofSize(96, 54);
    const validation::Picture shown = validation::toPicture(renderer.render(Technique::Forward, settings));
    const validation::ReferencePicture truth = validation::referencePicture(scene, settings);
    const validation::ErrorFigures figures = validation::errorFigures(
        shown, truth.nearestTo(shown), validation::differingTriangles(renderer, settings, truth.ids));
    EXPECT_FALSE(validation::checkTolerance(figures, validation::referenceTolerance(scene, settings.filter)).ok);
}

class SrgbDecoding : public test::FlatTest {};

TEST_F(SrgbDecoding, everyCodeValueIsAlwaysDecodedToRounding) {
    frame::FrameSettings settings;
    settings.filter = frame::TextureFilter::Exact;
    for (int first = 0; first < 256; first += test::kSide * test::kSide) {
        const auto code = [first](int x, int y) { return first + y * test::kSide + x; };
        const scenes::Image image = test::image8([&](int x, int y) {
            return std::array<int, 4>{code(x, y), code(x, y), 0, 255};
        });
        const recipes::RenderedFrame shown =
            frame(test::texturedScene(flatScene(test::unlit()), TextureSlot::BaseColor, image), settings);
        for (int y = 0; y < test::kSide; ++y) {
            for (int x = 0; x < test::kSide; ++x) {
                const double wanted = reference::linearFromSrgb(code(x, y) / 255.0);
                // Six roundings of fp32, and neighbours that a coordinate's rounding lets in.
                EXPECT_NEAR(pixel(shown, x, y).r, wanted, 1e-6 * wanted + 1e-9) << code(x, y);
            }
        }
    }
}

} // namespace
} // namespace tessera
