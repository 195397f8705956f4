// Diffused irradiance in frames: techniques, pruning, shadows, cost.
#include <numeric>
#include <tuple>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "tests/image/DiffusionTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::SubsurfaceMethod;
using namespace test;
using testing::HasSubstr;
namespace builtin = scenes::builtin;

class Diffusion : public DiffusionTest {};
using DiffusionSlow = Diffusion;

TEST_SWEEP(Diffusion, everyTechniqueGivesTheSamePictureToTheLastBit) {
    scenes::Scene head = scenes::loadScene("head");
    head.materials[0].subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    scenes::Scene gold = head;
    gold.materials[0].model = scenes::MaterialModel::MetallicRoughness;
    gold.materials[0].metallic = 0.4f;
    gold.materials[0].clearcoat = 0.5f;
    gold.materials[0].sheenColor = glm::vec3(0.3f, 0.2f, 0.1f);
    scenes::Scene glass = head;
    glass.materials[0].alphaMode = scenes::AlphaMode::Blend;
    glass.materials[0].baseColor.a = 0.6f;
    const std::tuple<const scenes::Scene*, frame::ShadowFilter, frame::TextureFilter, int> cases[] = {
        {&head, frame::ShadowFilter::Traced, frame::TextureFilter::Exact, 1},
        {&gold, frame::ShadowFilter::Pcf, frame::TextureFilter::Hardware, 1},
        {&glass, frame::ShadowFilter::Traced, frame::TextureFilter::Hardware, 4},
    };
    std::size_t turn = 0;
    for (const auto& [scene, shadows, texture, samples] : cases) {
        engine::Renderer renderer(context(), *scene);
        frame::FrameSettings settings = withDiffusion(withSamples(ofSize(96, 54), samples), 64);
        settings.shadowFilter = shadows;
        settings.filter = texture;
        expectParity(renderer, settings, techniquesInTurn(turn++, samples));
    }
}

TEST_F(Diffusion, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    scenes::Scene ball = sphereScene(0.03, 12);
    for (scenes::Light& light : ball.lights) light.castsShadow = true;
    frame::FrameSettings settings = withDiffusion(ofSize(160, 90), 128);
    engine::Renderer renderer(context(), ball);
    expectPruningIsUnseen(renderer, settings);
}

TEST_F(DiffusionSlow, whatDiffusionCosts) {
    scenes::Scene scene = scenes::loadScene("head_skin");
    engine::Renderer renderer(context(), scene);
    renderer.backend().setProfiling(true);
    frame::FrameSettings settings;
    // Frame 1 relights everything visible, frame 2 only what a nearer camera reveals, frame 3 nothing.
    double lit = 0.0;
    for (int frame = 0; frame < 4; ++frame) {
        if (frame == 1) scene.lights[0].intensity *= 1.1f;
        if (frame == 2) settings.camera = 1;
        renderer.render(Technique::Deferred, settings);
        double diffusing = 0.0, all = 0.0;
        for (const gpu::PassTiming& timing : renderer.backend().passTimings()) {
            const double ms = timing.gpuMs.value_or(timing.cpuMs);
            if (timing.name.starts_with("diffusion")) {
                fmt::print("{}: {:.1f} ms\n", timing.name, ms);
                diffusing += ms;
            }
            all += ms;
        }
        fmt::print("frame {}: diffusion {:.1f} of {:.1f} ms\n", frame, diffusing, all);
        if (frame == 1) lit = diffusing;
        if (frame == 2) {
            EXPECT_LE(diffusing, 0.1 * lit);
        }
        if (frame == 3) {
            EXPECT_EQ(diffusing, 0.0);
        }
    }
}

TEST_F(Diffusion, mapsHideLightFromTexelsAsRaysDo) {
    const scenes::Scene scene = stepScene();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = stepSettings(256);
    settings.shadowMaps.resolutionTexels = 2048;

    for (const frame::ShadowFilter filter : mapFilters()) {
        settings.shadowFilter = filter;
        const double error = errorOf(pictureOf(renderer, settings), scene.cameras[0], stepAt).l2;
        fmt::print("{}: {:.2e}\n", infoOf(filter).name, error);
        EXPECT_LE(error, 0.03) << infoOf(filter).name;
    }
}

// A round ball does not shadow its texels whose normal faces the light, though its triangles do.
TEST_F(Diffusion, texelsOfACoarseBallAreShadowedAsTheRoundBallThatItApproximates) {
    scenes::Scene ball = sphereScene(0.03, 8);
    ball.materials[0].subsurface.absorptionPerMillimetre = glm::vec3(1e3f); // no transmission
    ball.lights[0].directionWS = glm::normalize(glm::dvec3(-1.0, -0.5, 0.4));
    scenes::Mesh& mesh = ball.meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t c) { return mesh.positionsOS[mesh.indices[i + c]]; };
        const glm::vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        if (glm::dot(normal, corner(0)) < 0.0f)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]); // half of the charts are wound the other way
    }
    frame::FrameSettings settings = withDiffusion(ofSize(96, 54), 256);
    engine::Renderer renderer(context(), ball);
    const auto lightOf = [&](engine::Renderer& from) { return pictureOf(from, settings).rgba; };
    const std::vector<float> open = lightOf(renderer);
    settings.shadows = kAllLightsCast;
    double lost[2] = {};
    for (const auto terminator : {frame::ShadowTerminator::Exact, frame::ShadowTerminator::Softened}) {
        settings.shadowTerminator = terminator;
        engine::Renderer fresh(context(), ball);
        const std::vector<float> seen = lightOf(fresh);
        EXPECT_TRUE(lightOf(renderer) == seen) << "light is kept that another terminator hides";
        for (std::size_t i = 0; i < open.size(); i += 4)
            lost[int(terminator)] += std::abs(double(seen[i]) - double(open[i]));
    }
    double all = 0.0;
    for (std::size_t i = 0; i < open.size(); i += 4) all += double(open[i]);
    fmt::print("{:.2e} of the light is lost, softened {:.2e}\n", lost[0] / all, lost[1] / all);
    EXPECT_GT(lost[0], 1e-4 * all);
    EXPECT_LT(lost[1], 0.5 * lost[0]); // measured 0.31: points beside vertices are lifted by less than rounding
}

// Cut-outs of casters; the lit object itself has none.
TEST_F(Diffusion, holesOfCastersLetLightThrough) {
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        scenes::Scene ball = sphereScene(0.03, 12);
        for (scenes::Light& light : ball.lights) light.castsShadow = true;
        scenes::Mesh plate = quad();
        for (glm::vec3& position : plate.positionsOS) position = 0.05f * position;
        ball.meshes.push_back(plate);
        scenes::Material opaque;
        opaque.doubleSided = true;
        opaque.baseColor.a = 0.25f;
        ball.materials.push_back(opaque);
        scenes::Node& node = ball.nodes.emplace_back();
        node.parentFromNode[3] = glm::dvec4(0.08 * glm::normalize(-ball.lights[0].directionWS), 1.0);
        node.instances = {{1, 1}};
        frame::FrameSettings settings = withDiffusion(ofSize(160, 90), 128);
        settings.shadowFilter = filter;
        engine::Renderer renderer(context(), ball);
        const std::vector<float> hidden = renderer.render(Technique::Deferred, settings).radiance;
        // The whole plate is a cut-out now, the first one of the scene.
        ball.materials[1].alphaMode = scenes::AlphaMode::Mask;
        ball.materials[1].alphaCutoff = 0.5f;
        renderer.materialsChanged();
        const std::vector<float> lit = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_NE(lit, hidden) << infoOf(filter).name;
        EXPECT_EQ(lit, drawn(ball, settings));
        ball.nodes.pop_back();
        const std::vector<float> without = drawn(ball, settings);
        const auto sumOf = [](const std::vector<float>& radiance) {
            return std::accumulate(radiance.begin(), radiance.end(), 0.0);
        };
        EXPECT_NEAR(sumOf(lit), sumOf(without), 0.01 * sumOf(without)) << infoOf(filter).name;
        EXPECT_LT(sumOf(hidden), 0.9 * sumOf(lit)) << infoOf(filter).name;
    }
}

TEST_F(Diffusion, objectsThatCannotBeUnwrappedAreRefusedByName) {
    scenes::Scene scene = ballUnderSun();
    scene.materials[std::size_t(scene.nodes[0].instances[0].material)].subsurface.method =
        SubsurfaceMethod::TextureSpaceDiffusion;
    scenes::Mesh& mesh = scene.meshes[std::size_t(scene.nodes[0].instances[0].mesh)];
    mesh.name = "ball";
    for (glm::vec2& texCoord : mesh.texCoords[0]) texCoord.x = std::abs(texCoord.x - 0.5f);
    engine::Renderer renderer(context(), scene);
    EXPECT_THAT([&] { renderer.draw(Technique::Deferred, {}); },
                testing::ThrowsMessage<InputError>(
                    testing::AllOf(HasSubstr("mesh 'ball'"), HasSubstr("unwrap it so that none overlap"))));
}

} // namespace
} // namespace tessera
