// Surface hooks: parity of techniques, what they change and what they keep, and the reference.
#include <chrono>
#include <filesystem>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "renderer/gpu/Program.h"
#include "tests/image/HookTest.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using testing::AllOf, testing::HasSubstr, testing::Not, testing::ThrowsMessage;
using namespace test;

/// Reads all inputs, and changes all outputs.
constexpr std::string_view kTint = R"({
    float wave = 0.5 + 0.5 * sin(hook.timeSeconds + 3.0 * inputs.positionOS.x + float(inputs.instance));
    surface.color = mix(surface.color, vec3(inputs.uv.x - floor(inputs.uv.x), wave, 2.0), hook.strength);
    surface.emission += hook.strength * vec3(0.1, 0.0, 0.2 * wave);
    surface.alpha *= 1.0 - 0.5 * hook.strength;
    surface.metallic = mix(surface.metallic, wave, hook.strength);
}
)";

class Hooks : public HookTest {
protected:
    /// Replaces the body in the hook's file, with a modification time an hour later.
    void rewrite(const scenes::Scene& scene, std::string_view body) {
        const std::filesystem::path file = scene.hook->file;
        const auto time = std::filesystem::last_write_time(file) + std::chrono::hours(1);
        folder.write(file.filename().string(), std::string(kSurfaceHeader).append(body));
        std::filesystem::last_write_time(file, time);
    }
};

TEST_SWEEP(Hooks, oneThatChangesNothingChangesNoBit) {
    constexpr frame::TextureFilter kFilters[] = {frame::TextureFilter::Hardware, frame::TextureFilter::Exact};
    std::size_t turn = 0, pairs = 0;
    for (const scenes::Scene& scene : {everythingScene(), evenScene()}) {
        const scenes::Scene same = hooked(scene, "{\n}\n");
        for (const Technique technique : {Technique::Forward, Technique::Deferred, Technique::ClusteredDeferred}) {
            if (!isWholeSweep() && pairs++ % 4 != 0) continue;
            for (const frame::TextureFilter filter : inTurn(kFilters, turn++)) {
                frame::FrameSettings settings = smallSettings();
                settings.filter = filter;
                EXPECT_EQ(drawn(same, settings, technique), drawn(scene, settings, technique))
                    << int(technique) << ' ' << int(filter);
            }
        }
    }
}

/// A scene of everything and, unpruned, one of uniform materials with every technique. In a short sweep metal and the
/// latter with one in turn; timeAndParametersChangeThePictureAndCompileNothing draws unpruned hooks.
TEST_SWEEP(Hooks, everyTechniqueDrawsWhatTheyChangeAlike) {
    struct Case {
        scenes::Scene scene;
        frame::TextureFilter filter;
        bool castsShadows, prune;
    };
    const scenes::Scene first = isWholeSweep() ? everythingScene() : metalScene();
    std::size_t turn = 0;
    for (const auto& [scene, filter, castsShadows, prune] :
         {Case{first, frame::TextureFilter::Exact, false, true},
          Case{evenScene(), frame::TextureFilter::Hardware, true, !isWholeSweep()}}) {
        const scenes::Scene tinted = hooked(scene, kTint);
        engine::Renderer renderer(context(), tinted);
        frame::FrameSettings settings = smallSettings();
        settings.timeSeconds = 0.3;
        settings.filter = filter;
        if (castsShadows) settings.shadows = kAllLightsCast;
        settings.prune = prune;
        EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, drawn(scene, settings));
        expectParity(renderer, settings, techniquesInTurn(turn++));
    }
}

TEST_F(Hooks, onlyTheMaterialsThatTheyNameChange) {
    scenes::Scene scene = quadScene({});
    const std::vector<float> before = drawn(scene, smallSettings());
    scene = hooked(scene, "{\n    surface.emission += vec3(0.25);\n}\n");
    EXPECT_NE(drawn(scene, smallSettings()), before);
    scene.hook->materials.clear();
    EXPECT_EQ(drawn(scene, smallSettings()), before);
}

TEST_F(Hooks, timeAndParametersChangeThePictureAndCompileNothing) {
    scenes::Scene scene = hooked(everythingScene(), kTint);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = smallSettings();
    settings.prune = false; // else programs also depend on which of the moving lights reach visible surfaces
    const std::vector<float> first = renderer.render(Technique::Deferred, settings).radiance;
    const std::size_t programs = renderer.programs().size();
    settings.timeSeconds = 1.0;
    const std::vector<float> later = renderer.render(Technique::Deferred, settings).radiance;
    EXPECT_NE(later, first);
    scene.hook->parameters[0].value = 0.1f;
    EXPECT_NE(renderer.render(Technique::Deferred, settings).radiance, later);
    settings.timeSeconds = 0.0;
    scene.hook->parameters[0].value = 0.7f;
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, first);
    EXPECT_EQ(renderer.programs().size(), programs);
}

TEST_F(Hooks, everyParameterArrivesUnderItsName) {
    scenes::Scene scene = hooked(quadScene({}), "{\n    surface.emission = vec3(hook.p0, hook.p6, hook.p14);\n}\n");
    scene.hook->parameters.clear();
    for (std::size_t i = 0; i < scenes::kMostHookParameters; ++i)
        scene.hook->parameters.push_back({fmt::format("p{}", i), 0.25f * float(i + 1), 0.0f, 16.0f});
    const frame::FrameSettings settings = smallSettings();
    const std::vector<float> radiance = drawn(scene, settings);
    const std::size_t middle = 4 * (std::size_t(settings.sizePixels.x) * 45 + 80);
    EXPECT_EQ(radiance[middle], 0.25f);
    EXPECT_EQ(radiance[middle + 1], 1.75f);
    EXPECT_EQ(radiance[middle + 2], 3.75f);
}

TEST_F(Hooks, whatTheyGiveIsKeptWithinWhatASurfaceMayBe) {
    const scenes::Scene dark = hooked(quadScene(lambert()), "{\n    surface.emission = vec3(-1.0, 0.5, -2.0);\n}\n");
    const frame::FrameSettings settings = smallSettings();
    for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
        const std::vector<float> radiance = drawn(dark, settings, technique);
        const std::size_t middle = 4 * (std::size_t(settings.sizePixels.x) * 45 + 80);
        EXPECT_EQ(radiance[middle], 0.0f);
        EXPECT_EQ(radiance[middle + 1], 0.5f);
        EXPECT_EQ(radiance[middle + 2], 0.0f);
    }
}

/// A value beyond a bound draws the image of a material at that bound; NaN that of the lower bound.
TEST_F(Hooks, whatIsBeyondABoundIsDrawnAsTheBound) {
    using scenes::Material;
    struct Case {
        const char* body;
        void (*set)(Material&);
    };
    const Case cases[] = {
        {"{ surface.color = vec3(7.0, 1.0, -3.0); }", [](Material& m) { m.baseColor = glm::vec4(1, 1, 0, 1); }},
        {"{ surface.color = vec3(uintBitsToFloat(0x7fc00000u)); }",
         [](Material& m) { m.baseColor = glm::vec4(0, 0, 0, 1); }},
        {"{ surface.alpha = 0.0; }", [](Material& m) { m.perceptualRoughness = 0.0f; }},
        {"{ surface.alpha = 9.0; }", [](Material& m) { m.perceptualRoughness = 1.0f; }},
        {"{ surface.metallic = 2.0; }", [](Material& m) { m.metallic = 1.0f; }},
        {"{ surface.metallic = -1.0; }", [](Material& m) { m.metallic = 0.0f; }},
        {"{ surface.emission = vec3(1e4, 0.0, -2.0); }", [](Material& m) { m.emissive = glm::vec3(1e4f, 0, 0); }}};
    Material material = metalOf(0.5);
    material.baseColor = {0.6f, 0.4f, 0.3f, 1.0f};
    material.metallic = 0.4f;
    scenes::Scene scene = quadScene(material);
    scene.lights = {pointLight({0.3, 0.4, 1.0}, 3.0f)};
    frame::FrameSettings settings = smallSettings();
    settings.sizePixels = {24, 24};
    for (const Case& one : cases) {
        SCOPED_TRACE(one.body);
        scenes::Scene at = scene;
        one.set(at.materials[0]);
        const std::vector<float> shown = drawn(hooked(scene, one.body), settings), wanted = drawn(at, settings);
        EXPECT_EQ(shown, wanted);
        EXPECT_NE(shown, drawn(scene, settings));
    }
}

/// In the renderer's programs and in the reference's.
TEST_F(Hooks, theProgramsOwnNamesAreUnknownToThem) {
    for (const char* reached : {"float(view.sizePixels.x)", "texture(baseColorTexture, inputs.uv).x", "kPi",
                                "float(hookPointRows.length())", "float(MATERIAL_FLAG_HOOKED)"}) {
        const scenes::Scene scene = hooked(quadScene({}), fmt::format("{{\n    surface.color.r = {};\n}}\n", reached));
        const auto isRefused = ThrowsMessage<InputError>(AllOf(HasSubstr(scene.hook->file + ":3: error"),
                                                               HasSubstr("other names of the program are hidden"),
                                                               Not(HasSubstr("ofHook"))));
        EXPECT_THAT([&] { drawn(scene, smallSettings()); }, isRefused) << reached;
        engine::Renderer renderer(context(), scene);
        EXPECT_THAT([&] { validation::referencePicture(renderer, smallSettings()); }, isRefused) << reached;
    }
    // Hooks may reuse names of the program.
    const scenes::Scene own = hooked(quadScene({}), "{\n    float view = 0.25, kPi = view;\n"
                                                    "    surface.color.r = kPi;\n}\n");
    EXPECT_EQ(drawn(own, smallSettings()),
              drawn(hooked(quadScene({}), "{\n    surface.color.r = 0.25;\n}\n"), smallSettings()));
}

TEST_F(Hooks, pixelsWhoseLoopsAreEndedAreNaNAndTheReferenceRefusesThem) {
    const auto looping = [&](const char* rounds) {
        return hooked(quadScene(unlit()),
                      fmt::format("{{\n    float sum = 0.0;\n    for (float i = 0.0; i < {}; ++i) sum += 1.0;\n"
                                  "    surface.emission = vec3(1e-6 * sum);\n}}\n",
                                  rounds));
    };
    frame::FrameSettings settings = smallSettings();
    settings.sizePixels = {16, 9};
    const auto middleOf = [&](const scenes::Scene& scene, Technique technique) {
        return drawn(scene, settings, technique)[4 * (16 * 4 + 8)];
    };
    for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
        EXPECT_NEAR(middleOf(looping("60000.0"), technique), 0.06f, 1e-5f);
        EXPECT_TRUE(std::isnan(middleOf(looping("60001.0"), technique)));
        EXPECT_TRUE(std::isnan(middleOf(looping("1e6"), technique)));
        const scenes::Scene endless = hooked(
            quadScene(unlit()), "{\n    surface.emission = vec3(0.25);\n    if (inputs.positionOS.x > 0.0)\n"
                                "        while (true) surface.emission.r = fract(surface.emission.r + 0.37);\n}\n");
        const std::vector<float> radiance = drawn(endless, settings, technique);
        EXPECT_EQ(radiance[4 * (16 * 4 + 6)], 0.25f);
        EXPECT_TRUE(std::isnan(radiance[4 * (16 * 4 + 9)]));
    }
    const scenes::Scene scene = looping("1e6");
    engine::Renderer renderer(context(), scene);
    EXPECT_THROW(validation::referencePicture(renderer, settings), InputError);
}

TEST_F(Hooks, aFaultNamesFileAndLineAndLeavesOtherScenesAlone) {
    const scenes::Scene faulty = hooked(evenScene(), "{\n    surface.color = undeclaredName;\n}\n");
    EXPECT_THAT([&] { drawn(faulty, smallSettings()); },
                ThrowsMessage<InputError>(HasSubstr(faulty.hook->file + ":3: error")));
    EXPECT_NO_THROW(drawn(evenScene(), smallSettings()));
}

TEST_F(Hooks, theMendingOfOneThatIsFaultyFromTheBeginningIsSeen) {
    const scenes::Scene scene = hooked(evenScene(), "{\n    surface.color = undeclaredName;\n}\n");
    engine::Renderer renderer(context(), scene);
    EXPECT_THROW(renderer.render(Technique::Deferred, smallSettings()), InputError);
    EXPECT_TRUE(renderer.programs().watchesFiles());
    EXPECT_FALSE(renderer.programs().sourcesChanged()) << "that it came is no change";
    rewrite(scene, "{ surface.color = vec3(0.0); }\n");
    EXPECT_TRUE(renderer.programs().sourcesChanged());
    EXPECT_TRUE(renderer.programs().reload().faults.empty());
    EXPECT_NO_THROW(renderer.render(Technique::Deferred, smallSettings()));
}

TEST_F(Hooks, whatTheyDefineChangesNothingBeforeThem) {
    const scenes::Scene scene = evenScene();
    const std::vector<float> before = drawn(scene, smallSettings());
    scenes::Scene defining =
        hooked(scene, "{\n}\n#define material 0\n#define max min\nfloat helper() { return 1.0; }\n");
    EXPECT_EQ(drawn(defining, smallSettings()), before);
}

TEST_F(Hooks, anEditShowsAndAFaultyOneKeepsTheLastGoodForm) {
    const scenes::Scene scene = hooked(evenScene(), "{\n}\n");
    engine::Renderer renderer(context(), scene);
    const std::vector<float> before = renderer.render(Technique::Deferred, smallSettings()).radiance;
    EXPECT_TRUE(renderer.programs().watchesFiles()) << "a viewer at rest looks whether it has changed";
    EXPECT_FALSE(renderer.programs().sourcesChanged()) << "that it came is no change";
    rewrite(scene, "{ surface.color = vec3(0.0) }\n");
    EXPECT_TRUE(renderer.programs().sourcesChanged());
    const std::vector<shader::ShaderFault> faults = renderer.programs().reload().faults;
    ASSERT_FALSE(faults.empty());
    EXPECT_THAT(faults.front().text, HasSubstr(scene.hook->file + ":2: error"));
    EXPECT_EQ(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
    rewrite(scene, "{ discard; }\n"); // which drivers accept
    const std::vector<shader::ShaderFault> holes = renderer.programs().reload().faults;
    ASSERT_FALSE(holes.empty());
    EXPECT_THAT(holes.front().text, HasSubstr(scene.hook->file + ":2: discard: a hook makes no holes"));
    EXPECT_EQ(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
    rewrite(scene, "{ surface.color = vec3(0.0); }\n");
    EXPECT_TRUE(renderer.programs().reload().faults.empty());
    EXPECT_NE(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
}

/// Entering light is cached, but not across an edit of the hook's colour.
TEST_F(Hooks, anEditShowsInDiffusedLight) {
    scenes::Material skin = lambert();
    skin.subsurface.method = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    scenes::Scene lit = quadScene(skin);
    lit.lights = {pointLight({0.3, 0.4, 1.0}, 3.0f)};
    constexpr std::string_view kBlue = "{\n    surface.color = vec3(0.2, 0.4, 0.8);\n}\n";
    constexpr std::string_view kRed = "{\n    surface.color = vec3(0.8, 0.4, 0.2);\n}\n";
    const scenes::Scene scene = hooked(lit, kBlue);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> before = renderer.render(Technique::Forward, smallSettings()).radiance;
    EXPECT_EQ(renderer.render(Technique::Forward, smallSettings()).radiance, before);
    rewrite(scene, kRed);
    EXPECT_TRUE(renderer.programs().reload().faults.empty());
    const std::vector<float> after = renderer.render(Technique::Forward, smallSettings()).radiance;
    EXPECT_NE(after, before);
    EXPECT_EQ(after, drawn(hooked(lit, kRed), smallSettings())) << "as a renderer without another";
}

/// Without discontinuities, whose pixels would depend on rounding.
constexpr std::string_view kSmooth = R"({
    float wave = 0.5 + 0.5 * sin(hook.timeSeconds + 3.0 * inputs.positionOS.x + 2.0 * inputs.uv.y +
                                 float(inputs.instance));
    surface.color = mix(surface.color, vec3(0.25, wave, 0.75), hook.strength);
    surface.emission += hook.strength * vec3(0.1, 0.0, 0.2 * wave);
    surface.alpha = mix(surface.alpha, 0.5 + 0.3 * wave, hook.strength);
    surface.metallic = mix(surface.metallic, wave, hook.strength);
}
)";

class ReferenceOfHooks : public HookTest {
protected:
    void expectAgreement(const scenes::Scene& scene, double timeSeconds = 0.0) {
        engine::Renderer renderer(context(), scene);
        validation::CompareRequest request;
        request.techniques = {Technique::Forward};
        request.against = validation::Reference{};
        request.settings = smallSettings();
        request.settings.timeSeconds = timeSeconds;
        request.settings.filter = frame::TextureFilter::Exact;
        request.settings.refraction = frame::Refraction::Environment; // other modes depend on the image
        request.hardwareFilter = false;
        const auto pairs = validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
        ASSERT_EQ(pairs.size(), 1u);
        EXPECT_TRUE(pairs[0].tolerance.p999Rel && pairs[0].tolerance.relMse && pairs[0].tolerance.bias);
        EXPECT_TRUE(pairs[0].verdict.ok) << testing::PrintToString(pairs[0].verdict.missed);
    }
};

TEST_F(ReferenceOfHooks, itShowsWhatTheyChange) {
    for (const scenes::Scene& scene : {everythingScene(), evenScene()}) {
        const scenes::Scene changed = hooked(scene, kSmooth);
        for (const double seconds : {0.0, 1.5}) expectAgreement(changed, seconds);
        engine::Renderer renderer(context(), changed);
        const frame::FrameSettings settings = smallSettings();
        EXPECT_NE(strictRadiance(renderer, settings), strictRadiance(scene, settings));
    }
}

TEST_F(ReferenceOfHooks, lightThatPassesThroughGlassKeepsTheMaterialsColour) {
    scenes::Scene scene = evenScene();
    scenes::Material glass = metalOf(0.6);
    glass.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
    glass.metallic = 0.2f;
    glass.transmission = 0.8f;
    scene.nodes.back().instances.front().material = int(scene.materials.size());
    scene.materials.push_back(glass);
    expectAgreement(hooked(scene, kSmooth));
}

TEST_F(ReferenceOfHooks, oneThatMovesVerticesAndChangesThemIsTakenWhole) {
    scenes::Scene scene = hooked(evenScene(), kSmooth);
    setText(*scene.hook, std::string(kSurfaceHeader).append(kSmooth).append(kVertexHeader) +
                             "{\n    positionOS += 0.1 * sin(hook.timeSeconds + 5.0 * positionOS.yzx);\n}\n");
    scene.hook->movesVertices = true;
    scene.hook->mayMoveMetres = 0.2;
    scenes::checkScene(scene);
    expectAgreement(scene, 0.75);
}

TEST_F(ReferenceOfHooks, diffusionBelowWhatTheyChangeIsRefusedByName) {
    const scenes::Scene scene = hooked(everythingScene(), kSmooth);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = smallSettings();
    settings.subsurface = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    EXPECT_THAT([&] { validation::referencePicture(renderer, settings); },
                ThrowsMessage<InputError>(HasSubstr("the reference diffuses no light below")));
}

} // namespace
} // namespace tessera
