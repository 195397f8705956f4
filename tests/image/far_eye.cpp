// A distant eye with a narrow lens, and a light close to a surface: positions must keep their digits.
#include <functional>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/Limits.h"
#include "tests/image/ImageTest.h"
#include "validation/compare/ShownTriangles.h"
#include "validation/figures/ErrorFigures.h"
#include "validation/figures/Tolerance.h"
#include "validation/stress/StressScene.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

constexpr Technique kTechniques[] = {Technique::Forward, Technique::Deferred, Technique::ClusteredDeferred,
                                     Technique::DeferredVolumes};

class FarEye : public ImageTest {
protected:
    /// Expects 99.9 % of each technique's pixels within `p999Rel` of the reference, and all techniques to agree.
    void expectAgreement(const std::string& what, const scenes::Scene& scene, double p999Rel) {
        SCOPED_TRACE(what);
        engine::Renderer renderer(context(), scene);
        const validation::ReferencePicture truth = validation::referencePicture(scene, settings_);
        const std::vector<std::uint8_t> excluded = validation::shownTriangles(renderer, settings_, truth.ids).excluded;
        std::vector<float> first;
        for (const Technique technique : kTechniques) {
            const engine::RenderedFrame frame = renderer.render(technique, settings_);
            const validation::ErrorFigures figures =
                validation::errorFigures(engine::toPicture(frame), truth.picture, excluded);
            if (first.empty()) {
                first = frame.radiance;
                fmt::print("{:<28} p99.9 {:.1e}  relMse {:.1e}  max {:.1e}  excluded {:.2f} %\n", what, figures.p999Rel,
                           figures.relMse, figures.maxRel, 100.0 * figures.excluded);
            }
            EXPECT_TRUE(frame.radiance == first) << infoOf(technique).name;
            EXPECT_LE(figures.p999Rel, p999Rel) << infoOf(technique).name;
            EXPECT_GE(figures.litShare, 0.3); // visible surfaces fill at least a third of the image
            EXPECT_LT(figures.excluded, 0.02);
        }
    }

    static scenes::Scene floorUnderLamp(double eyeMetres, double lampMetres) {
        scenes::Scene scene = validation::stressFarFloor(eyeMetres);
        // Not at a point that the centre of a pixel shows.
        scene.lights = {validation::stressLight({0.013, lampMetres, 0.007}, 1.0f)};
        return scene;
    }

    frame::FrameSettings settings_ = [] {
        frame::FrameSettings settings = ofSize(160, 90);
        settings.display = false;
        return settings;
    }();
};

/// The tolerance of images without textures (docs/reference.md).
constexpr double kBar = 3e-4;

TEST_F(FarEye, aFloorUnderALampLooksAsInTheReferenceFromAnyDistance) {
    for (const double eyeMetres : {10.0, 1e3, 1e4, 1e5})
        for (const frame::LightingSpace space : {frame::LightingSpace::World, frame::LightingSpace::View}) {
            settings_.space = space;
            expectAgreement(fmt::format("a floor from {:g} m", eyeMetres), floorUnderLamp(eyeMetres, 0.2), kBar);
        }
}

/// Depths depend only on the visible part of a plain that extends far beyond the image. Its corners are rounded to
/// 2^-24 of its width, and so is the lamp's distance, by whose square the light falls off.
TEST_F(FarEye, aFloorInAWidePlainLooksAsInTheReferenceFromAnyDistance) {
    for (const double eyeMetres : {1e3, 1e4}) {
        const double plainMetres = 4.0 * eyeMetres;
        scenes::Scene scene = floorUnderLamp(eyeMetres, 0.2);
        scenes::Node plain = scene.nodes[0];
        plain.parentFromNode = glm::translate(glm::dmat4(1.0), {0.0, -0.05, 0.0}) * plain.parentFromNode *
                               glm::scale(glm::dmat4(1.0), glm::dvec3(plainMetres));
        scene.nodes.push_back(plain);
        expectAgreement(fmt::format("a plain from {:g} m", eyeMetres), scene,
                        std::max(kBar, 2.0 * 0x1p-24 * plainMetres / 0.2));
    }
}

TEST_F(FarEye, aBallWithThreeHundredLightsLooksAsInTheReferenceFromAKilometre) {
    expectAgreement("a ball, 300 lights", validation::stressFarBall(1e3, 300), kBar);
}

TEST_F(FarEye, aLightAMillimetreAboveAFloorLooksAsInTheReference) {
    expectAgreement("a light 1 mm above, 10 m", floorUnderLamp(10.0, 1e-3), kBar);
    expectAgreement("a light 1 mm above, 1 km", floorUnderLamp(1e3, 1e-3), kBar);
}

/// A floor that ends near the eye extends the depth range to there. A position may be off by 4 * 2^-24 of the distance;
/// the limit is twice that over the lamp's distance (docs/numerics.md).
TEST_F(FarEye, aLightAMillimetreAboveAWideFloorKeepsTheDigitsThatDepthHas) {
    scenes::Scene scene = floorUnderLamp(10.0, 1e-3);
    scene.nodes[0].parentFromNode = glm::scale(scene.nodes[0].parentFromNode, glm::dvec3(30.0));
    expectAgreement("a light 1 mm above 30 m", scene, 2.0 * 4.0 * 0x1p-24 * 10.0 / 1e-3);
}

TEST_F(FarEye, parallelRaysSeeAFloorAsInTheReferenceFromAnyDistance) {
    for (const double eyeMetres : {10.0, 1e4}) {
        scenes::Scene scene = floorUnderLamp(eyeMetres, 0.2);
        makeOrthographic(scene.cameras[0], 0.45);
        expectAgreement(fmt::format("parallel rays, {:g} m", eyeMetres), scene, kBar);
    }
}

/// Deferred lighting covers only pixels within the draws' bounding boxes; rounding may move geometry beyond them.
TEST_F(FarEye, deferredLightsEveryPixelOfWhatRoundingMoves) {
    // The quad's left half fills half of the image; one ulp of its world position is an eighth of its side.
    scenes::Scene farOff = quadScene({});
    const double side = 1e-3, placeMetres = -1e12;
    farOff.nodes[0].parentFromNode =
        glm::translate(glm::dmat4(1.0), {placeMetres, 0.0, 0.0}) * glm::scale(glm::dmat4(1.0), glm::dvec3(side));
    farOff.cameras[0].worldFromCamera = glm::translate(glm::dmat4(1.0), {placeMetres + side, 0.0, 4.0 * side});
    farOff.cameras[0].nearMetres = 1e-4;
    farOff.cameras[0].fovYRadians = glm::radians(1.0);
    // Matrix columns that cancel: x is 0.3 (a - b) of coordinates a and b near 1e6.
    scenes::Scene sheared = quadScene({});
    for (glm::vec3& position : sheared.meshes[0].positionsOS)
        position = {1e6f + 0.0625f * (position.x > 0.0f ? 1.0f : 0.0f), 1e6f, 0.01f * position.y};
    sheared.nodes[0].parentFromNode = {
        {0.3, 0.0, 1e-6, 0.0}, {-0.3, 0.0, 1e-6, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0, 0, 0, 1}};
    sheared.cameras[0].worldFromCamera = glm::translate(glm::dmat4(1.0), {0.0, 0.0, 2.3});
    sheared.cameras[0].nearMetres = 0.01;
    sheared.cameras[0].fovYRadians = glm::radians(30.0);
    for (scenes::Scene& scene : {std::ref(farOff), std::ref(sheared)}) {
        for (scenes::Material& material : scene.materials) material.doubleSided = true;
        scene.background = {0.0f, 0.0f, 0.4f};
        scenes::Light light;
        light.type = scenes::LightType::Directional;
        scene.lights = {light};
        engine::Renderer renderer(context(), scene);
        for (const scenes::Projection projection :
             {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
            SCOPED_TRACE(&scene == &farOff ? "far off" : "sheared");
            scene.cameras[0].projection = projection;
            scene.cameras[0].halfHeightMetres = &scene == &farOff ? 3e-5 : 0.6;
            const std::vector<float> truth = renderer.render(Technique::Forward, settings_).radiance;
            const std::ptrdiff_t background = std::ranges::count(truth, 0.4f);
            EXPECT_TRUE(background > 0 && background < std::ssize(truth) / 4) << "both are seen, quad and background";
            for (const Technique technique :
                 {Technique::Deferred, Technique::TiledDeferred, Technique::DeferredVolumes})
                EXPECT_TRUE(renderer.render(technique, settings_).radiance == truth) << infoOf(technique).name;
        }
    }
}

/// The limits of scenes/Limits.h.
TEST_SWEEP(FarEye, techniquesAgreeAtTheLimitsOfLengths) {
    std::size_t turn = 0;
    scenes::Scene near = everythingScene();
    near.cameras[0].nearMetres = scenes::kNearestPlaneMetres;
    scenes::Scene vast = everythingScene();
    const double scale = 0.05 * scenes::kFarthestMetres; // the scene is some 20 m wide
    for (scenes::Node& node : vast.nodes)
        if (node.parent == scenes::kNone)
            node.parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * node.parentFromNode;
    for (scenes::Light& light : vast.lights) {
        light.positionWS *= scale;
        light.rangeMetres *= float(scale);
        light.intensity = std::min(1e30f, light.intensity * float(scale * scale));
    }
    vast.cameras[0].worldFromCamera[3] = glm::dvec4(scale * glm::dvec3(vast.cameras[0].worldFromCamera[3]), 1.0);
    vast.cameras[0].nearMetres *= scale;
    scenes::Scene both = vast;
    both.cameras[0].nearMetres = scenes::kNearestPlaneMetres;
    for (const scenes::Scene& scene : {near, vast, both}) {
        SCOPED_TRACE(scene.cameras[0].nearMetres);
        scenes::checkScene(scene);
        engine::Renderer renderer(context(), scene);
        const engine::RenderedFrame truth = renderer.render(Technique::Forward, settings_);
        int lit = 0;
        for (std::size_t i = 0; i < truth.radiance.size(); i += 4) lit += truth.radiance[i] > 0.0f;
        EXPECT_GT(lit, 160 * 90 / 4);
        for (const Technique technique : techniquesInTurn(turn++))
            EXPECT_TRUE(renderer.render(technique, settings_).radiance == truth.radiance) << infoOf(technique).name;
    }
}

} // namespace
} // namespace tessera
