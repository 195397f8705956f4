// Cones that are narrow or have a hard edge, against the reference.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/Rendering.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;

struct Cone {
    double innerDegrees, outerDegrees;
};

class LightCones : public test::GlTest {
protected:
    /// A spot 2 m before a wall that it meets squarely, seen so closely that its light fills three quarters of the
    /// picture. `worldFromLight` turns all of it about the origin.
    static scenes::Scene spotOnWall(const Cone& cone, const glm::dmat4& worldFromLight) {
        constexpr double kDegree = std::numbers::pi / 180.0, kMetres = 2.0;
        scenes::Material material;
        material.model = scenes::MaterialModel::Lambert;
        scenes::Scene scene = test::quadScene(material);
        scenes::Light spot = test::pointLight(glm::dvec3(worldFromLight * glm::dvec4(0.0, 0.0, kMetres, 1.0)), 100.0f);
        spot.type = scenes::LightType::Spot;
        spot.directionWS = glm::dmat3(worldFromLight) * spot.directionWS;
        spot.innerConeRadians = float(cone.innerDegrees * kDegree);
        spot.outerConeRadians = float(cone.outerDegrees * kDegree);
        scene.lights = {spot};
        const double radiusMetres = kMetres * std::tan(cone.outerDegrees * kDegree);
        scenes::Camera& camera = scene.cameras[0];
        camera.fovYRadians = 2.0 * std::atan(1.02 * radiusMetres / camera.worldFromCamera[3].z);
        camera.worldFromCamera = worldFromLight * camera.worldFromCamera;
        for (scenes::Node& node : scene.nodes) node.parentFromNode = worldFromLight * node.parentFromNode;
        return scene;
    }

    void expectTheReferences(const Cone& cone, const glm::dmat4& worldFromLight, double p999RelAtMost) {
        SCOPED_TRACE(fmt::format("{} to {} degrees", cone.innerDegrees, cone.outerDegrees));
        const scenes::Scene scene = spotOnWall(cone, worldFromLight);
        frame::FrameSettings settings;
        settings.sizePixels = {160, 160};
        settings.filter = frame::TextureFilter::Exact;
        engine::Renderer renderer(context(), scene);
        const Picture truth = validation::referencePicture(scene, settings).picture;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            const validation::ErrorFigures figures =
                validation::errorFigures(engine::toPicture(renderer.render(technique.technique, settings)), truth);
            fmt::print("{} to {} degrees, {}: p99.9 {:.1e}, relMse {:.1e}, largest {:.1e}\n", cone.innerDegrees,
                       cone.outerDegrees, technique.name, figures.p999Rel, figures.relMse, figures.maxRel);
            EXPECT_EQ(figures.compared, 160u * 160u);
            EXPECT_GT(figures.litShare, 0.5);
            EXPECT_LE(figures.p999Rel, p999RelAtMost);
        }
    }
};

constexpr double kEveryPicture = 3e-4; // tolerance of the 99.9th percentile (docs/reference.md)

TEST_F(LightCones, aNarrowOrHardConeIsThatOfTheReference) {
    for (const Cone cone : {Cone{0.0, 0.1}, Cone{0.0, 0.5}, Cone{0.0, 1.0}, Cone{0.0, 5.0}, Cone{9.9, 10.0},
                            Cone{0.05, 0.1}, Cone{0.9, 1.0}, Cone{0.0, 20.0}, Cone{20.0, 20.0}})
        expectTheReferences(cone, glm::dmat4(1.0), kEveryPicture);
}

/// The angle from the axis is off by the rounding of ray and axis to fp32, 2e-7 rad, in any direction.
TEST_F(LightCones, anObliqueNarrowConeKeepsTheDigitsThatItsRayHas) {
    const glm::dmat4 oblique = glm::rotate(glm::dmat4(1.0), 2.1, glm::normalize(glm::dvec3(0.36, 0.48, 0.8)));
    for (const double outerDegrees : {0.1, 0.5, 1.0, 5.0, 20.0})
        expectTheReferences({0.0, outerDegrees}, oblique, std::max(kEveryPicture, 7e-4 / outerDegrees));
}

} // namespace
} // namespace tessera
