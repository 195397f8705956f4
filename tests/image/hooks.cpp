#include <fmt/format.h>
#include <gmock/gmock.h>

#include "engine/Rendering.h"
#include "renderer/gpu/Program.h"
#include "scenes/Fingerprint.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TempFolder.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;
using testing::HasSubstr;

constexpr std::string_view kHeader = "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n";
/// Reads all there is to read, and changes all there is to change.
constexpr std::string_view kTint = R"({
    float wave = 0.5 + 0.5 * sin(hook.timeSeconds + 3.0 * inputs.positionOS.x + float(inputs.instance));
    surface.color = mix(surface.color, vec3(inputs.uv.x - floor(inputs.uv.x), wave, 2.0), hook.strength);
    surface.emission += hook.strength * vec3(0.1, 0.0, 0.2 * wave);
    surface.alpha *= 1.0 - 0.5 * hook.strength;
    surface.metallic = mix(surface.metallic, wave, hook.strength);
}
)";

class Hooks : public test::ShadowTest {
protected:
    scenes::Scene hooked(scenes::Scene scene, std::string_view body, float strength = 0.7f) {
        scenes::Hook& hook = scene.hook.emplace();
        const std::string text = std::string(kHeader).append(body);
        hook.file = folder.write(fmt::format("{}.glsl", files++), text).string();
        hook.contentHash = scenes::fingerprint(std::as_bytes(std::span(text)));
        for (std::size_t i = 0; i < scene.materials.size(); ++i) hook.materials.push_back(int(i));
        hook.parameters = {{"strength", strength, 0.0f, 1.0f}};
        scenes::checkScene(scene);
        return scene;
    }
    static frame::FrameSettings smallSettings() {
        frame::FrameSettings settings;
        settings.sizePixels = {160, 91};
        settings.diffusion = test::coarseDiffusion();
        return settings;
    }
    std::vector<float> drawn(const scenes::Scene& scene, const frame::FrameSettings& settings,
                             Technique technique = Technique::Forward) {
        return engine::Renderer(context(), scene).render(technique, settings).radiance;
    }

    test::TempFolder folder;
    int files = 0;
};

TEST_F(Hooks, oneThatChangesNothingChangesNoBit) {
    for (const scenes::Scene& scene : {test::everythingScene(), test::evenScene()}) {
        const scenes::Scene same = hooked(scene, "{\n}\n");
        for (const Technique technique : {Technique::Forward, Technique::Deferred, Technique::ClusteredDeferred}) {
            frame::FrameSettings settings = smallSettings();
            EXPECT_EQ(drawn(same, settings, technique), drawn(scene, settings, technique)) << int(technique);
            settings.filter = frame::TextureFilter::Exact;
            EXPECT_EQ(drawn(same, settings, technique), drawn(scene, settings, technique)) << int(technique);
        }
    }
}

TEST_F(Hooks, everyTechniqueDrawsWhatTheyChangeAlike) {
    struct Case {
        scenes::Scene scene;
        frame::TextureFilter filter;
        bool castsShadows, prune;
    };
    for (const auto& [scene, filter, castsShadows, prune] :
         {Case{test::everythingScene(), frame::TextureFilter::Exact, false, true},
          Case{test::evenScene(), frame::TextureFilter::Hardware, true, false}}) {
        const scenes::Scene tinted = hooked(scene, kTint);
        engine::Renderer renderer(context(), tinted);
        frame::FrameSettings settings = smallSettings();
        settings.timeSeconds = 0.3;
        settings.filter = filter;
        if (castsShadows) settings.shadows = test::kAllLightsCast;
        settings.prune = prune;
        EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, drawn(scene, settings));
        expectParity(renderer, settings);
    }
}

TEST_F(Hooks, onlyTheMaterialsThatTheyNameChange) {
    scenes::Scene scene = test::quadScene({});
    const std::vector<float> before = drawn(scene, smallSettings());
    scene = hooked(scene, "{\n    surface.emission += vec3(0.25);\n}\n");
    EXPECT_NE(drawn(scene, smallSettings()), before);
    scene.hook->materials.clear();
    EXPECT_EQ(drawn(scene, smallSettings()), before);
}

TEST_F(Hooks, timeAndParametersChangeThePictureAndCompileNothing) {
    scenes::Scene scene = hooked(test::everythingScene(), kTint);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = smallSettings();
    settings.prune = false; // else which of the moving lights reach what is in view decides on programs too
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

TEST_F(Hooks, aFaultNamesFileAndLineAndLeavesOtherScenesAlone) {
    const scenes::Scene faulty = hooked(test::evenScene(), "{\n    surface.color = undeclaredName;\n}\n");
    try {
        drawn(faulty, smallSettings());
        FAIL() << "expected a ShaderError";
    } catch (const gpu::ShaderError& error) {
        EXPECT_THAT(error.what(), HasSubstr(faulty.hook->file + ":3: error"));
    }
    EXPECT_NO_THROW(drawn(test::evenScene(), smallSettings()));
}

TEST_F(Hooks, whatTheyDefineChangesNothingBeforeThem) {
    const scenes::Scene scene = test::evenScene();
    const std::vector<float> before = drawn(scene, smallSettings());
    scenes::Scene defining =
        hooked(scene, "{\n}\n#define material 0\n#define max min\nfloat helper() { return 1.0; }\n");
    EXPECT_EQ(drawn(defining, smallSettings()), before);
}

TEST_F(Hooks, anEditShowsAndAFaultyOneKeepsTheLastGoodForm) {
    const scenes::Scene scene = hooked(test::evenScene(), "{\n}\n");
    engine::Renderer renderer(context(), scene);
    const std::vector<float> before = renderer.render(Technique::Deferred, smallSettings()).radiance;
    renderer.programs().sourcesChanged();
    EXPECT_FALSE(renderer.programs().sourcesChanged());
    const std::string name = std::filesystem::path(scene.hook->file).filename().string();
    folder.write(name, std::string(kHeader).append("{ surface.color = vec3(0.0) }\n"));
    const auto time = std::filesystem::last_write_time(scene.hook->file) + std::chrono::hours(1);
    std::filesystem::last_write_time(scene.hook->file, time);
    EXPECT_TRUE(renderer.programs().sourcesChanged());
    const std::vector<std::string> faults = renderer.programs().reload();
    ASSERT_FALSE(faults.empty());
    EXPECT_THAT(faults.front(), HasSubstr(scene.hook->file + ":2: error"));
    EXPECT_EQ(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
    folder.write(name, std::string(kHeader).append("{ surface.color = vec3(0.0); }\n"));
    EXPECT_TRUE(renderer.programs().reload().empty());
    EXPECT_NE(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
}

} // namespace
} // namespace tessera
