// Attribution of an image's error: each cause alone, in scenes that add causes one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/PrepareView.h"
#include "scenes/Load.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/GlassBehindTest.h"
#include "tests/support/AnimatedModels.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"
#include "validation/bench/Attribution.h"

namespace tessera {
namespace {

using engine::Technique;
using validation::AttributionLine;

/// The features of sceneOf() that causes need.
struct Switches {
    bool size = false, area = false, environment = false, glass = false, skin = false;
};
struct Switch {
    const char* cause;
    bool Switches::*flag;
};

class Attribution : public test::GlTest {
protected:
    /// Checks the attribution of a scene with each of the causes added to those before it.
    void expectSwitched(std::span<const Switch> switches);

    static constexpr double kMostArithmetic = 1e-8;

    /// Attribution lines of one bench point of `technique` per environment method, judged by the reference.
    std::vector<AttributionLine> linesOf(const scenes::Scene& scene, frame::FrameSettings settings,
                                         Technique technique = Technique::Forward,
                                         std::vector<frame::EnvironmentLight> methods = {},
                                         const std::function<void(frame::FrameSettings&)>& choose = {}) {
        settings.filter = frame::TextureFilter::Exact;
        if (methods.empty()) methods = {settings.environment.light};
        engine::Renderer renderer(context(), scene);
        const validation::GroupTruth truth(renderer, validation::BenchTruth::Reference, settings,
                                           frame::TextureFilter::Exact, [] {});
        std::vector<validation::BenchPoint> points;
        for (const frame::EnvironmentLight method : methods) {
            validation::BenchPoint& point = points.emplace_back();
            point.technique = technique;
            point.settings = settings;
            point.settings.environment.light = method;
            if (choose) choose(point.settings);
            point.key.technique = infoOf(technique).name;
            point.key.layout = point.settings.layout == frame::exactLayout().layout ? "exact" : "packed";
            point.key.rangeTolerance = point.settings.rangeTolerance;
            const frame::PreparedView prepared = engine::prepareView(scene, technique, point.settings);
            const validation::MethodFacts facts{scene, point.settings, prepared};
            for (const validation::MethodKindInfo& info : validation::methodKindTable())
                if (info.isUsed(facts)) point.key.method(info.kind) = methodKeyOf(info.kind, facts);
        }
        return validation::attributeErrors(context(), truth, "reference", points);
    }

    /// Checks that the causes sum to the whole, fp32 errors are small and no figure repeats; returns the causes.
    static std::set<std::string> expectSound(const std::vector<AttributionLine>& lines) {
        std::set<std::string> causes;
        std::set<double> figures;
        double whole = 0.0, sum = 0.0;
        for (const AttributionLine& line : lines) {
            fmt::print("  {:12} {:60} relMse {:.3e} bias {:+.2e}\n", line.cause, line.what, line.relMse.value_or(NAN),
                       line.bias.value_or(NAN));
            if (line.cause == validation::kWholeCause) {
                whole = line.relMse.value();
            } else if (line.cause == validation::kCrossCause) {
                sum += line.relMse.value();
            } else if (line.what.find(": ") == std::string::npos) { // else one channel
                causes.insert(line.cause);
                sum += line.cause == validation::kFilterCause ? 0.0 : line.relMse.value();
                if (line.cause == "arithmetic") {
                    EXPECT_LE(line.relMse.value(), kMostArithmetic);
                }
                EXPECT_TRUE(figures.insert(line.relMse.value()).second)
                    << line.what << " has the figure of another cause";
            }
        }
        EXPECT_NEAR(sum, whole, 0.1 * whole + kMostArithmetic);
        return causes;
    }
};

class AttributionSlow : public Attribution {};

/// A ball over a floor below a lamp; each flag adds the feature that one cause needs.
scenes::Scene sceneOf(const Switches& on) {
    scenes::Material floor;
    floor.metallic = 0.5f;
    floor.perceptualRoughness = 0.4f;
    scenes::Scene scene = test::quadScene(floor);
    scene.background = {0.0f, 0.0f, 0.0f};
    scenes::Material ball = floor;
    if (on.glass) {
        ball.metallic = 0.0f;
        ball.transmission = 1.0f;
        ball.thicknessMetres = 0.4f;
        ball.perceptualRoughness = 0.2f;
    }
    if (on.skin) {
        ball.metallic = 0.0f;
        ball.subsurface.method = scenes::SubsurfaceMethod::DepthMap;
        ball.subsurface.scaleMetres = 0.1f;
    }
    scene.materials.push_back(ball);
    scene.meshes.push_back(test::everythingScene().meshes[1]);
    scene.meshes.back().colors.clear();
    scenes::Node& node = scene.nodes.emplace_back();
    node.parentFromNode = glm::scale(glm::translate(glm::dmat4(1.0), {0.1, 0.2, 0.5}), glm::dvec3(0.4));
    node.instances.push_back({1, 1});
    scenes::Light lamp = test::pointLight({0.8, 0.9, 2.0}, 6.0f);
    lamp.castsShadow = true;
    if (on.size) lamp.radiusMetres = 0.3f;
    scene.lights = {lamp};
    if (on.area) {
        scenes::Light panel;
        panel.castsShadow = false;
        panel.type = scenes::LightType::Rectangle;
        panel.positionWS = {-1.0, 0.0, 1.5};
        panel.directionWS = glm::normalize(glm::dvec3(0.6, 0.0, -1.0));
        scene.lights.push_back(panel);
    }
    if (on.environment)
        scene.environment = test::environmentOf(16, 8, [](int x, int y) { return 0.1 * glm::dvec3(x, y, 8); });
    return scene;
}

void Attribution::expectSwitched(std::span<const Switch> switches) {
    frame::FrameSettings settings;
    settings.sizePixels = {24, 18};
    settings.environment.backdrop = frame::Backdrop::Off;
    Switches on;
    std::set<std::string> expected{"arithmetic"};
    for (const Switch& one : switches) {
        fmt::print("with {}\n", one.cause);
        SCOPED_TRACE(one.cause);
        on.*one.flag = true;
        expected.insert(one.cause);
        if (on.size) expected.insert("shadow"); // fewer rays than the truth's
        EXPECT_EQ(expectSound(linesOf(sceneOf(on), settings)), expected);
    }
}

TEST_F(Attribution, fp32ArithmeticIsNotTheErrorOfTheEnvironment) {
    expectSwitched(std::array{Switch{"environment", &Switches::environment}});
}
TEST_F(Attribution, subsurfaceScatteringIsMeasuredBesideALightThatScattersNowhere) {
    expectSwitched(std::array{Switch{"subsurface", &Switches::skin}});
}
/// Glass uses the environment method of its point, so each method has its own glass line; its lines sum to its whole.
TEST_F(Attribution, glassIsMeasuredWithTheEnvironmentOfItsPoint) {
    Switches on;
    on.glass = on.environment = true;
    frame::FrameSettings settings;
    settings.sizePixels = {24, 18};
    settings.environment.backdrop = frame::Backdrop::Off;
    settings.environment.samples = 256;
    using frame::EnvironmentLight;
    const std::array methods{EnvironmentLight::SplitSum, EnvironmentLight::Sampled};
    const std::vector<AttributionLine> lines =
        linesOf(sceneOf(on), settings, Technique::Forward, {methods.begin(), methods.end()});
    double arithmetic = 0.0;
    std::map<std::string, double> sums, wholes;
    for (const AttributionLine& line : lines) {
        fmt::print("  {:12} {:80} relMse {:.3e}\n", line.cause, line.what, line.relMse.value());
        if (line.cause == "arithmetic") arithmetic = line.relMse.value();
        for (const EnvironmentLight method : methods)
            if (line.what.find(infoOf(method).name) != std::string::npos)
                (line.cause == validation::kWholeCause ? wholes : sums)[std::string(infoOf(method).name)] +=
                    line.relMse.value();
    }
    ASSERT_EQ(wholes.size(), methods.size());
    for (const auto& [name, whole] : wholes) EXPECT_NEAR(sums[name] + arithmetic, whole, 0.1 * whole) << name;
}
/// Choices of a point that differ from the truth: light ranges, shadow filter, G-buffer layout.
TEST_F(Attribution, choicesOfAPointSumToTheWhole) {
    scenes::Scene scene = sceneOf({});
    scene.lights[0].falloff = scenes::Falloff::Attenuation;
    scene.lights[0].attenuation = {0.0f, 0.0f, 1.0f};
    frame::FrameSettings settings;
    settings.sizePixels = {24, 18};
    std::set<std::string> expected{"arithmetic"};
    int choices = 0;
    const auto choose = [&](frame::FrameSettings& own) {
        if (choices > 0) own.rangeTolerance = 0.02;
        if (choices > 1) own.shadowFilter = frame::ShadowFilter::Pcf;
        if (choices > 2)
            own.layout = std::ranges::find(frame::layoutTable(), "packed", &frame::LayoutInfo::name)->layout;
    };
    for (const char* cause : {"range", "shadow", "layout"}) {
        fmt::print("with {}\n", cause);
        SCOPED_TRACE(cause);
        ++choices;
        expected.insert(cause);
        EXPECT_EQ(expectSound(linesOf(scene, settings, Technique::TiledDeferred, {}, choose)), expected);
    }
}
/// Each resolution of shadow maps has a row, and so has the hardware's texture filter.
TEST_F(Attribution, resolutionsOfShadowMapsAndTheTextureFilterHaveTheirRows) {
    scenes::Scene scene = sceneOf({});
    scene.images.push_back(test::checkerImage());
    scene.materials[0].texture(scenes::TextureSlot::BaseColor).image = 0;
    frame::FrameSettings settings;
    settings.sizePixels = {24, 18};
    for (const int resolutionTexels : {64, 1024}) {
        SCOPED_TRACE(resolutionTexels);
        const std::vector<AttributionLine> lines =
            linesOf(scene, settings, Technique::Forward, {}, [&](frame::FrameSettings& own) {
                own.filter = frame::TextureFilter::Hardware;
                own.shadowFilter = frame::ShadowFilter::Pcf;
                own.shadowMaps.resolutionTexels = resolutionTexels;
            });
        EXPECT_EQ(expectSound(lines), (std::set<std::string>{"arithmetic", "shadow", validation::kFilterCause}));
        EXPECT_TRUE(std::ranges::any_of(lines, [&](const AttributionLine& line) {
            return line.cause == std::string_view("shadow") &&
                   line.what.find(std::to_string(resolutionTexels)) != std::string::npos;
        }));
    }
}
/// In an image of one pixel every channel counts: without one of red, green and blue, the cross term would be off by
/// about a third of the whole.
TEST_F(Attribution, everyChannelOfTheFirstPixelCounts) {
    scenes::Scene scene = sceneOf({});
    scene.lights[0].falloff = scenes::Falloff::Attenuation;
    scene.lights[0].attenuation = {0.0f, 0.0f, 1.0f};
    frame::FrameSettings settings;
    settings.sizePixels = {1, 1};
    expectSound(
        linesOf(scene, settings, Technique::Forward, {}, [](frame::FrameSettings& own) { own.rangeTolerance = 0.3; }));
}
TEST_F(AttributionSlow, causesThatAreSwitchedOnOneByOneSumToTheWhole) {
    expectSwitched(std::array{Switch{"environment", &Switches::environment}, Switch{"area", &Switches::area},
                              Switch{"noise", &Switches::size}, Switch{"subsurface", &Switches::skin}});
    expectSwitched(std::array{Switch{"glass", &Switches::glass}, Switch{"environment", &Switches::environment},
                              Switch{"area", &Switches::area}, Switch{"noise", &Switches::size}});
}

TEST_F(AttributionSlow, theCausesOfScenesAndModelsSumToTheWhole) {
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.diffusion.sideTexels = 256;
    for (const char* name : {"hall", "studio", "glass", "head_skin"}) {
        SCOPED_TRACE(name);
        fmt::print("{}\n", name);
        expectSound(linesOf(scenes::loadScene(name, {}), settings));
    }
    // A built-in scene, and two models that may be absent.
    fmt::print("spheres before the studio\n");
    scenes::LoadOptions inStudio;
    inStudio.environment = "studio";
    expectSound(linesOf(scenes::loadScene("spheres", inStudio), settings));
    for (const char* file :
         {"WaterBottle/WaterBottle.gltf", "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb"}) {
        SCOPED_TRACE(file);
        fmt::print("{}\n", file);
        if (const std::optional<std::filesystem::path> model = test::fileOfAssets(file))
            expectSound(linesOf(scenes::loadScene(model->string(), inStudio), settings));
        else
            fmt::print("  is not here\n");
    }
}

} // namespace
} // namespace tessera
