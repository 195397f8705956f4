#include <span>

#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/stress/Stress.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using namespace test;

class ShadowMapsTest : public ShadowTest {
protected:
    /// Every case, or `one` of them.
    static std::span<const ShadowCase> casesOr(std::size_t one) {
        return isWholeSweep() ? std::span(kShadowCases) : std::span(kShadowCases).subspan(one, 1);
    }
};
using ShadowMapsSlow = ShadowMapsTest;

TEST_SWEEP_AS(ShadowMapsTest, everyTechniqueLooksUpTheSameToTheLastBit, ShadowMapsSlow,
              everyTechniqueLooksUpTheSameToTheLastBit) {
    std::size_t turn = 0;
    for (const ShadowCase& tried : kShadowCases) {
        scenes::Scene scene = sceneOf(tried);
        for (scenes::Light& light : scene.lights) light.*scenes::sizeParameter(infoOf(light.type))->member = 0.05f;
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(161, 91);
        settings.shadows = tried.shadows;
        const std::vector<ShadowFilter> filters = mapFilters();
        for (std::size_t i = 0; i < filters.size(); ++i) {
            if (!isWholeSweep() && i != turn % filters.size()) continue;
            settings.shadowFilter = filters[i];
            SCOPED_TRACE(fmt::format("{}, {}", tried.scene, infoOf(filters[i]).name));
            expectParity(renderer, settings, techniquesInTurn(turn));
        }
        ++turn;
    }
}

TEST_SWEEP_AS(ShadowMapsTest, everyTechniqueLooksUpTheSameOnMaskedAndTransparentSurfacesAndWithSeveralSamples,
              ShadowMapsSlow, everyTechniqueLooksUpTheSameOnMaskedAndTransparentSurfacesAndWithSeveralSamples) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : lambertScene();
    engine::Renderer renderer(context(), scene);
    const std::pair<int, ShadowFilter> tries[] = {{1, ShadowFilter::Hard}, {4, ShadowFilter::Pcf}};
    for (const auto& [samples, filter] : tries) {
        frame::FrameSettings settings = withSamples(withShadows(ofSize(160, 90), filter), samples);
        expectParity(renderer, settings, techniquesInTurn(std::size_t(samples) / 4, samples));
    }
}

TEST_SWEEP_AS(ShadowMapsTest, fewPixelsAreWrongAndFewerWithMoreTexels, ShadowMapsSlow,
              fewPixelsAreWrongAndFewerWithMoreTexels) {
    for (const ShadowCase& tried : casesOr(1)) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = settingsOf(tried);
        const ShadowReference truth = shadowReference(scene, settings);
        settings.shadowFilter = ShadowFilter::Hard;
        settings.shadowMaps.budgetMiB = 1024.0;
        std::size_t before = 0;
        for (const int resolution : {256, 1024}) {
            settings.shadowMaps.resolutionTexels = resolution;
            const WrongPixels count = wrongPixels(renderer, settings, truth);
            fmt::print("{}, {}: {}\n", tried.scene, resolution, count.text());
            if (before > 0) {
                EXPECT_LE(5 * count.wrong, 2 * before) << tried.scene;
                EXPECT_LE(double(count.wrong), 1.5 * tried.wrongShare * double(count.covered)) << tried.scene;
                EXPECT_LE(count.dark, 2u) << tried.scene; // measured: 0
            }
            before = count.wrong;
        }
    }
}

/// Light by light, so that every face has the requested side: the atlas holds no more than 16 faces of 4096.
TEST_F(ShadowMapsSlow, ofEveryLightFewerPixelsAreWrongTheFinerItsTexels) {
    constexpr int kResolutions[] = {512, 1024, 2048, 4096};
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = settingsOf(tried);
        // Softened terminators store a pixel's height in 8 bits, whose error does not shrink with texels.
        settings.shadowTerminator = frame::ShadowTerminator::Exact;
        settings.shadowMaps.budgetMiB = 1024.0;
        WrongPixels counts[std::size(kResolutions)];
        for (std::size_t light = 0; light < scene.lights.size(); ++light) {
            if (!scenes::castsShadow(scene, light, tried.shadows)) continue;
            settings.soloLight = int(light);
            settings.shadowFilter = ShadowFilter::Traced;
            const ShadowReference truth = shadowReference(scene, settings);
            settings.shadowFilter = ShadowFilter::Hard;
            for (std::size_t i = 0; i < std::size(kResolutions); ++i) {
                settings.shadowMaps.resolutionTexels = kResolutions[i];
                counts[i] += wrongPixels(renderer, settings, truth);
            }
        }
        for (std::size_t i = 0; i < std::size(kResolutions); ++i) {
            const WrongPixels& count = counts[i];
            fmt::print(
                "{}, {}: {} pixels wrong, {} of them lit, {} dark beside no shadow; at contacts {} lit, {} dark; of "
                "{} reached\n",
                tried.scene, kResolutions[i], count.wrong, count.leaks, count.dark, count.leaksAtContacts,
                count.darkAtContacts, count.reached);
            SCOPED_TRACE(fmt::format("{}, {} texels", tried.scene, kResolutions[i]));
            // Wrong pixels lie at outlines, in a band as wide as a texel. Which pixel centres lie in it is random:
            // three standard deviations of so few independent events.
            const double expected = double(counts[0].wrong) * std::pow(2.0, -double(i));
            EXPECT_LE(double(count.wrong), expected + 3.0 * std::sqrt(expected));
            if (kResolutions[i] < 2048) continue;
            EXPECT_LE(count.wrong, count.reached / 100);
            EXPECT_LE(count.dark, count.reached / 2000);
        }
    }
}

TEST_SWEEP_AS(ShadowMapsTest, tracedOnesAreAsRightInViewSpace, ShadowMapsSlow, tracedOnesAreAsRightInViewSpace) {
    for (const ShadowCase& tried : casesOr(0)) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = settingsOf(tried);
        settings.sizePixels = {120, 68};
        settings.space = frame::LightingSpace::View;
        const WrongPixels count = wrongPixels(renderer, settings);
        EXPECT_EQ(count.wrong, 0u) << tried.scene;
        EXPECT_GE(count.hidden, count.covered / 200) << tried.scene << ": nothing to see";
    }
}

// For a lamp: a sun's cascades extend to the farthest geometry.
TEST_F(ShadowMapsTest, aStrayTriangleFarAwayTakesNoShadowOfALampAndThoseOfASunAreSaidToBeLost) {
    scenes::Scene scene = ballUnderSun();
    scene.lights[0].type = scenes::LightType::Point;
    scene.lights[0].positionWS = {0.8, 3.0, 0.6};
    frame::FrameSettings settings = withShadows(ofSize(128, 72), ShadowFilter::Hard);
    settings.soloLight = 0;
    settings.shadowMaps.resolutionTexels = 1024;
    WrongPixels without;
    for (const float farMetres : {0.0f, 1e7f, 1e9f}) {
        if (farMetres > 0.0f) {
            scene.meshes.resize(2);
            const glm::vec3 strayOS(farMetres, 0.0f, 0.0f);
            const float side = std::max(2.0f, 2e-7f * farMetres); // a few fp32 steps at that distance
            for (const glm::vec3& along : {glm::vec3(0.0f), glm::vec3(side, 0.0f, 0.0f), glm::vec3(0.0f, side, 0.0f)})
                scene.meshes[1].positionsOS.push_back(strayOS + along);
            scene.meshes[1].normalsOS.resize(scene.meshes[1].positionsOS.size(), glm::vec3(0, 1, 0));
            for (std::uint32_t i = 3; i > 0; --i)
                scene.meshes[1].indices.push_back(std::uint32_t(scene.meshes[1].positionsOS.size()) - i);
            scene.meshes[1].texCoords = {};
        }
        engine::Renderer renderer(context(), scene);
        const WrongPixels count = wrongPixels(renderer, settings);
        fmt::print("a stray {} m away: {}\n", farMetres, count.text());
        renderer.render(Technique::Deferred, settings);
        EXPECT_EQ(renderer.shadows().missing, "");
        if (farMetres == 0.0f) without = count;
        EXPECT_GT(count.hidden, 50u);
        // The stray's length is rounded.
        EXPECT_LE(count.undecided, without.undecided + count.covered / 100);
        EXPECT_LE(count.wrong, without.wrong + count.covered / 500);
    }
    scene.lights[0].type = scenes::LightType::Directional;
    scene.lights[0].directionWS = {-0.4, -0.8, -0.3};
    engine::Renderer renderer(context(), scene);
    renderer.render(Technique::Deferred, settings);
    EXPECT_NE(renderer.shadows().missing.find("the maps of 1 light err by more than the"), std::string::npos)
        << renderer.shadows().missing;
}

/// Mesa ends every loop after its first iteration once the loops of a shader have made 65,535, here in a loop ahead of
/// the others. Pixels that need more iterations must be NaN. Drivers without that limit draw the same image.
TEST_F(ShadowMapsTest, truncatedLoopsGiveNaNInsteadOfOtherLight) {
    const ShaderMutant shaders("lib/shadow/shadow_map.glsl", "    int left = (kind",
                               "    int rounds = 0;\n    while (rounds + kind < 70000) ++rounds;\n"
                               "    if (rounds < 0) return 0.0;\n    int left = (kind");
    scenes::Scene scene = ballUnderSun();
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.8, -1.0, -0.3));
    makeOrthographic(scene.cameras[0], 0.8);
    scene.lights[0].angularRadiusRadians = 0.05f;
    const frame::FrameSettings settings = withShadows(ofSize(32, 18), ShadowFilter::Pcss);
    const std::vector<float> wanted = drawn(scene, settings, Technique::Forward);
    const std::vector<float> found = drawn(scene, settings, Technique::Forward, shaders.tree());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_TRUE(found[i] == wanted[i] || std::isnan(found[i])) << i << ": " << found[i];
}

TEST_F(ShadowMapsTest, areAsRightInViewSpace) {
    const scenes::Scene scene = sceneOf(kShadowCases[0]);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(exactOfSize(120, 68));
    settings.space = frame::LightingSpace::View;
    const ShadowReference truth = shadowReference(scene, settings);
    settings.shadowFilter = ShadowFilter::Hard;
    settings.shadowMaps.resolutionTexels = 1024;
    const WrongPixels looked = wrongPixels(renderer, settings, truth);
    fmt::print("view space: {}\n", looked.text());
    EXPECT_LE(looked.wrong, looked.covered / 1000);
    EXPECT_GE(looked.hidden, looked.covered / 100) << "nothing to see";
}

TEST_SWEEP_AS(ShadowMapsTest, aBudgetLeavesEveryLightItsShadow, ShadowMapsSlow, aBudgetLeavesEveryLightItsShadow) {
    const scenes::Scene scene = latticeOf(256);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(160, 90));
    settings.filter = frame::TextureFilter::Exact;
    const ShadowReference truth = shadowReference(scene, settings);
    settings.shadowFilter = ShadowFilter::Hard;
    // MiB and fraction of wrong pixels; measured 2.4, 5.1 and 9.7 %, where each reads the shadows of some nine lights.
    const std::pair<double, double> budgets[] = {{64.0, 0.036}, {16.0, 0.076}, {4.0, 0.125}};
    for (const auto& [mebibytes, mostWrong] : budgets) {
        settings.shadowMaps.budgetMiB = mebibytes;
        const WrongPixels count = wrongPixels(renderer, settings, truth);
        fmt::print("{} MiB: {}\n", mebibytes, count.text());
        EXPECT_LE(double(count.wrong), mostWrong * double(count.covered));
        EXPECT_GT(count.hidden, count.covered / 20);
        if (mebibytes == 4.0) expectParity(renderer, settings, techniquesInTurn(1));
    }
}

/// Images of the stability suite's shadow cases, and budgets too small for them.
/// With every filter, each light's visibility and two techniques. In a short sweep every fourth image with a filter, a
/// light and a technique in turn, without the case of thousands of lights.
TEST_SWEEP_AS(ShadowMapsTest, extremeScenesStayFiniteAndNoShadowIsOutsideZeroToOne, ShadowMapsSlow,
              extremeScenesStayFiniteAndNoShadowIsOutsideZeroToOne) {
    const bool isWhole = isWholeSweep();
    const auto effort = isWhole ? validation::StressEffort::Full : validation::StressEffort::Quick;
    std::vector<validation::StressPicture> pictures;
    for (const validation::StressCase* row : validation::stressCasesNamed("shadow"))
        for (validation::StressPicture& picture : row->pictures(effort)) pictures.push_back(std::move(picture));
    pictures = everyNth(std::move(pictures), 4);
    for (const double mebibytes : {0.001, 0.002, 0.5}) {
        pictures.push_back(pictures.front());
        pictures.back().what = fmt::format("a budget of {:g} MiB", mebibytes);
        pictures.back().settings.shadowMaps.budgetMiB = mebibytes;
    }
    // Cascades without a caster: only the sky in view, and a single surface.
    for (const double y : {1e3, 0.5}) {
        validation::StressPicture& picture = pictures.emplace_back(pictures.front());
        picture.what = fmt::format("cascades without casters, seen from {:g} m", y);
        scenes::Light& sun = picture.scene.lights[0];
        sun.type = scenes::LightType::Directional;
        sun.directionWS = {0.0, -1.0, 0.0};
        if (y < 1e3) picture.scene.nodes.resize(1);
        picture.scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.0, y, 0.0}, {1.0, 2.0 * y, 0.0});
    }
    ASSERT_GE(pictures.size(), isWhole ? 32u : 10u);
    const std::vector<ShadowFilter> filters = mapFilters();
    std::size_t count = 0;
    for (validation::StressPicture& picture : pictures) {
        frame::FrameSettings& settings = picture.settings;
        settings.shadowSamples = 16;
        SCOPED_TRACE(picture.what);
        engine::Renderer renderer(context(), picture.scene);
        const std::size_t turn = count++;
        const ShadowFilter ofTurn = filters[turn % filters.size()];
        std::vector<float> radiance; // of that filter
        for (const ShadowFilter filter : filters) {
            if (!isWhole && filter != ofTurn) continue;
            settings.shadowFilter = filter;
            settings.view = frame::DebugView::Final;
            const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
            EXPECT_TRUE(std::ranges::all_of(seen, [](float x) { return x >= 0.0f && std::isfinite(x); }))
                << infoOf(filter).name;
            if (filter == ofTurn) radiance = seen;
        }
        // Visibility itself, and other techniques, for one filter per image in turn.
        settings.shadowFilter = ofTurn;
        settings.view = frame::DebugView::Final;
        for (const Technique other : {Technique::ClusteredDeferred, Technique::Forward}) {
            if (!isWhole && (turn % 2 == 0) != (other == Technique::Forward)) continue;
            EXPECT_EQ(renderer.render(other, settings).radiance, radiance) << infoOf(other).name;
        }
        settings.view = frame::DebugView::Shadow;
        const int lights = std::min(int(picture.scene.lights.size()), 3);
        for (int light = 0; light < lights; ++light) {
            if (!isWhole && light != int(turn / 2) % lights) continue;
            settings.soloLight = light;
            const std::vector<float> shares = renderer.render(Technique::Deferred, settings).radiance;
            EXPECT_TRUE(std::ranges::all_of(shares, [](float x) { return x >= 0.0f && x <= 1.0f; })) << light;
        }
    }
}

TEST_F(ShadowMapsTest, penumbraeOfPcssAreThoseOfTracedShadows) {
    const scenes::Scene scene = scenes::loadScene("shadow_truth");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withView(ofSize(240, 135), frame::DebugView::Shadow);
    settings.shadowSamples = 64;
    settings.shadowMaps.resolutionTexels = 1024;
    for (const int light : {0, 1}) {
        settings.soloLight = light;
        const auto shares = [&](ShadowFilter filter) {
            settings.shadowFilter = filter;
            return renderer.render(Technique::Deferred, settings).radiance;
        };
        const std::vector<float> truth = shares(ShadowFilter::Traced), looked = shares(ShadowFilter::Pcss);
        // The width of a penumbra is measured by the pixels that are neither dark nor lit.
        std::size_t wide = 0, wideTruth = 0;
        double squares = 0.0;
        for (std::size_t i = 0; i < truth.size(); i += 4) {
            wide += looked[i] > 0.1f && looked[i] < 0.9f;
            wideTruth += truth[i] > 0.1f && truth[i] < 0.9f;
            squares += std::pow(double(looked[i]) - double(truth[i]), 2);
        }
        const double error = std::sqrt(squares / double(truth.size() / 4));
        fmt::print("light {}: {} pixels of penumbra, traced {}; RMS of the share {:.4f}\n", light, wide, wideTruth,
                   error);
        EXPECT_NEAR(double(wide), double(wideTruth), 0.15 * double(wideTruth));
        EXPECT_LT(error, 0.01);
    }
}

} // namespace
} // namespace tessera
