// The refracted background of glass bodies: parity of techniques, bit-exactness without refraction, pruning, and the
// reference.

#include <gmock/gmock.h>

#include "base/Median.h"
#include "tests/image/GlassBehindTest.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using frame::Refraction;
using scenes::Scene;
using namespace test;

class GlassBehind : public GlassBehindTest {};
using GlassBehindSlow = GlassBehind;

/// Rays refracted once or offset, with blur levels and without, with one sample and with several. In a short sweep,
/// several samples and unpruned frames use one mode each.
TEST_SWEEP(GlassBehind, everyTechniqueShowsTheSameAndPruningChangesNoBit) {
    for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides, Refraction::BackFaces}) {
        SCOPED_TRACE(infoOf(refraction).name);
        Scene scene = fewWithGlass();
        scene.materials[1].thicknessMetres = 0.4f;
        scenes::builtin::appendSphere(scene.meshes.emplace_back(), {}, 1.0, 48, 24);
        scene.nodes[1].instances[0].mesh = 1;
        frame::FrameSettings settings = ofSize(96, 54);
        settings.refraction = refraction;
        {
            engine::Renderer renderer(context(), scene);
            expectParity(renderer, settings, techniquesInTurn(std::size_t(refraction)));
            settings.samples = 4;
            if (isWholeSweep() || refraction == Refraction::TwoSides)
                expectParity(renderer, settings, {Technique::ForwardPrepass, Technique::ClusteredForward});
            settings.samples = 1;
        }
        if (!isWholeSweep() && refraction != Refraction::BackFaces) continue;
        scene.materials[1].perceptualRoughness = 0.0f; // so that there are no blur levels
        engine::Renderer renderer(context(), scene);
        expectPruningIsUnseen(renderer, settings);
    }
}

/// An index of 1 does not refract: no bit differs with one sample, and a rounding with several, for both projections.
TEST_F(GlassBehind, thatBendsNothingShowsExactlyWhatStandsThere) {
    struct Case {
        Refraction refraction;
        scenes::Projection projection;
        int samples;
    };
    using scenes::Projection;
    for (const Case& one :
         {Case{Refraction::OneSide, Projection::Orthographic, 1},
          Case{Refraction::TwoSides, Projection::Perspective, 1}, Case{Refraction::OneSide, Projection::Perspective, 4},
          Case{Refraction::TwoSides, Projection::Orthographic, 4}}) {
        SCOPED_TRACE(fmt::format("{}, {} samples", infoOf(one.refraction).name, one.samples));
        Scene wall = checkedWall();
        wall.cameras[0].projection = one.projection;
        const frame::FrameSettings settings = seeing(one.refraction, one.samples);
        const std::vector<float> plain = drawn(wall, settings, Technique::Forward);
        const std::vector<float> shown =
            drawn(coveredByGlass(wall, bareGlass(1.0), kBehindTiltRadians), settings, Technique::Forward);
        ASSERT_EQ(shown.size(), plain.size());
        // With several samples each shows the mean of all: their sum may round once more.
        const float tolerance = one.samples == 1 ? 0.0f : 1e-6f;
        for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(shown[i], plain[i], tolerance) << i;
    }
}

/// Surfaces that no ray meets change no bit. With a far side the view ray continues unbent.
TEST_F(GlassBehind, raysThatMeetNothingShowTheEnvironment) {
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled})
        for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides}) {
            frame::FrameSettings settings = ofSide(kGlassPixels, light);
            settings.refraction = refraction;
            const Scene alone = glassUnderSky(bareGlass(1.5, 0.3));
            Scene with = alone;
            placeQuad(addNode(with, unlit()), 50.0, 1.0); // behind the camera
            const std::vector<float> shown = drawn(with, settings);
            EXPECT_EQ(shown, drawn(alone, settings)) << infoOf(light).name << ", " << infoOf(refraction).name;
            if (refraction == Refraction::TwoSides) continue;
            settings.refraction = Refraction::Environment;
            EXPECT_EQ(shown, drawn(with, settings)) << infoOf(light).name;
        }
}

/// They blend the background straight behind them, as smooth ones do.
TEST_F(GlassBehind, roughSheetsScatterNothingWhereGlassShowsTheEnvironmentAlone) {
    scenes::Material rough = bareGlass(1.5, 0.3);
    rough.thicknessMetres = 0.0f;
    const Scene covered = coveredByGlass(checkedWall(), rough);
    const std::vector<float> plain = drawn(checkedWall(), seeing(Refraction::Environment));
    EXPECT_EQ(drawn(covered, seeing(Refraction::Environment)), plain);
    EXPECT_NE(drawn(covered, seeing(Refraction::OneSide)), plain);
}

TEST_F(GlassBehind, hasNoTraceWhereThereIsNothingToShow) {
    const auto planOf = [](const Scene& scene, Refraction refraction = Refraction::OneSide) {
        frame::FrameSettings settings;
        settings.refraction = refraction;
        return planText(engine::planFrame(scene, Technique::Deferred, settings));
    };
    const auto hasDefine = [](const Scene& scene, const std::string& wanted) {
        return std::ranges::any_of(definedValues(scene, wanted), [](const std::string& value) { return value != "0"; });
    };
    using ::testing::HasSubstr, ::testing::Not;
    const Scene covered = coveredByGlass(checkedWall(), bareGlass(1.5));
    EXPECT_THAT(planOf(covered), HasSubstr("behind_glass"));
    EXPECT_THAT(planOf(covered), Not(HasSubstr("behind_glass_levels"))) << "smooth";
    EXPECT_TRUE(hasDefine(covered, "HAS_SCENE_BEHIND"));
    EXPECT_FALSE(hasDefine(covered, "HAS_BLURRED_SCENE_BEHIND"));
    EXPECT_FALSE(hasDefine(covered, "HAS_SCATTERING_SHEETS"));
    scenes::Material rough = clearGlass();
    rough.perceptualRoughness = 0.3f;
    const Scene frosted = coveredByGlass(checkedWall(), rough);
    EXPECT_THAT(planOf(frosted), HasSubstr("behind_glass_levels"));
    EXPECT_TRUE(hasDefine(frosted, "HAS_SCATTERING_SHEETS"));
    EXPECT_FALSE(hasDefine(frosted, "HAS_VOLUME"));
    EXPECT_THAT(planOf(frosted, Refraction::Environment), Not(HasSubstr("behind_glass")));
    EXPECT_THAT(planOf(coveredByGlass(checkedWall(), bareGlass(1.5, 0.3))), HasSubstr("behind_glass_levels"));
    EXPECT_THAT(planOf(covered, Refraction::Environment), Not(HasSubstr("behind_glass")));
    EXPECT_THAT(planOf(covered), Not(HasSubstr("far_sides")));
    EXPECT_THAT(planOf(covered, Refraction::BackFaces), HasSubstr("far_sides"));
    EXPECT_THAT(planOf(checkedWall(), Refraction::BackFaces), Not(HasSubstr("far_sides")));
    EXPECT_THAT(planOf(covered, Refraction::ClosedMeshes), Not(HasSubstr("far_sides")));
    EXPECT_THAT(planOf(covered, Refraction::ClosedMeshes), HasSubstr("back faces of glass")) << "reported as left out";
    Scene closed = covered;
    scenes::builtin::appendBox(closed.meshes.emplace_back(), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    closed.nodes.back().instances[0].mesh = int(closed.meshes.size()) - 1;
    EXPECT_THAT(planOf(closed, Refraction::ClosedMeshes), HasSubstr("far_sides"));

    Scene onlyGlass = quadScene(bareGlass(1.5));
    for (const Scene& scene : {checkedWall(), coveredByGlass(checkedWall(), clearGlass()), onlyGlass}) {
        EXPECT_THAT(planOf(scene), Not(HasSubstr("behind_glass")));
        EXPECT_THAT(planOf(scene), HasSubstr("surfaces behind glass")) << "reported as left out";
        EXPECT_FALSE(hasDefine(scene, "HAS_SCENE_BEHIND"));
    }
}

/// No opaque surface is drawn, but a light is visible.
TEST_F(GlassBehind, showsAreaLightsWhereNothingElseStandsBehindIt) {
    for (const double roughness : {0.0, 0.2}) {
        Scene scene = quadScene(bareGlass(1.5, roughness));
        makeOrthographic(scene.cameras[0], 1.0);
        scenes::Light& lamp = scene.lights.emplace_back();
        lamp.type = scenes::LightType::Rectangle;
        lamp.positionWS = {0.0, 0.0, -0.5};
        lamp.directionWS = {0.0, 0.0, 1.0};
        lamp.alongWS = {1.0, 0.0, 0.0};
        lamp.widthMetres = lamp.heightMetres = 1.0f;
        lamp.intensity = 2.0f;
        frame::FrameSettings settings = ofSize(16, 16);
        engine::Renderer renderer(context(), scene);
        const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
        const validation::ReferencePicture truth = strictReference(scene, settings);
        const std::size_t middle = 4 * (8 * 16 + 8);
        EXPECT_GT(seen[middle], 1.5f) << roughness;
        EXPECT_NEAR(seen[middle], truth.picture.rgba[middle], roughness > 0.0 ? 0.05 : 1e-4) << roughness;
        scene.lights[0].isSeen = false;
        EXPECT_LT(renderer.render(Technique::Deferred, settings).radiance[middle], 0.2f) << roughness;
    }
}

/// Compares the median error over pixels of bodies; docs/glass.md names the pixels with larger errors.
TEST_F(GlassBehindSlow, mostOfTheSceneGlassIsNearerToTheReferenceWithWhatStandsBehind) {
    const Scene scene = scenes::loadScene("glass");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withoutShadows(ofSize(96, 54));
    settings.environment.light = EnvironmentLight::Sampled;
    settings.refraction = Refraction::OneSide; // so that the reference too ignores the far sides of bodies
    const Picture truth = strictReference(scene, settings).picture;
    const auto drawnWith = [&](Refraction refraction) {
        settings.refraction = refraction;
        return renderer.render(Technique::Deferred, settings).radiance;
    };
    const std::vector<float> alone = drawnWith(Refraction::Environment), behind = drawnWith(Refraction::OneSide);
    // Pixels that differ between the two are those of bodies.
    std::vector<double> errorsAlone, errorsBehind;
    double squaresAlone = 0.0, squaresBehind = 0.0;
    const auto errorAt = [&](const std::vector<float>& shown, std::size_t pixel, double& squares) {
        double error = 0.0, light = 0.0;
        for (std::size_t i = 4 * pixel; i < 4 * pixel + 3; ++i) {
            const double own = double(shown[i]), other = double(truth.rgba[i]);
            error += std::abs(own - other);
            light += other + 0.01;
            squares += (own - other) * (own - other) / ((other + 0.01) * (other + 0.01)) / 3.0;
        }
        return error / light;
    };
    for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
        if (std::equal(&alone[4 * pixel], &alone[4 * pixel + 3], &behind[4 * pixel])) continue;
        errorsAlone.push_back(errorAt(alone, pixel, squaresAlone));
        errorsBehind.push_back(errorAt(behind, pixel, squaresBehind));
    }
    const double count = double(errorsAlone.size()), medianAlone = medianOf(errorsAlone),
                 medianBehind = medianOf(errorsBehind);
    fmt::print("glass: {} pixels of bodies; median error {:.3f} with the environment alone, {:.3f} with what stands "
               "behind; relMSE {:.2f} and {:.2f}\n",
               errorsAlone.size(), medianAlone, medianBehind, squaresAlone / count, squaresBehind / count);
    EXPECT_GT(count, 100.0);
    EXPECT_LT(medianBehind, 0.5 * medianAlone); // measured 0.059 and 0.175
}

} // namespace
} // namespace tessera
