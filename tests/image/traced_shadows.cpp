#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using namespace test;

class Shadows : public ShadowTest {};
using ShadowsSlow = Shadows;

/// Masked, transparent and mirrored surfaces.
scenes::Scene sceneOfCasters() {
    return isWholeSweep() ? everythingScene() : lambertScene();
}

/// Adds a square of two triangles.
void addFloor(scenes::Scene& scene, const glm::dvec3& middleOS, double sideMetres) {
    scenes::Mesh floor;
    scenes::builtin::appendFloor(floor, middleOS, glm::dvec2(sideMetres), glm::ivec2(1));
    scene.meshes.push_back(std::move(floor));
    scene.nodes[0].instances.push_back({std::int32_t(scene.meshes.size()) - 1, 0});
}

/// A small image of the first light alone.
frame::FrameSettings shadowsOfTheFirstLight() {
    frame::FrameSettings settings = withShadows(ofSize(128, 72));
    settings.soloLight = 0;
    return settings;
}

TEST_SWEEP(Shadows, everyTechniqueCastsTheSameToTheLastBit) {
    std::size_t turn = 0;
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(201, 113);
        settings.shadows = tried.shadows;
        SCOPED_TRACE(tried.scene);
        expectParity(renderer, settings, techniquesInTurn(turn++));
    }
}

TEST_SWEEP(Shadows, everyTechniqueCastsTheSameOnMaskedAndTransparentSurfacesAndWithSeveralSamples) {
    const scenes::Scene scene = sceneOfCasters();
    engine::Renderer renderer(context(), scene);
    for (const int samples : {1, 4}) {
        frame::FrameSettings settings = withSamples(withShadows(ofSize(160, 90)), samples);
        expectParity(renderer, settings, techniquesInTurn(std::size_t(samples) / 4, samples));
    }
}

/// A size at which triangles of the hall are as small as a pixel.
frame::FrameSettings hallWithRunsBeside() {
    return ofSize(980, 778);
}

// Beside a triangle of one pixel, the rasteriser runs helper invocations, whose rays meet all boxes of the tree.
TEST_F(Shadows, aPixelIsLitByAllItsLightsWhateverIsRunBesideIt) {
    const scenes::Scene scene = scenes::loadScene("hall");
    engine::Renderer renderer(context(), scene);
    const auto radiance = renderer.render(engine::Technique::ClusteredForward, hallWithRunsBeside()).radiance;
    EXPECT_TRUE(std::ranges::all_of(radiance, [](float value) { return std::isfinite(value); }));
}
TEST_F(ShadowsSlow, aPixelIsLitByAllItsLightsWhateverIsRunBesideItAndElseIsNaN) {
    const scenes::Scene scene = scenes::loadScene("hall");
    const frame::FrameSettings settings = hallWithRunsBeside();
    engine::Renderer renderer(context(), scene);
    const auto radiance = renderer.render(engine::Technique::ClusteredForward, settings).radiance;
    EXPECT_EQ(radiance, renderer.render(engine::Technique::ClusteredDeferred, settings).radiance);
    // If such rays are walked after all, Mesa ends the pixel's loops: it is NaN, and not dark.
    const ShaderMutant shaders("lib/shadow/caster_walk.glsl", "isBehind || IS_HELPER ?", "isBehind ?");
    engine::Renderer faulty(context(), scene, shaders.tree());
    const auto ended = faulty.render(engine::Technique::ClusteredForward, settings).radiance;
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < ended.size(); ++i) {
        if (ended[i] == radiance[i]) continue;
        EXPECT_TRUE(std::isnan(ended[i]));
        ++unlike;
    }
    EXPECT_GT(unlike, 0u) << "nothing was run beside a pixel";
}

TEST_F(Shadows, noPixelIsWrongBeyondRounding) {
    for (const ShadowCase& tried : kShadowCases) {
        const scenes::Scene scene = sceneOf(tried);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = settingsOf(tried);
        for (const auto terminator : {frame::ShadowTerminator::Exact, frame::ShadowTerminator::Softened}) {
            settings.shadowTerminator = terminator;
            const bool isExact = terminator == frame::ShadowTerminator::Exact;
            const std::string name = fmt::format("{}, {}", tried.scene, isExact ? "exact" : "softened");
            const WrongPixels count = wrongPixels(renderer, settings);
            fmt::print("{}: {}\n", name, count.text());
            EXPECT_EQ(count.wrong, 0u) << name;
            EXPECT_LE(count.wrongWithout, count.covered / 1000) << name;
            const double measured = isExact ? tried.undecidedShare : tried.softenedShare;
            EXPECT_LE(double(count.undecided), 1.5 * measured * double(count.covered)) << name;
            EXPECT_GE(count.hidden, count.covered / 200) << name << ": nothing to see";
        }
    }
}

// With all lights on, errors of a dim one would be invisible.
/// All lights of the hall that cast shadows, or every fourth of them.
TEST_SWEEP(Shadows, ofEachLightOfTheHallAloneNoPixelIsWrong) {
    const ShadowCase& hall = kShadowCases[2];
    const scenes::Scene scene = sceneOf(hall);
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = settingsOf(hall);
    settings.sizePixels = {120, 68};
    WrongPixels all;
    int lights = 0;
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
        if (!scenes::castsShadow(scene, light, hall.shadows)) continue;
        if (++lights % 4 != 1 && !isWholeSweep()) continue;
        settings.soloLight = int(light);
        const WrongPixels count = wrongPixels(renderer, settings);
        EXPECT_EQ(count.wrong, 0u) << "light " << light;
        all += count;
    }
    fmt::print("{} lights: {} pixels wrong, {} undecided, {} changed by shadows of {} reached\n", lights, all.wrong,
               all.undecided, all.hidden, all.reached);
    EXPECT_EQ(lights, 17);
    EXPECT_LE(all.wrongWithout, all.covered / 1000);
    if (isWholeSweep()) {
        // Measured: 0.25 %.
        EXPECT_LE(double(all.undecided), 0.0038 * double(all.reached));
        EXPECT_GE(all.hidden, all.reached / 2) << "nothing to see";
    } else {
        // Single lights differ.
        EXPECT_LE(all.undecided, all.reached / 100);
        EXPECT_GE(all.hidden, all.reached / 10) << "nothing to see";
    }
}

TEST_SWEEP(Shadows, noPixelOfMaskedMirroredAndTexturedSurfacesIsWrong) {
    const scenes::Scene scene = sceneOfCasters();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = isWholeSweep() ? glm::ivec2(240, 135) : glm::ivec2(160, 90);
    settings.filter = frame::TextureFilter::Exact;
    settings.shadows = kAllLightsCast;
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("{}: {}\n", scene.name, count.text());
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.wrongWithout, count.covered / 1000);
    // Measured: 0.43 %.
    EXPECT_LE(double(count.undecided), 0.0064 * double(count.covered));
    EXPECT_GE(count.hidden, count.covered / 20);
}

TEST_SWEEP(Shadows, noSunPutsAcneOnASphereAndAPlane) {
    scenes::Scene scene = ballUnderSun();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(64, 36));
    const int suns = isWholeSweep() ? 1000 : 250;
    const WrongPixels count = wrongUnderSuns(renderer, scene, settings, suns);
    fmt::print("{} suns: {}\n", suns, count.text());
    EXPECT_EQ(count.wrong, 0u);
    // Measured: 0.06 %.
    EXPECT_LE(double(count.undecided), 0.0009 * double(count.covered));
}

// A model may contain a stray triangle. It must not cost all others their precision, neither here nor in the reference.
TEST_F(Shadows, aStrayTriangleFarAwayHidesAndRevealsNothing) {
    scenes::Scene scene = ballUnderSun();
    scene.lights[0].directionWS = {-0.4, -0.8, -0.3};
    const frame::FrameSettings settings = shadowsOfTheFirstLight();
    const auto expectTheSame = [&](float angle, std::initializer_list<float> strays) {
        scene.lights[0].angularRadiusRadians = angle;
        scene.meshes.resize(2);
        scene.nodes[0].instances.resize(2);
        WrongPixels without;
        for (const float farMetres : strays) {
            if (farMetres > 0.0f) {
                scenes::Mesh stray = scene.meshes[1];
                for (glm::vec3& positionOS : stray.positionsOS) positionOS += glm::vec3(farMetres, 0.0f, -farMetres);
                scene.meshes.resize(2);
                scene.meshes.push_back(stray);
                scene.nodes[0].instances.resize(2);
                scene.nodes[0].instances.push_back({2, 0});
            }
            engine::Renderer renderer(context(), scene);
            const WrongPixels count = wrongPixels(renderer, settings);
            fmt::print("angle {}, a stray {} m away: {}\n", angle, farMetres, count.text());
            if (farMetres == 0.0f) without = count;
            EXPECT_EQ(count.wrong, 0u);
            renderer.render(engine::Technique::Deferred, settings);
            EXPECT_EQ(renderer.shadows().missing, "");
            EXPECT_EQ(count.hidden, without.hidden);
            EXPECT_LE(count.undecided, without.undecided + count.covered / 500);
        }
    };
    for (const float angle : {0.0f, 0.05f}) expectTheSame(angle, {0.0f, 1e4f, 1e7f, 1e10f});
    // The squares of such triangles' areas are beyond fp32.
    for (scenes::Mesh* mesh : {&scene.meshes[0], &scene.meshes[1]})
        for (glm::vec3& positionOS : mesh->positionsOS) positionOS *= 1e-3f;
    glm::dmat4& eye = scene.cameras[0].worldFromCamera;
    eye[3] = glm::dvec4(1e-3 * glm::dvec3(eye[3]), 1.0);
    scene.cameras[0].nearMetres *= 1e-3;
    expectTheSame(0.0f, {0.0f, 1e14f});
}

TEST_F(Shadows, aCasterFarAwayTowardsTheSunHidesIt) {
    scenes::Scene scene = ballUnderSun();
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.4, 0.8, 0.3));
    scene.lights[0].directionWS = -toSun;
    addFloor(scene, glm::dvec3(0.0), 3.0);
    for (glm::vec3& positionOS : scene.meshes.back().positionsOS) positionOS += glm::vec3(1e4 * toSun);
    const frame::FrameSettings settings = shadowsOfTheFirstLight();
    engine::Renderer renderer(context(), scene);
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("a plate 10 km away: {}\n", count.text());
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_GE(count.hidden, count.covered / 4);
    EXPECT_LE(count.undecided, count.covered / 20);
}

// The corners of a huge triangle are rounded by metres, and so is all of it.
TEST_F(Shadows, whereRoundingDecidesTheReferenceSaysSoWhateverTheLightsSize) {
    scenes::Scene scene = ballUnderSun();
    scene.lights[0].directionWS = {-0.4, -0.8, -0.3};
    addFloor(scene, {0.0, -1e7, 0.0}, 4e8);
    const frame::FrameSettings settings = shadowsOfTheFirstLight();
    for (const float angle : {0.0f, 0.05f}) {
        scene.lights[0].angularRadiusRadians = angle;
        engine::Renderer renderer(context(), scene);
        const WrongPixels count = wrongPixels(renderer, settings);
        fmt::print("angle {}: {}\n", angle, count.text());
        EXPECT_EQ(count.wrong, 0u);
        EXPECT_GT(count.hidden, 50u);
        EXPECT_GE(count.undecided, count.hidden) << "whatever a caster may hide is undecided";
        renderer.render(engine::Technique::Deferred, settings);
        EXPECT_NE(renderer.shadows().missing.find("take it out"), std::string::npos) << renderer.shadows().missing;
    }
}

// Depths of neighbouring pixels differ by few roundings there, so that a triangle's normal is off by some degrees.
TEST_F(Shadows, aSurfaceDoesNotHideLightsBeforeItHoweverCloselyItIsSeen) {
    scenes::Scene scene = ballUnderSun();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.9, 0.3)), aside = {0.8, 0.0, -0.6};
    scene.nodes[0].instances = {{1, 0}};
    scene.nodes[0].parentFromNode =
        glm::rotate(glm::dmat4(1.0), std::acos(normal.y), glm::normalize(glm::dvec3(normal.z, 0.0, -normal.x)));
    scenes::Node& below = scene.nodes.emplace_back(scene.nodes[0]); // makes the range of depths long
    below.name = "below";
    below.parentFromNode =
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -100.0, 0.0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(25.0));
    scenes::Camera& camera = scene.cameras[0];
    const glm::dvec3 along = glm::normalize(aside - glm::dot(aside, normal) * normal);
    for (const auto projection : {scenes::Projection::Orthographic, scenes::Projection::Perspective}) {
        const double distance = projection == scenes::Projection::Orthographic ? 1.0 : 1000.0;
        camera.projection = projection;
        camera.halfHeightMetres = 0.02;
        camera.fovYRadians = 2.0 * std::atan(0.02 / distance);
        camera.worldFromCamera = scenes::worldFromLookAt(distance * glm::dvec3(0.1, 1.0, 0.1), {0.0, 0.0, 0.0});
        engine::Renderer renderer(context(), scene);
        for (const double degrees : {0.3, 1.0, 3.0}) {
            const double up = glm::radians(degrees);
            for (const double side : {-1.0, 1.0}) {
                scene.lights[0].directionWS = -std::cos(up) * side * along - std::sin(up) * normal;
                for (const auto filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
                    frame::FrameSettings settings =
                        withView(withShadows(ofSize(640, 360), filter), frame::DebugView::Shadow);
                    const std::vector<float> seen = renderer.render(engine::Technique::Deferred, settings).radiance;
                    std::size_t dark = 0;
                    for (std::size_t i = 0; i < seen.size(); i += 4) dark += !(seen[i] == 1.0f);
                    EXPECT_EQ(dark, 0u) << distance << " m away, " << degrees << " degrees, filter " << int(filter);
                }
            }
        }
    }
}

/// A floor, 2 m wide and deep, and a wall that stands on its far edge, as high and twice as wide, viewed obliquely.
scenes::Scene floorBeforeWall() {
    scenes::Scene scene = scenes::loadScene("room");
    scene.meshes.clear();
    scene.nodes.resize(1);
    scene.nodes[0] = {};
    addFloor(scene, {0.0, 0.0, 1.0}, 2.0);
    scene.nodes.push_back({});
    scene.nodes[1].parentFromNode = glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0));
    scene.meshes.emplace_back();
    scenes::builtin::appendFloor(scene.meshes.back(), {0.0, 0.0, -1.0}, glm::dvec2(4.0, 2.0), glm::ivec2(1));
    scene.nodes[1].instances = {{1, 0}};
    scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.7, 1.3, 3.0}, {0.0, 0.4, 0.0});
    scene.lights = {sunLight({0.0, 0.0, -1.0}, 3.0f)};
    return scene;
}

// Shadow casters have additional vertices, which move all meshes in the buffers.
TEST_F(Shadows, thatAreTurnedOnLaterAreThoseOfANewRenderer) {
    const scenes::Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene), newRenderer(context(), scene);
    frame::FrameSettings settings = withoutShadows(ofSize(96, 54));
    const std::vector<float> lit = renderer.render(engine::Technique::Deferred, settings).radiance;
    settings.shadows = kAllLightsCast;
    const std::vector<float> shadowed = renderer.render(engine::Technique::Deferred, settings).radiance;
    EXPECT_NE(shadowed, lit);
    EXPECT_EQ(shadowed, newRenderer.render(engine::Technique::Deferred, settings).radiance);
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    EXPECT_EQ(renderer.render(engine::Technique::Deferred, settings).radiance, lit);
}

TEST_F(Shadows, ofASceneWithoutTrianglesNothingIsMissingWhereAllFeaturesAre) {
    scenes::Scene scene = scenes::loadScene("room");
    scene.meshes.clear();
    scene.nodes.clear();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(32, 18));
    expectPruningIsUnseen(renderer, settings);
}

// With several samples, a pixel on the edge between the two is lit once for each of them, and its centre lies on one
// only: beyond the edge the floor's plane continues behind the wall, and the wall's below the floor.
TEST_F(Shadows, severalSamplesAreLitWhereTheirTriangleIsAndNotBehindTheNext) {
    scenes::Scene scene = floorBeforeWall();
    frame::FrameSettings settings = withSamples(withView(withShadows(ofSize(160, 90)), frame::DebugView::Shadow), 4);
    for (const auto filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        settings.shadowFilter = filter;
        for (const bool isBefore : {true, false}) {
            if (!isBefore && filter == frame::ShadowFilter::Hard)
                continue; // maps leak at contacts, with one sample too
            scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.1, -0.7, isBefore ? -0.8 : 0.8));
            const std::vector<float> seen = drawn(scene, settings, engine::Technique::ForwardPrepass);
            std::size_t wrong = 0, covered = 0;
            for (std::size_t i = 0; i < seen.size(); i += 4) {
                covered += seen[i + 3] > 0.0f;
                wrong += seen[i] != (isBefore ? seen[i + 3] : 0.0f); // the wall hides all of the floor from behind it
            }
            EXPECT_GT(covered, 3000u);
            EXPECT_EQ(wrong, 0u) << (isBefore ? "before" : "behind") << ", filter " << int(filter);
        }
    }
}

} // namespace
} // namespace tessera
