// Cones that are narrow or have a hard edge, against the reference.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"
#include "validation/ErrorFigures.h"
#include "validation/ReferencePicture.h"
#include "validation/Rendering.h"

namespace tessera {
namespace {

using recipes::Technique;

struct Cone {
    double innerDegrees, outerDegrees;
};

class LightCones : public test::GlTest {
protected:
    /// A spot 2 m before a wall, seen so closely that its light fills three quarters of the picture.
    static scenes::Scene spotOnWall(const Cone& cone) {
        constexpr double kDegree = std::numbers::pi / 180.0, kMetres = 2.0;
        scenes::Material material;
        material.model = scenes::MaterialModel::Lambert;
        scenes::Scene scene = test::quadScene(material);
        scenes::Light spot = test::pointLight({0.0, 0.0, kMetres}, 100.0f);
        spot.type = scenes::LightType::Spot;
        spot.innerConeRadians = float(cone.innerDegrees * kDegree);
        spot.outerConeRadians = float(cone.outerDegrees * kDegree);
        scene.lights = {spot};
        const double radiusMetres = kMetres * std::tan(cone.outerDegrees * kDegree);
        const double eyeMetres = scene.cameras[0].worldFromCamera[3].z;
        scene.cameras[0].fovYRadians = 2.0 * std::atan(1.02 * radiusMetres / eyeMetres);
        return scene;
    }
};

TEST_F(LightCones, aNarrowOrHardConeIsAlwaysThatOfTheReference) {
    for (const Cone cone : {Cone{0.0, 0.1}, Cone{0.0, 0.5}, Cone{0.0, 1.0}, Cone{0.0, 5.0}, Cone{9.9, 10.0},
                            Cone{0.05, 0.1}, Cone{0.9, 1.0}, Cone{0.0, 20.0}, Cone{20.0, 20.0}}) {
        SCOPED_TRACE(fmt::format("{} to {} degrees", cone.innerDegrees, cone.outerDegrees));
        const scenes::Scene scene = spotOnWall(cone);
        frame::FrameSettings settings;
        settings.sizePixels = {160, 160};
        settings.filter = frame::TextureFilter::Exact;
        recipes::Renderer renderer(context(), scene);
        const validation::Picture truth = validation::referencePicture(scene, settings).picture;
        for (const recipes::TechniqueInfo& technique : recipes::techniqueTable()) {
            const validation::ErrorFigures figures =
                validation::errorFigures(validation::toPicture(renderer.render(technique.technique, settings)), truth);
            fmt::print("{} to {} degrees, {}: p99.9 {:.1e}, relMse {:.1e}, largest {:.1e}\n", cone.innerDegrees,
                       cone.outerDegrees, technique.name, figures.p999Rel, figures.relMse, figures.maxRel);
            EXPECT_EQ(figures.compared, 160u * 160u);
            EXPECT_GT(figures.litShare, 0.5);
            EXPECT_LE(figures.p999Rel, 3e-4); // what every picture is held to (docs/reference.md)
        }
    }
}

} // namespace
} // namespace tessera
