#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/Rendering.h"
#include "renderer/gpu/Program.h"
#include "scenes/Fingerprint.h"
#include "scenes/Load.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/Sweep.h"
#include "tests/support/TempFolder.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
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

    /// With each technique and filter, or every other technique of both scenes with one filter in turn.
    void expectNoChange();
    /// Of a scene of everything and an even one with every technique, or of metal with each second one, and the even
    /// one with one.
    void expectTechniquesAgree();

    test::TempFolder folder;
    int files = 0;
};
using HooksSlow = Hooks;

void Hooks::expectNoChange() {
    constexpr frame::TextureFilter kFilters[] = {frame::TextureFilter::Hardware, frame::TextureFilter::Exact};
    std::size_t turn = 0, pairs = 0;
    for (const scenes::Scene& scene : {test::everythingScene(), test::evenScene()}) {
        const scenes::Scene same = hooked(scene, "{\n}\n");
        for (const Technique technique : {Technique::Forward, Technique::Deferred, Technique::ClusteredDeferred}) {
            if (!test::isWholeSweep() && pairs++ % 2 != 0) continue;
            for (const frame::TextureFilter filter : test::inTurn(kFilters, turn++)) {
                frame::FrameSettings settings = smallSettings();
                settings.filter = filter;
                EXPECT_EQ(drawn(same, settings, technique), drawn(scene, settings, technique))
                    << int(technique) << ' ' << int(filter);
            }
        }
    }
}
TEST_F(Hooks, oneThatChangesNothingChangesNoBit) {
    expectNoChange();
}
TEST_F(HooksSlow, oneThatChangesNothingChangesNoBit) {
    expectNoChange();
}

void Hooks::expectTechniquesAgree() {
    struct Case {
        scenes::Scene scene;
        frame::TextureFilter filter;
        bool castsShadows, prune;
        std::size_t every; ///< of the techniques, where they are taken in turn
    };
    const scenes::Scene first = test::isWholeSweep() ? test::everythingScene() : test::metalScene();
    for (const auto& [scene, filter, castsShadows, prune, every] :
         {Case{first, frame::TextureFilter::Exact, false, true, 2},
          Case{test::evenScene(), frame::TextureFilter::Hardware, true, false, 6}}) {
        const scenes::Scene tinted = hooked(scene, kTint);
        engine::Renderer renderer(context(), tinted);
        frame::FrameSettings settings = smallSettings();
        settings.timeSeconds = 0.3;
        settings.filter = filter;
        if (castsShadows) settings.shadows = test::kAllLightsCast;
        settings.prune = prune;
        EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, drawn(scene, settings));
        expectParity(renderer, settings, test::techniquesInTurn(1, 1, every));
    }
}
TEST_F(Hooks, everyTechniqueDrawsWhatTheyChangeAlike) {
    expectTechniquesAgree();
}
TEST_F(HooksSlow, everyTechniqueDrawsWhatTheyChangeAlike) {
    expectTechniquesAgree();
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

TEST_F(Hooks, everyParameterArrivesUnderItsName) {
    scenes::Scene scene =
        hooked(test::quadScene({}), "{\n    surface.emission = vec3(hook.p0, hook.p6, hook.p14);\n}\n");
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
    scenes::Material material;
    material.model = scenes::MaterialModel::Lambert;
    const scenes::Scene scene = test::quadScene(material);
    const scenes::Scene dark = hooked(scene, "{\n    surface.emission = vec3(-1.0, 0.5, -2.0);\n}\n");
    const frame::FrameSettings settings = smallSettings();
    for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
        const std::vector<float> radiance = drawn(dark, settings, technique);
        const std::size_t middle = 4 * (std::size_t(settings.sizePixels.x) * 45 + 80);
        EXPECT_EQ(radiance[middle], 0.0f);
        EXPECT_EQ(radiance[middle + 1], 0.5f);
        EXPECT_EQ(radiance[middle + 2], 0.0f);
    }
}

TEST_F(Hooks, aFaultNamesFileAndLineAndLeavesOtherScenesAlone) {
    const scenes::Scene faulty = hooked(test::evenScene(), "{\n    surface.color = undeclaredName;\n}\n");
    try {
        drawn(faulty, smallSettings());
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
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
    const std::vector<shader::ShaderFault> faults = renderer.programs().reload().faults;
    ASSERT_FALSE(faults.empty());
    EXPECT_THAT(faults.front().text, HasSubstr(scene.hook->file + ":2: error"));
    EXPECT_EQ(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
    folder.write(name, std::string(kHeader).append("{ discard; }\n")); // which a driver takes
    const std::vector<shader::ShaderFault> holes = renderer.programs().reload().faults;
    ASSERT_FALSE(holes.empty());
    EXPECT_THAT(holes.front().text, HasSubstr(scene.hook->file + ":2: discard: a hook makes no holes"));
    EXPECT_EQ(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
    folder.write(name, std::string(kHeader).append("{ surface.color = vec3(0.0); }\n"));
    EXPECT_TRUE(renderer.programs().reload().faults.empty());
    EXPECT_NE(renderer.render(Technique::Deferred, smallSettings()).radiance, before);
}

/// Without steps, whose pixels rounding would decide.
constexpr std::string_view kSmooth = R"({
    float wave = 0.5 + 0.5 * sin(hook.timeSeconds + 3.0 * inputs.positionOS.x + 2.0 * inputs.uv.y +
                                 float(inputs.instance));
    surface.color = mix(surface.color, vec3(0.25, wave, 0.75), hook.strength);
    surface.emission += hook.strength * vec3(0.1, 0.0, 0.2 * wave);
    surface.alpha = mix(surface.alpha, 0.5 + 0.3 * wave, hook.strength);
    surface.metallic = mix(surface.metallic, wave, hook.strength);
}
)";

class ReferenceOfHooks : public Hooks {
protected:
    void expectAgreement(const scenes::Scene& scene, double timeSeconds = 0.0) {
        engine::Renderer renderer(context(), scene);
        validation::CompareRequest request;
        request.techniques = {Technique::Forward};
        request.against = validation::Reference{};
        request.settings = smallSettings();
        request.settings.timeSeconds = timeSeconds;
        request.settings.filter = frame::TextureFilter::Exact;
        request.hardwareFilter = false;
        const auto pairs = validation::compareTechniques(renderer, context().capabilities(), request).record.pairs;
        ASSERT_EQ(pairs.size(), 1u);
        EXPECT_TRUE(pairs[0].tolerance.p999Rel && pairs[0].tolerance.relMse && pairs[0].tolerance.bias);
        EXPECT_TRUE(pairs[0].verdict.ok) << testing::PrintToString(pairs[0].verdict.missed);
    }
};

TEST_F(ReferenceOfHooks, itShowsWhatTheyChange) {
    for (const scenes::Scene& scene : {test::everythingScene(), test::evenScene()}) {
        const scenes::Scene changed = hooked(scene, kSmooth);
        for (const double seconds : {0.0, 1.5}) expectAgreement(changed, seconds);
        engine::Renderer renderer(context(), changed);
        const frame::FrameSettings settings = smallSettings();
        const auto shown = validation::referencePicture(
            renderer, settings, [] {}, validation::Leeway::None);
        EXPECT_NE(shown.picture.rgba, validation::referencePicture(
                                          scene, settings, [] {}, validation::Leeway::None)
                                          .picture.rgba);
    }
}

TEST_F(ReferenceOfHooks, lightThatPassesThroughGlassKeepsTheMaterialsColour) {
    scenes::Scene scene = test::evenScene();
    scenes::Material glass;
    glass.model = scenes::MaterialModel::MetallicRoughness;
    glass.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
    glass.metallic = 0.2f;
    glass.perceptualRoughness = 0.6f;
    glass.transmission = 0.8f;
    scene.nodes.back().instances.front().material = int(scene.materials.size());
    scene.materials.push_back(glass);
    expectAgreement(hooked(scene, kSmooth));
}

TEST_F(ReferenceOfHooks, oneThatMovesVerticesAndChangesThemIsTakenWhole) {
    scenes::Scene scene = hooked(test::evenScene(), kSmooth);
    const std::string text = std::string(kHeader).append(kSmooth) +
                             "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)\n"
                             "{\n    positionOS += 0.1 * sin(hook.timeSeconds + 5.0 * positionOS.yzx);\n}\n";
    scene.hook->file = folder.write("both.glsl", text).string();
    scene.hook->contentHash = scenes::fingerprint(std::as_bytes(std::span(text)));
    scene.hook->movesVertices = true;
    scene.hook->mayMoveMetres = 0.2;
    scenes::checkScene(scene);
    expectAgreement(scene, 0.75);
}

TEST_F(ReferenceOfHooks, lightThatSpreadsBelowWhatTheyChangeIsRefusedByName) {
    const scenes::Scene scene = hooked(test::everythingScene(), kSmooth);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = smallSettings();
    settings.subsurface = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    try {
        validation::referencePicture(renderer, settings);
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the reference knows no light that spreads below"));
    }
}

constexpr std::string_view kMoving = "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)\n";

class VertexHooks : public Hooks {
protected:
    scenes::Scene moving(const scenes::Scene& scene, std::string_view body, double mayMoveMetres) {
        scenes::Scene result = hooked(scene, "{\n}\n");
        scenes::Hook& hook = *result.hook;
        const std::string text = std::string(kMoving).append(body);
        hook.file = folder.write(fmt::format("{}.glsl", files++), text).string();
        hook.contentHash = scenes::fingerprint(std::as_bytes(std::span(text)));
        hook.changesSurfaces = false;
        hook.movesVertices = true;
        hook.mayMoveMetres = mayMoveMetres;
        scenes::checkScene(result);
        return result;
    }
    static frame::FrameSettings shadowed(ShadowFilter filter) {
        frame::FrameSettings settings = smallSettings();
        settings.shadows = test::kAllLightsCast;
        settings.shadowFilter = filter;
        return settings;
    }
    /// Of a scene of everything, or of its metal.
    void expectNoMoveNoChange();
    void expectMovedAsAMesh();
    /// Of a scene of materials that do not vary, or of metal.
    void expectAlikeAtAnyTime();
};
using VertexHooksSlow = VertexHooks;

void VertexHooks::expectNoMoveNoChange() {
    const scenes::Scene scene = test::isWholeSweep() ? test::everythingScene() : test::metalScene();
    const frame::FrameSettings settings = shadowed(ShadowFilter::Traced);
    EXPECT_EQ(drawn(moving(scene, "{\n}\n", 0.0), settings), drawn(scene, settings));
}
TEST_F(VertexHooks, oneThatMovesNothingChangesNoBit) {
    expectNoMoveNoChange();
}
TEST_F(VertexHooksSlow, oneThatMovesNothingChangesNoBit) {
    expectNoMoveNoChange();
}

void VertexHooks::expectMovedAsAMesh() {
    scenes::Scene scene = test::isWholeSweep() ? test::everythingScene() : test::metalScene();
    const scenes::Scene hook =
        moving(scene, "{\n    positionOS += vec3(0.25, 0.0, 0.125);\n    normalOS = normalOS.yzx;\n}\n", 0.3);
    for (scenes::Mesh& mesh : scene.meshes) {
        for (glm::vec3& position : mesh.positionsOS) position += glm::vec3(0.25f, 0.0f, 0.125f);
        for (glm::vec3& normal : mesh.normalsOS)
            normal = glm::vec3(glm::dvec3(normal.y, normal.z, normal.x) / glm::length(glm::dvec3(normal)));
    }
    for (const ShadowFilter filter : {ShadowFilter::Traced, ShadowFilter::Hard}) {
        const frame::FrameSettings settings = shadowed(filter);
        for (const Technique technique : {Technique::ForwardPrepass, Technique::ClusteredDeferred})
            EXPECT_EQ(drawn(hook, settings, technique), drawn(scene, settings, technique)) << int(technique);
    }
}
TEST_F(VertexHooks, everyPassDrawsWhatTheyMoveAsAMeshThatIsThere) {
    expectMovedAsAMesh();
}
TEST_F(VertexHooksSlow, everyPassDrawsWhatTheyMoveAsAMeshThatIsThere) {
    expectMovedAsAMesh();
}

void VertexHooks::expectAlikeAtAnyTime() {
    const scenes::Scene still = test::isWholeSweep() ? test::evenScene() : test::metalScene();
    const scenes::Scene scene =
        moving(still, "{\n    positionOS += 0.1 * sin(hook.timeSeconds + 5.0 * positionOS.yzx);\n}\n", 0.2);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = shadowed(ShadowFilter::Traced);
    settings.timeSeconds = 0.5;
    const std::vector<float> first = renderer.render(Technique::Forward, settings).radiance;
    settings.timeSeconds = 2.0;
    EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, first);
    settings.timeSeconds = 0.5;
    EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, first);
    EXPECT_EQ(drawn(scene, settings), first);
    expectParity(renderer, settings, test::techniquesInTurn(0));
}
TEST_F(VertexHooks, everyTechniqueDrawsThemAlikeAtAnyTimeInAnyOrder) {
    expectAlikeAtAnyTime();
}
TEST_F(VertexHooksSlow, everyTechniqueDrawsThemAlikeAtAnyTimeInAnyOrder) {
    expectAlikeAtAnyTime();
}

TEST_F(VertexHooks, theReferenceTakesTheVerticesThatAFrameShows) {
    const scenes::Scene scene = moving(test::quadScene({}), "{\n    positionOS.x *= 0.5;\n}\n", 0.6);
    engine::Renderer renderer(context(), scene);
    const frame::FrameSettings settings = smallSettings();
    EXPECT_THROW(validation::referencePicture(scene, settings), InputError);
    const scenes::Scene& shown = renderer.sceneAt(settings.timeSeconds);
    EXPECT_EQ(shown.meshes[0].positionsOS[0].x, 0.5f * scene.meshes[0].positionsOS[0].x);
    const std::vector<std::uint8_t> covered = validation::referencePicture(shown, settings).picture.covered;
    EXPECT_EQ(engine::toPicture(renderer.render(Technique::Forward, settings)).covered, covered);
}

class MovedTooFar : public VertexHooks {
protected:
    /// Colour of the middle of a half of the picture.
    glm::vec3 shown(engine::Renderer& renderer, Technique technique, double share) {
        frame::FrameSettings settings = smallSettings();
        settings.view = frame::DebugView::MovedTooFar;
        const std::vector<float> radiance = renderer.render(technique, settings).radiance;
        const std::size_t pixel = 4 * (160 * 45 + std::size_t(160 * share));
        return {radiance[pixel], radiance[pixel + 1], radiance[pixel + 2]};
    }
};

TEST_F(MovedTooFar, verticesThatLeaveTheirBoundArePaintedAndTheFrameIsDrawn) {
    scenes::Material material;
    material.baseColor = {0.0f, 1.0f, 0.0f, 1.0f};
    const struct {
        std::string_view body;
        glm::vec3 left, right;
    } cases[] = {
        {"{\n    positionOS.z += 0.5;\n}\n", glm::vec3(0.4f), glm::vec3(0.4f)},
        {"{\n    positionOS.z += 1.5;\n}\n", {0.9f, 0.0f, 0.9f}, {0.9f, 0.0f, 0.9f}},
        {"{\n    positionOS.z = sqrt(-1.0 - hook.timeSeconds);\n}\n", {0.0f, 0.9f, 0.9f}, {0.0f, 0.9f, 0.9f}},
    };
    for (const auto& tried : cases) {
        const scenes::Scene scene = moving(test::quadScene(material), tried.body, 1.0);
        engine::Renderer renderer(context(), scene);
        for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
            for (const auto& [share, wanted] : {std::pair(0.45, tried.left), std::pair(0.55, tried.right)}) {
                // Between them 0.4 and 1 times as bright, by how a surface faces the eye.
                const glm::vec3 found = shown(renderer, technique, share);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_LE(found[c], wanted[c] + 0.003f) << tried.body;
                    EXPECT_GE(found[c], 0.39f * wanted[c]) << tried.body;
                }
            }
        }
    }
}

TEST_F(MovedTooFar, onlyTheVerticesThatDoAreAndOtherFramesDoNotShowIt) {
    const scenes::Scene scene =
        moving(test::quadScene({}), "{\n    if (positionOS.x > 0.0) positionOS.z += hook.timeSeconds;\n}\n", 1.0);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = smallSettings();
    const std::vector<float> before = renderer.render(Technique::Forward, settings).radiance;
    settings.view = frame::DebugView::MovedTooFar;
    settings.timeSeconds = 1.25;
    const std::vector<float> painted = renderer.render(Technique::Forward, settings).radiance;
    std::size_t reddish = 0, grey = 0;
    for (std::size_t i = 0; i < painted.size(); i += 4) {
        if (painted[i + 3] == 0.0f) continue;
        ++(painted[i] > 1.5f * painted[i + 1] ? reddish : grey);
    }
    EXPECT_GT(reddish, 100u);
    EXPECT_GT(grey, 100u);
    settings.view = frame::DebugView::Final;
    EXPECT_THROW(renderer.render(Technique::Forward, settings), InputError);
    settings.timeSeconds = 0.0;
    EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, before);
}

/// Of scenes/files, at the ends of their parameters.
class SampleHooks : public Hooks {
protected:
    static scenes::Scene sample(std::string_view name) {
        return scenes::loadScene(fmt::format("{}/scenes/files/{}.json", TESSERA_SOURCE_DIR, name));
    }
    /// At twelve times, or at each third of them.
    void expectWithinMayMoveMetres();
};
using SampleHooksSlow = SampleHooks;

void SampleHooks::expectWithinMayMoveMetres() {
    for (const char* name : {"flag", "pulsating_lattice", "head_sick"}) {
        SCOPED_TRACE(name);
        scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const bool most : {false, true}) {
            for (scenes::HookParameter& parameter : scene.hook->parameters)
                parameter.value = most ? parameter.most : parameter.least;
            for (int step = 0; step < 12; step += test::isWholeSweep() ? 1 : 3)
                EXPECT_NO_THROW(renderer.sceneAt(0.37 * step));
        }
    }
}

TEST_F(SampleHooks, verticesStayWithinMayMoveMetres) {
    expectWithinMayMoveMetres();
}
TEST_F(SampleHooksSlow, verticesStayWithinMayMoveMetres) {
    expectWithinMayMoveMetres();
}

/// Whatever sines become of a billion.
TEST_F(SampleHooks, verticesStayWithinMayMoveMetresAfterABillionSeconds) {
    for (const char* name : {"flag", "pulsating_lattice", "head_sick"}) {
        SCOPED_TRACE(name);
        const scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const double seconds : {1e9, -1e9}) EXPECT_NO_THROW(renderer.sceneAt(seconds));
    }
}

TEST_F(SampleHooks, everyParameterChangesThePicture) {
    for (const char* name : {"flag", "pulsating_lattice", "head_sick"}) {
        scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = smallSettings();
        settings.timeSeconds = 2.9;
        settings.subsurface = scenes::SubsurfaceMethod::None;
        const std::vector<float> before = renderer.render(Technique::Forward, settings).radiance;
        for (scenes::HookParameter& parameter : scene.hook->parameters) {
            const float value = std::exchange(parameter.value, parameter.most);
            EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, before) << name << ' ' << parameter.name;
            parameter.value = value;
        }
        EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, before) << name;
    }
}

TEST_F(VertexHooks, viewsOfAFrameShowOneTime) {
    const scenes::Scene scene = moving(test::quadScene({}), "{\n    positionOS.z += 0.1 * hook.timeSeconds;\n}\n", 1.0);
    engine::Renderer renderer(context(), scene);
    std::vector<engine::ViewRequest> views(2, {Technique::Forward, smallSettings()});
    EXPECT_NO_THROW(renderer.draw(views));
    views[1].settings.timeSeconds = 1.0;
    try {
        renderer.draw(views);
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("give all of them one time"));
    }
}

TEST_F(VertexHooks, aVertexThatGoesTooFarOrNowhereIsRefusedByName) {
    const struct {
        std::string_view body, says;
    } cases[] = {
        {"{\n    positionOS.y += 2.0;\n}\n", "by 2 m, and mayMoveMetres is 1"},
        {"{\n    positionOS.y = sqrt(-1.0 - hook.timeSeconds);\n}\n", "to where a number is infinite or none"}};
    for (const auto& tried : cases) {
        const scenes::Scene scene = moving(test::quadScene({}), tried.body, 1.0);
        try {
            drawn(scene, smallSettings());
            FAIL() << "expected an InputError";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(scene.hook->file + ": at 0 s hookVertex moves vertex 0"));
            EXPECT_THAT(error.what(), HasSubstr(tried.says));
        }
    }
}

} // namespace
} // namespace tessera
