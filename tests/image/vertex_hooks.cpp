// Hooks that move vertices: passes and techniques, their bound, and the reference.
#include <gmock/gmock.h>

#include "base/Error.h"
#include "tests/image/HookTest.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter;
using testing::HasSubstr, testing::ThrowsMessage;
using namespace test;

class VertexHooks : public HookTest {
protected:
    scenes::Scene moving(const scenes::Scene& scene, std::string_view body, double mayMoveMetres) {
        scenes::Scene result = hooked(scene, "{\n}\n");
        scenes::Hook& hook = *result.hook;
        setText(hook, std::string(kVertexHeader).append(body));
        hook.changesSurfaces = false;
        hook.movesVertices = true;
        hook.mayMoveMetres = mayMoveMetres;
        scenes::checkScene(result);
        return result;
    }
    static frame::FrameSettings shadowed(ShadowFilter filter) {
        frame::FrameSettings settings = smallSettings();
        settings.shadows = kAllLightsCast;
        settings.shadowFilter = filter;
        return settings;
    }
};

TEST_SWEEP(VertexHooks, oneThatMovesNothingChangesNoBit) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    const frame::FrameSettings settings = shadowed(ShadowFilter::Traced);
    EXPECT_EQ(drawn(moving(scene, "{\n}\n", 0.0), settings), drawn(scene, settings));
}

TEST_SWEEP(VertexHooks, everyPassDrawsWhatTheyMoveAsAMeshThatIsThere) {
    scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
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

TEST_SWEEP(VertexHooks, everyTechniqueDrawsThemAlikeAtAnyTimeInAnyOrder) {
    const scenes::Scene still = isWholeSweep() ? evenScene() : metalScene();
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
    expectParity(renderer, settings, techniquesInTurn(0));
}

/// A quad moved by its own texture coordinates is the quad whose vertices lie there.
TEST_F(VertexHooks, theyGetTheTextureCoordinatesOfTheirVertex) {
    scenes::Scene scene = quadScene(unlit()), there = scene;
    scenes::Mesh& mesh = there.meshes[0];
    ASSERT_FALSE(mesh.texCoords[0].empty());
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i)
        mesh.positionsOS[i] += glm::vec3(0.25f * mesh.texCoords[0][i].x, 0.125f * mesh.texCoords[0][i].y, 0.0f);
    EXPECT_EQ(
        drawn(moving(scene, "{\n    positionOS += vec3(0.25 * uv.x, 0.125 * uv.y, 0.0);\n}\n", 1.0), smallSettings()),
        drawn(there, smallSettings()));
    EXPECT_NE(drawn(there, smallSettings()), drawn(scene, smallSettings()));
}

TEST_F(VertexHooks, theReferenceTakesTheVerticesThatAFrameShows) {
    const scenes::Scene scene = moving(quadScene({}), "{\n    positionOS.x *= 0.5;\n}\n", 0.6);
    engine::Renderer renderer(context(), scene);
    const frame::FrameSettings settings = smallSettings();
    EXPECT_THROW(validation::referencePicture(scene, settings), InputError);
    const scenes::Scene& shown = renderer.sceneAt(settings.timeSeconds);
    EXPECT_EQ(shown.meshes[0].positionsOS[0].x, 0.5f * scene.meshes[0].positionsOS[0].x);
    const std::vector<std::uint8_t> covered = validation::referencePicture(shown, settings).picture.covered;
    EXPECT_EQ(engine::toPicture(renderer.render(Technique::Forward, settings)).covered, covered);
}

TEST_F(VertexHooks, viewsOfAFrameShowOneTime) {
    const scenes::Scene scene = moving(quadScene({}), "{\n    positionOS.z += 0.1 * hook.timeSeconds;\n}\n", 1.0);
    engine::Renderer renderer(context(), scene);
    std::vector<engine::ViewRequest> views(2, {Technique::Forward, smallSettings()});
    EXPECT_NO_THROW(renderer.draw(views));
    views[1].settings.timeSeconds = 1.0;
    EXPECT_THAT([&] { renderer.draw(views); }, ThrowsMessage<InputError>(HasSubstr("give all of them one time")));
}

TEST_F(VertexHooks, aVertexThatGoesTooFarOrNowhereIsRefusedByName) {
    const struct {
        std::string_view body, says;
    } cases[] = {{"{\n    positionOS.y += 2.0;\n}\n", "by 2 m, and mayMoveMetres is 1"},
                 {"{\n    positionOS.y = sqrt(-1.0 - hook.timeSeconds);\n}\n", "to a position that is infinite or NaN"},
                 {"{\n    normalOS.y = sqrt(-1.0 - hook.timeSeconds);\n}\n", "a normal that is infinite or NaN"},
                 {"{\n    normalOS /= hook.timeSeconds;\n}\n", "a normal that is infinite or NaN"}};
    for (const auto& tried : cases) {
        const scenes::Scene scene = moving(quadScene({}), tried.body, 1.0);
        EXPECT_THAT([&] { drawn(scene, smallSettings()); },
                    ThrowsMessage<InputError>(testing::AllOf(
                        testing::ContainsRegex("^" + scene.hook->file + ": at 0 s hookVertex (moves|gives) vertex 0"),
                        HasSubstr(std::string(tried.says)))));
    }
}

TEST_F(VertexHooks, loopsThatAreEndedAreRefused) {
    const auto looping = [&](const char* rounds) {
        return moving(quadScene({}),
                      fmt::format("{{\n    float sum = 0.0;\n    for (float i = 0.0; i < {}; ++i) sum += 1.0;\n"
                                  "    positionOS.z += 1e-7 * sum;\n}}\n",
                                  rounds),
                      1.0);
    };
    EXPECT_NO_THROW(drawn(looping("60000.0"), smallSettings()));
    for (const char* rounds : {"60001.0", "1e6"})
        EXPECT_THAT([&] { drawn(looping(rounds), smallSettings()); },
                    ThrowsMessage<InputError>(HasSubstr("its loops take more than 60000 iterations")));
}

class MovedTooFar : public VertexHooks {
protected:
    /// Colour in the middle row, at a fraction of the image's width.
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
        {"{\n    normalOS.z = sqrt(-1.0 - hook.timeSeconds);\n}\n", {0.0f, 0.9f, 0.9f}, {0.0f, 0.9f, 0.9f}},
    };
    for (const auto& tried : cases) {
        const scenes::Scene scene = moving(quadScene(material), tried.body, 1.0);
        engine::Renderer renderer(context(), scene);
        for (const Technique technique : {Technique::Forward, Technique::Deferred})
            for (const auto& [share, wanted] : {std::pair(0.45, tried.left), std::pair(0.55, tried.right)}) {
                // Shaded 0.4 to 1 times as bright, by how the surface faces the eye.
                const glm::vec3 found = shown(renderer, technique, share);
                const float bright = std::max({found.r, found.g, found.b}),
                            most = std::max({wanted.r, wanted.g, wanted.b});
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(found[c] / bright, wanted[c] / most, 1e-3) << tried.body;
                    EXPECT_LE(found[c], wanted[c] + 0.003f) << tried.body;
                    EXPECT_GE(found[c], 0.39f * wanted[c]) << tried.body;
                }
            }
    }
}

TEST_F(MovedTooFar, onlyTheVerticesThatDoAreAndOtherFramesDoNotShowIt) {
    const scenes::Scene scene =
        moving(quadScene({}), "{\n    if (positionOS.x > 0.0) positionOS.z += hook.timeSeconds;\n}\n", 1.0);
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

// The hooks of scenes/files.

constexpr const char* kHookSamples[] = {"flag", "pulsating_lattice", "head_sick"};

/// Hooks of the sample scenes, at the limits of their parameters.
class SampleHooks : public HookTest {
protected:
    static scenes::Scene sample(std::string_view name) {
        return scenes::loadScene(fmt::format("{}/scenes/files/{}.json", TESSERA_SOURCE_DIR, name));
    }
};

TEST_SWEEP(SampleHooks, verticesStayWithinMayMoveMetres) {
    for (const char* name : kHookSamples) {
        SCOPED_TRACE(name);
        scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const bool most : {false, true}) {
            for (scenes::HookParameter& parameter : scene.hook->parameters)
                parameter.value = most ? parameter.most : parameter.least;
            for (int step = 0; step < 12; step += isWholeSweep() ? 1 : 3)
                EXPECT_NO_THROW(renderer.sceneAt(0.37 * step));
        }
    }
}

/// Whatever the sine of a billion is.
TEST_F(SampleHooks, verticesStayWithinMayMoveMetresAfterABillionSeconds) {
    for (const char* name : kHookSamples) {
        SCOPED_TRACE(name);
        const scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const double seconds : {1e9, -1e9}) EXPECT_NO_THROW(renderer.sceneAt(seconds));
    }
}

TEST_F(SampleHooks, everyParameterChangesThePicture) {
    for (const char* name : kHookSamples) {
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

} // namespace
} // namespace tessera
