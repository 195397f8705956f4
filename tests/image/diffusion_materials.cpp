// Entering and leaving light by albedo, material model and side of the light, against closed forms.

#include "scenes/builtin/Pictures.h"
#include "tests/image/DiffusionTest.h"

namespace tessera {
namespace {

using scenes::SubsurfaceMethod;
using namespace test;
namespace builtin = scenes::builtin;

/// Settings of the step without the shadows of plates: a square under its sun.
frame::FrameSettings squareSettings(int side) {
    return withoutShadows(stepSettings(side));
}

/// A surface of two colours under uniform light. Entering light is multiplied by one power of the albedo and diffused;
/// leaving light is multiplied by the other power. With the powers swapped, the red channel beside the edge is half as
/// bright again.
TEST_F(DiffusionTruth, albedoCountsBeforeAndAfterDiffusionByItsShares) {
    const glm::dvec3 dark(0.2, 0.3, 0.5), bright(0.9, 0.8, 0.7);
    scenes::Scene scene = stepScene();
    scenes::Mesh& mesh = scene.meshes[0];
    const scenes::Mesh square = mesh;
    mesh = {};
    mesh.name = square.name;
    for (const double side : {-0.5, 0.0}) {
        const double x = builtin::kTruthEdgeX + side;
        scenes::builtin::appendQuad(mesh, {x, 0.0, 0.5}, {x + 0.5, 0.0, 0.5}, {x + 0.5, 0.0, -0.5}, {x, 0.0, -0.5});
        mesh.colors.resize(mesh.positionsOS.size(), glm::vec4(side < 0.0 ? dark : bright, 1.0));
    }
    mapTexture(scene, glm::dmat2(1.0));
    engine::Renderer renderer(context(), scene);
    for (const float before : {0.25f, 1.0f, 0.0f}) {
        for (scenes::Material& material : scene.materials) material.subsurface.preScatterShare = before;
        renderer.materialsChanged();
        const auto truth = [&](const glm::dvec3& placeWS) {
            const double beyond = placeWS.x - builtin::kTruthEdgeX;
            const glm::dvec3 entersDark = glm::pow(dark, glm::dvec3(before));
            const glm::dvec3 entersBright = glm::pow(bright, glm::dvec3(before));
            return glm::pow(beyond > 0.0 ? bright : dark, glm::dvec3(1.0 - before)) *
                   (entersDark + (entersBright - entersDark) * builtin::diffusedStep(beyond));
        };
        const double error = errorOf(pictureOf(renderer, squareSettings(512)), scene.cameras[0], truth).l2;
        fmt::print("{} of the albedo before: {:.2e}\n", before, error);
        EXPECT_LE(error, 2.5e-3) << before; // the limit of a step, whose contrast is larger
    }
}

/// At 128 texels, pixels reflect 70 % of the narrowest Gaussian undiffused; at 256, all of it is diffused. At an
/// intensity of pi, a BRDF of 1 / pi without a dielectric lobe equals lambert.
TEST_F(DiffusionTruth, metallicRoughnessDiffusesAStepAsTheClosedFormSays) {
    const auto asMetallicRoughness = [](scenes::Scene& scene) {
        for (scenes::Material& material : scene.materials) {
            material.model = scenes::MaterialModel::MetallicRoughness;
            material.metallic = material.specularFactor = 0.0f;
        }
        scene.lights[0].intensity = float(std::numbers::pi);
    };
    EXPECT_LE(stepError(256, asMetallicRoughness).l2, 6.5e-3);
    EXPECT_LE(stepError(128, asMetallicRoughness).l2, 0.017);
}

/// Uniform light from straight above, viewed from there: at cosines of 1 the Fresnel factor is F0, metallic times the
/// colour without a dielectric lobe. For diffused light, for light that pixels reflect, and for both.
TEST_F(DiffusionTruth, metalsReflectDiffuselyWhatTheFresnelFactorLeaves) {
    const glm::dvec3 color(0.6, 0.4, 0.8);
    constexpr double kMetallic = 0.4;
    scenes::Scene scene = stepScene();
    for (scenes::Material& material : scene.materials) {
        material.model = scenes::MaterialModel::MetallicRoughness;
        material.baseColor = glm::vec4(color, 1.0);
        material.metallic = float(kMetallic);
        material.specularFactor = 0.0f;
    }
    frame::FrameSettings settings = squareSettings(256);
    settings.sizePixels = {64, 8};
    settings.specular = false;
    const double scale = double(scene.materials[0].subsurface.scaleMetres);
    for (const double texels : {1e-3, 0.3, 8.0}) {
        for (scenes::Material& material : scene.materials)
            material.subsurface.profile = {{float(std::pow(1e3 * scale * texels / 224.0, 2.0)), glm::vec3(1.0f)}};
        const Picture picture = pictureOf(scene, settings);
        for (std::size_t i = 0; i < picture.pixelCount(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double wanted = (1.0 - kMetallic * color[c]) * (1.0 - kMetallic) * color[c] / std::numbers::pi;
                ASSERT_NEAR(double(picture.pixel(i)[c]), wanted, 1e-4 * wanted) << texels << " texels, pixel " << i;
            }
    }
}

/// Diffused light leaves by the Fresnel factor of the viewing angle, whatever its entry angle: at this grazing angle a
/// third of the radiance straight up. For metallic_roughness with F0 and F90 of the metallic part, as above, and a sun
/// straight above, whose light enters by F0.
TEST_F(DiffusionTruth, diffusedLightLeavesByTheFresnelFactorOfTheViewersAngle) {
    constexpr double kColor = 0.5, kMetallic = 0.4, kCosine = 0.15;
    scenes::Scene scene = stepScene();
    const double scale = double(scene.materials[0].subsurface.scaleMetres);
    for (scenes::Material& material : scene.materials) {
        material.model = scenes::MaterialModel::MetallicRoughness;
        material.baseColor = glm::vec4(glm::vec3(float(kColor)), 1.0f);
        material.metallic = float(kMetallic);
        material.specularFactor = 0.0f;
        material.subsurface.profile = {{float(std::pow(1e3 * scale * 8.0 / 224.0, 2.0)), glm::vec3(1.0f)}};
    }
    const glm::dvec3 middle(builtin::kTruthEdgeX, 0.0, 0.0), toViewer(std::sqrt(1.0 - kCosine * kCosine), kCosine, 0.0);
    scene.cameras[0].worldFromCamera = scenes::worldFromLookAt(middle + toViewer, middle);
    frame::FrameSettings settings = squareSettings(128);
    settings.sizePixels = {8, 8};
    settings.specular = false;
    const Picture picture = pictureOf(scene, settings);
    const double straight = kMetallic * kColor;
    const double factor = straight + (kMetallic - straight) * std::pow(1.0 - kCosine, 5.0);
    const double wanted = (1.0 - factor) * (1.0 - kMetallic) * kColor / std::numbers::pi;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i)
        ASSERT_NEAR(double(picture.pixel(i)[0]), wanted, 1e-3 * wanted) << i;
}

/// Under uniform light, viewed along the normal, diffusion changes nothing: below a coat, for an area light as wide as
/// it is far, and for an environment.
TEST_F(DiffusionTruth, evenLightOfEveryKindLeavesAsWithoutDiffusion) {
    struct Case {
        const char* name;
        std::function<void(scenes::Scene&)> change;
        double most;
    };
    const Case cases[] = {
        {"sun below a coat",
         [](scenes::Scene& scene) {
             for (scenes::Material& material : scene.materials) {
                 material.model = scenes::MaterialModel::MetallicRoughness;
                 material.metallic = 0.2f;
                 material.clearcoat = 0.7f;
             }
         },
         1e-4},
        {"a disk",
         [](scenes::Scene& scene) {
             scenes::Light& light = scene.lights[0];
             light.type = scenes::LightType::Disk;
             light.positionWS = glm::dvec3(builtin::kTruthEdgeX, 1000.0, 0.0);
             light.directionWS = {0.0, -1.0, 0.0};
             light.radiusMetres = 1000.0f;
         },
         1e-3},
        {"an environment",
         [](scenes::Scene& scene) {
             scene.lights.clear();
             scene.environment = scenes::Environment{"even", scenes::builtin::drawRadiance("even", 1, 1, [](int, int) {
                                                         return glm::dvec3(0.5, 1.0, 2.0);
                                                     })};
         },
         1e-3},
    };
    for (const Case& one : cases) {
        scenes::Scene scene = stepScene();
        one.change(scene);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = squareSettings(128);
        settings.sizePixels = {64, 8};
        settings.specular = false;
        const Picture diffused = pictureOf(renderer, settings);
        settings.subsurface = SubsurfaceMethod::None;
        const Picture still = pictureOf(renderer, settings);
        for (std::size_t i = 0; i < still.pixelCount(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double wanted = double(still.pixel(i)[c]);
                ASSERT_GT(wanted, 0.0) << one.name;
                ASSERT_NEAR(double(diffused.pixel(i)[c]), wanted, one.most * wanted) << one.name << ", pixel " << i;
            }
    }
}

/// Layers attenuate entering light per pixel; texels have no layers. They give the same bits whether pruned or set to
/// zero.
TEST_F(DiffusionTruth, layersAreNoPartOfTheLightThatEnters) {
    scenes::Scene scene = stepScene();
    for (scenes::Material& material : scene.materials) {
        material.model = scenes::MaterialModel::MetallicRoughness;
        material.clearcoat = 0.7f;
        material.sheenColor = glm::vec3(0.8f);
        material.emissive = glm::vec3(0.1f);
    }
    const auto picture = [&](bool prune) {
        engine::Renderer renderer(context(), scene); // a new one without cached light
        frame::FrameSettings settings = squareSettings(128);
        settings.sizePixels = {64, 8};
        settings.prune = prune;
        return pictureOf(renderer, settings);
    };
    EXPECT_TRUE(picture(false).rgba == picture(true).rgba);
}

/// A slab of 10 mm in front of a sun: transmitted light is uniform for any diffusion width. For a Gaussian narrower
/// than texels it stays in the texels, since pixels reflect light from the front only.
TEST_F(DiffusionTruth, lightFromBehindDiffusesOverTheSideWhereItLeaves) {
    constexpr double kThickness = 0.01, kHalf = 0.05;
    scenes::Scene scene = stepScene();
    scenes::Mesh slab;
    scenes::builtin::appendQuad(slab, {-kHalf, -kHalf, 0.0}, {kHalf, -kHalf, 0.0}, {kHalf, kHalf, 0.0},
                                {-kHalf, kHalf, 0.0});
    scenes::builtin::appendQuad(slab, {kHalf, -kHalf, -kThickness}, {-kHalf, -kHalf, -kThickness},
                                {-kHalf, kHalf, -kThickness}, {kHalf, kHalf, -kThickness});
    // One chart per side.
    for (std::size_t i = 0; i < slab.positionsOS.size(); ++i) {
        const glm::vec2 place = (glm::vec2(slab.positionsOS[i]) / float(2.0 * kHalf) + 0.5f) * 0.4f + 0.05f;
        slab.texCoords[0][i] = i < 4 ? place : place + 0.5f;
    }
    scenes::Material skin = scene.materials[0];
    skin.castsShadow = true;
    skin.subsurface.scaleMetres = 1.0f;
    skin.subsurface.absorptionPerMillimetre = {0.02f, 0.04f, 0.08f};
    scene.meshes = {slab};
    scene.materials = {skin};
    scene.nodes.resize(1);
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.nodes[0].instances = {{0, 0}};
    scene.lights[0].directionWS = {0.0, 0.0, 1.0};
    scene.lights[0].castsShadow = true;
    scenes::Camera& camera = scene.cameras[0];
    camera.worldFromCamera = scenes::worldFromLookAt({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0});
    camera.halfHeightMetres = 0.6 * kHalf;
    frame::FrameSettings settings = withDiffusion(ofSize(32, 32), 256);
    for (const float squareMillimetres : {1e-6f, 0.1f, 25.0f}) {
        scene.materials[0].subsurface.profile = {{squareMillimetres, glm::vec3(1.0f)}};
        const Picture picture = pictureOf(scene, settings);
        for (std::size_t i = 0; i < picture.pixelCount(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double absorption = double(skin.subsurface.absorptionPerMillimetre[c]);
                const double wanted = std::exp(-absorption * 1e3 * kThickness);
                ASSERT_NEAR(double(picture.pixel(i)[c]), wanted, 1e-3 * wanted)
                    << squareMillimetres << " mm^2, pixel " << i;
            }
    }
}

} // namespace
} // namespace tessera
