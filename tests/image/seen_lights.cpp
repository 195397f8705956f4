// The surfaces of area lights in pictures: every technique, outlines in closed form, what hides what, the reference.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/PrepareView.h"
#include "engine/Rendering.h"
#include "renderer/graph/Plan.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/Random.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/ShownTriangles.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using std::numbers::pi;
using namespace test;

constexpr LightType kSeenTypes[] = {LightType::Rectangle, LightType::Disk, LightType::Sphere, LightType::Tube,
                                    LightType::Polygon};
constexpr glm::vec3 kShown(5.0f, 2.5f, 1.25f); ///< the radiance of seenLamp()

/// A rectangle of 1 x 0.6 m without one of its corners.
constexpr double kEllSquareMetres = 0.52;
scenes::LightCorners ellCorners() {
    scenes::LightCorners corners;
    corners.count = 0;
    for (const glm::vec2& corner : {glm::vec2(-0.5f, -0.3f), glm::vec2(0.5f, -0.3f), glm::vec2(0.5f, 0.1f),
                                    glm::vec2(0.1f, 0.1f), glm::vec2(0.1f, 0.3f), glm::vec2(-0.5f, 0.3f)})
        corners.add(corner);
    return corners;
}

/// At a place, turned to +z, 1 m wide and 0.6 m high or long, or of a radius of 0.4 m; a polygon is an L.
scenes::Light seenLamp(LightType type, const glm::dvec3& positionWS) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = {0.0, 0.0, 1.0};
    light.heightMetres = light.lengthMetres = 0.6f;
    light.radiusMetres = type == LightType::Rectangle ? 0.0f : 0.4f;
    light.corners = ellCorners();
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 5.0f;
    return light;
}

/// Turned to any direction, with its width anywhere across it.
scenes::Light turnedLamp(LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS) {
    scenes::Light light = seenLamp(type, positionWS);
    light.directionWS = glm::normalize(directionWS);
    const glm::dvec3 aside = glm::normalize(glm::cross(light.directionWS, glm::dvec3(0.31, 0.83, 0.17)));
    light.alongWS = aside;
    return light;
}

scenes::Material plainColor(const glm::vec4& color) {
    scenes::Material material;
    material.model = scenes::MaterialModel::SingleColor;
    material.baseColor = color;
    material.doubleSided = true;
    if (color.a < 1.0f) material.alphaMode = scenes::AlphaMode::Blend;
    return material;
}

/// An unlit quad behind the camera, so that nothing but lights is seen.
scenes::Scene lightsAlone(const std::vector<scenes::Light>& lights) {
    scenes::Scene scene = quadScene(plainColor(glm::vec4(1.0f)));
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0);
    scene.lights = lights;
    return scene;
}

void addQuad(scenes::Scene& scene, const glm::vec4& color, const glm::dmat4& worldFromQuad) {
    scene.materials.push_back(plainColor(color));
    scenes::Node& node = scene.nodes.emplace_back();
    node.parentFromNode = worldFromQuad;
    node.instances = {{0, int(scene.materials.size()) - 1}};
}

glm::dmat4 quadAt(const glm::dvec3& middle, const glm::dvec3& along, const glm::dvec3& up) {
    return {glm::dvec4(along, 0.0), glm::dvec4(up, 0.0), glm::dvec4(glm::normalize(glm::cross(along, up)), 0.0),
            glm::dvec4(middle, 1.0)};
}

/// Unlit surfaces, opaque and transparent, that lights of each type stand before, behind and in.
scenes::Scene amongSurfaces() {
    scenes::Scene scene = quadScene(plainColor({0.2f, 0.3f, 0.4f, 1.0f}));
    addQuad(scene, {0.6f, 0.1f, 0.1f, 0.5f}, quadAt({0.1, 0.0, 0.5}, {0.5, 0.1, 0.2}, {-0.1, 0.4, 0.1}));
    addQuad(scene, {0.1f, 0.6f, 0.1f, 0.25f}, quadAt({-0.2, 0.1, 0.8}, {0.3, 0.0, -0.2}, {0.0, 0.3, 0.05}));
    double turn = 0.4;
    for (const LightType type : kSeenTypes)
        for (const double height : {-0.02, 0.3, 0.7}) {
            const glm::dvec3 at(0.5 * std::cos(turn), 0.45 * std::sin(turn), height);
            scenes::Light light = turnedLamp(type, at, {std::sin(3.0 * turn), 0.4, 1.0});
            light.widthMetres = 0.3f;
            light.heightMetres = light.lengthMetres = 0.2f;
            if (type != LightType::Rectangle) light.radiusMetres = 0.1f;
            for (glm::vec2& corner : light.corners.metres) corner *= 0.3f;
            light.color = {1.0f, float(turn / 8.0), 0.5f};
            light.isTwoSided = height < 0.5;
            scene.lights.push_back(light);
            turn += 0.53;
        }
    return scene;
}

frame::FrameSettings settingsOfSize(glm::ivec2 sizePixels) {
    frame::FrameSettings settings;
    settings.sizePixels = sizePixels;
    return settings;
}

class SeenLightPictures : public ShadowTest {
protected:
    engine::RenderedFrame frame(const scenes::Scene& scene, const frame::FrameSettings& settings,
                                Technique technique = Technique::Deferred) {
        engine::Renderer renderer(context(), scene);
        return renderer.render(technique, settings);
    }
    /// The middle of a picture of 3 x 3 pixels.
    glm::vec4 middle(const scenes::Scene& scene, Technique technique = Technique::Deferred) {
        const std::vector<float> radiance = frame(scene, settingsOfSize({3, 3}), technique).radiance;
        return {radiance[16], radiance[17], radiance[18], radiance[19]};
    }
    static std::size_t shownPixels(const engine::RenderedFrame& frame) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4)
            count += glm::vec3(frame.radiance[i], frame.radiance[i + 1], frame.radiance[i + 2]) == kShown;
        return count;
    }
    /// Every pixel is all of the light or nothing.
    static void expectAllOrNothing(const engine::RenderedFrame& frame) {
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4) {
            const glm::vec4 seen(frame.radiance[i], frame.radiance[i + 1], frame.radiance[i + 2],
                                 frame.radiance[i + 3]);
            ASSERT_TRUE(seen == glm::vec4(0.0f) || seen == glm::vec4(kShown, 1.0f))
                << seen.r << " " << seen.g << " " << seen.b << " " << seen.a << " at " << i / 4;
        }
    }
    void expectAllTechniquesAlike();
    void expectPruningChangesNoBit();
    void expectSurfacesAloneAreListed();
};
using SeenLightPicturesSlow = SeenLightPictures;

// ---- Techniques ----------------------------------------------------------------------------------------------------

/// The scene's lights, and one of each type before its camera at (0, 1.5, 6).
scenes::Scene withSeenLights(scenes::Scene scene) {
    double x = -2.2;
    for (const LightType type : kSeenTypes) {
        scenes::Light light = turnedLamp(type, {x, 0.8, 0.4 * x}, {0.3, 0.2, 1.0});
        light.color = {1.0f, 0.5f, 0.25f};
        scene.lights.push_back(light);
        x += 1.5;
    }
    return scene;
}

/// The scene with materials of one kind, opaque and transparent: what shows a light does not look at others.
scenes::Scene withPlainMaterials(scenes::Scene scene,
                                 scenes::MaterialModel model = scenes::MaterialModel::MetallicRoughness) {
    for (scenes::Material& material : scene.materials) {
        scenes::Material plain;
        plain.model = model;
        plain.name = material.name;
        plain.baseColor = material.baseColor;
        plain.alphaMode = material.alphaMode;
        plain.doubleSided = material.doubleSided;
        material = plain;
    }
    return scene;
}

void SeenLightPictures::expectAllTechniquesAlike() {
    struct Case {
        const char* name;
        scenes::Scene scene;
        int samples;
        frame::LightingSpace space;
        std::vector<Technique> techniques; ///< besides forward; none: all
    };
    const scenes::Scene plain = withSeenLights(withPlainMaterials(everythingScene()));
    const scenes::Scene unlit =
        withSeenLights(withPlainMaterials(everythingScene(), scenes::MaterialModel::SingleColor));
    scenes::Scene flat = plain;
    flat.cameras[0].projection = scenes::Projection::Orthographic;
    flat.cameras[0].halfHeightMetres = 2.0;
    using enum frame::LightingSpace;
    // Compiling programs that light takes most of the time, and what shows a light does not look at materials.
    std::vector<Case> cases{{"unlit", unlit, 1, World, techniquesInTurn(0)},
                            {"unlit, axes of the view", unlit, 1, View, techniquesInTurn(1)},
                            {"plain", plain, 1, World, {Technique::ClusteredDeferred}},
                            {"orthographic, 4 samples", flat, 4, View, {Technique::ClusteredForward}}};
    if (isWholeSweep()) {
        cases.push_back({"plain", plain, 1, World, {}});
        cases.push_back({"plain, axes of the view", plain, 1, View, {}});
        cases.push_back({"orthographic", flat, 1, World, {Technique::DeferredVolumes}});
        cases.push_back({"everything", withSeenLights(everythingScene()), 1, World, {Technique::ClusteredDeferred}});
        cases.push_back({"even, 4 samples", withSeenLights(evenScene()), 4, World, {Technique::ForwardPlus}});
    }
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        frame::FrameSettings settings = settingsOfSize({96, 54});
        settings.diffusion = coarseDiffusion();
        settings.samples = one.samples;
        settings.space = one.space;
        engine::Renderer renderer(context(), one.scene);
        expectParity(renderer, settings, one.techniques);
        EXPECT_GT(shownPixels(renderer.render(Technique::Forward, settings)), 50u);
    }
}

TEST_F(SeenLightPictures, everyTechniqueGivesTheSamePictureToTheLastBit) {
    expectAllTechniquesAlike();
}
TEST_F(SeenLightPicturesSlow, everyTechniqueGivesTheSamePictureToTheLastBit) {
    expectAllTechniquesAlike();
}

/// With one sample and four, or with one and materials of one kind: programs of all features are those of any scene.
void SeenLightPictures::expectPruningChangesNoBit() {
    const bool isWhole = isWholeSweep();
    for (const int samples : isWhole ? std::vector{1, 4} : std::vector{1}) {
        const scenes::Scene scene = withSeenLights(!isWhole       ? withPlainMaterials(everythingScene())
                                                   : samples == 1 ? everythingScene()
                                                                  : evenScene());
        frame::FrameSettings settings = settingsOfSize({96, 54});
        settings.diffusion = coarseDiffusion();
        settings.samples = samples;
        const auto radiance = [&](bool prune) {
            settings.prune = prune;
            return frame(scene, settings, isWhole ? Technique::ForwardPlus : Technique::Deferred).radiance;
        };
        EXPECT_EQ(radiance(true), radiance(false)) << samples;
    }
}
TEST_F(SeenLightPictures, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    expectPruningChangesNoBit();
}
TEST_F(SeenLightPicturesSlow, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    expectPruningChangesNoBit();
}

TEST_F(SeenLightPictures, aSceneWithoutLightsToBeSeenHasNoTraceOfThem) {
    const auto tracesOf = [](const scenes::Scene& scene, frame::DebugView view, bool prune) {
        frame::FrameSettings settings;
        settings.view = view;
        settings.prune = prune;
        std::set<std::string> traces;
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::ForwardPlus, settings)) {
            if (program.name == "seen_lights" || program.name == "copy_depth") traces.insert(program.name);
            for (const auto& [name, value] : program.defines)
                if (name.find("SEEN") != std::string::npos && value != "0") traces.insert(name);
        }
        graph::Plan plan = engine::planFrame(scene, Technique::ForwardPlus, settings);
        for (const graph::Plan::LeftOut& item : plan.leftOut)
            if (item.what == "surfaces of area lights") traces.insert(item.why);
        plan.leftOut.clear();
        const std::string text = planText(plan);
        for (const char* name : {"seen_lights", "seen_depth"})
            if (text.find(name) != std::string::npos) traces.insert(name);
        return traces;
    };
    using Traces = std::set<std::string>;
    scenes::Scene scene = scenes::loadScene("spheres");
    const glm::dmat4& eye = scene.cameras[0].worldFromCamera;
    for (const bool prune : {true, false}) {
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune), Traces{"no light has one"});
        scene.lights.push_back(seenLamp(LightType::Sphere, glm::dvec3(eye[3] - 2.0 * eye[2])));
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune), (Traces{"copy_depth", "seen_lights", "seen_depth"}));
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Lights, prune), Traces{"the view shows no lit picture"});
        scene.lights.back().isSeen = false;
        EXPECT_EQ(tracesOf(scene, frame::DebugView::Final, prune),
                  Traces{"no light that has one shines and is to be seen"});
        scene.lights.pop_back();
    }
}

/// Light lists, ids and all that reads depth ask for surfaces.
void SeenLightPictures::expectSurfacesAloneAreListed() {
    scenes::Scene seen = withSeenLights(isWholeSweep() ? everythingScene() : withPlainMaterials(everythingScene()));
    scenes::Scene unseen = seen;
    for (scenes::Light& light : unseen.lights) light.isSeen = false;
    frame::FrameSettings settings = settingsOfSize({96, 54});
    settings.diffusion = coarseDiffusion();
    for (const Technique technique : {Technique::ForwardPlus, Technique::ClusteredDeferred}) {
        engine::Renderer a(context(), seen), b(context(), unseen);
        a.draw(technique, settings);
        b.draw(technique, settings);
        EXPECT_NE(a.download().radiance, b.download().radiance);
        EXPECT_EQ(a.downloadDepth(), b.downloadDepth());
        const engine::DrawnLists own = a.downloadLists(), other = b.downloadLists();
        EXPECT_EQ(own.lists.entries, other.lists.entries);
        settings.view = frame::DebugView::Ids;
        EXPECT_EQ(a.render(technique, settings).radiance, b.render(technique, settings).radiance);
        settings.view = frame::DebugView::Final;
    }
}
TEST_F(SeenLightPictures, depthsListsAndIdsAreThoseOfSurfaces) {
    expectSurfacesAloneAreListed();
}
TEST_F(SeenLightPicturesSlow, depthsListsAndIdsAreThoseOfSurfaces) {
    expectSurfacesAloneAreListed();
}

// ---- Outlines ------------------------------------------------------------------------------------------------------

/// The area in m^2 that a surface shows an eye far away in a direction.
double projectedAreaOf(const scenes::Light& light, const glm::dvec3& toEye) {
    const double radius = light.radiusMetres, cosine = std::abs(glm::dot(light.directionWS, toEye));
    switch (light.type) {
    case LightType::Rectangle:
        return double(light.widthMetres) * double(light.heightMetres) * cosine;
    case LightType::Disk:
        return pi * radius * radius * cosine;
    case LightType::Sphere:
        return pi * radius * radius;
    case LightType::Polygon:
        return kEllSquareMetres * cosine;
    default:
        return 2.0 * radius * double(light.lengthMetres) * std::sqrt(1.0 - cosine * cosine) +
               pi * radius * radius * cosine;
    }
}

// Of 20,000 to 60,000 pixels those on the outline, some 700, round either way: a few dozen.
constexpr double kOfOutline = 4e-3;

TEST_F(SeenLightPictures, parallelRaysShowTheProjectedArea) {
    constexpr int kSide = 400;
    for (const int samples : {1, 4})
        for (const LightType type : kSeenTypes)
            for (const glm::dvec3 towards : {glm::dvec3(0.02, 0.01, 1.0), glm::dvec3(0.6, -0.3, 0.7)}) {
                const scenes::Light light = turnedLamp(type, {0.1, -0.05, 0.0}, towards);
                scenes::Scene scene = lightsAlone({light});
                scene.cameras[0].projection = scenes::Projection::Orthographic;
                scene.cameras[0].halfHeightMetres = 0.8;
                frame::FrameSettings settings = settingsOfSize({kSide, kSide});
                settings.samples = samples;
                const engine::RenderedFrame shown =
                    frame(scene, settings, samples == 1 ? Technique::Deferred : Technique::Forward);
                double covered = 0.0;
                std::set<float> shares;
                for (std::size_t i = 3; i < shown.radiance.size(); i += 4) {
                    covered += double(shown.radiance[i]);
                    shares.insert(shown.radiance[i]);
                }
                const double squareMetres = covered * std::pow(1.6 / kSide, 2);
                const double wanted = projectedAreaOf(light, {0.0, 0.0, 1.0});
                EXPECT_NEAR(squareMetres / wanted, 1.0, kOfOutline) << scenes::infoOf(type).name << ", " << samples;
                // A sample at a time, not a pixel.
                EXPECT_EQ(shares.size(), std::size_t(samples) + 1) << scenes::infoOf(type).name;
            }
}

TEST_F(SeenLightPictures, perspectiveShowsTheSolidAngle) {
    constexpr int kSide = 400;
    constexpr double kDistance = 1.5;
    for (const LightType type : {LightType::Rectangle, LightType::Disk, LightType::Sphere})
        for (const double aside : {0.0, 0.35}) {
            if (aside != 0.0 && type != LightType::Sphere) continue; // the closed forms are of the axis
            scenes::Light light = turnedLamp(type, {aside, -aside, 3.0 - kDistance}, {0.0, 0.0, 1.0});
            scenes::Scene scene = lightsAlone({light});
            scene.cameras[0].fovYRadians = 1.0;
            const engine::RenderedFrame shown = frame(scene, settingsOfSize({kSide, kSide}));
            const double stepOfPixel = 2.0 * std::tan(0.5) / kSide;
            double solidAngle = 0.0;
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    if (shown.radiance[std::size_t(4 * (y * kSide + x) + 3)] == 0.0f) continue;
                    const glm::dvec2 place = stepOfPixel * (glm::dvec2(x, y) + 0.5 - 0.5 * kSide);
                    solidAngle += stepOfPixel * stepOfPixel / std::pow(1.0 + glm::dot(place, place), 1.5);
                }
            const double radius = light.radiusMetres, distance = std::hypot(kDistance, aside * std::sqrt(2.0));
            const double a = 0.5 * double(light.widthMetres), b = 0.5 * double(light.heightMetres);
            const double wanted =
                type == LightType::Rectangle ? 4.0 * std::atan(a * b / (distance * std::hypot(a, b, distance)))
                : type == LightType::Disk    ? 2.0 * pi * (1.0 - distance / std::hypot(distance, radius))
                                             : 2.0 * pi * (1.0 - std::sqrt(1.0 - std::pow(radius / distance, 2)));
            EXPECT_NEAR(solidAngle / wanted, 1.0, kOfOutline) << scenes::infoOf(type).name << " at " << aside;
        }
}

TEST_F(SeenLightPictures, flatLightsShowTheirFrontAndSolidsTheirOutside) {
    for (const LightType type : kSeenTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        const bool isFlat = scenes::infoOf(type).isFlat;
        const glm::vec4 shown(kShown, 1.0f), nothing(0.0f);
        scenes::Light light = seenLamp(type, glm::dvec3(0.0));
        EXPECT_EQ(middle(lightsAlone({light})), shown);
        light.directionWS.z = -1.0;
        EXPECT_EQ(middle(lightsAlone({light})), isFlat ? nothing : shown);
        light.isTwoSided = true;
        EXPECT_EQ(middle(lightsAlone({light})), shown);
        light.isSeen = false;
        EXPECT_EQ(middle(lightsAlone({light})), nothing);
        light = seenLamp(type, {0.0, 0.0, 3.0});
        light.radiusMetres = 5.0f;
        light.lengthMetres = 20.0f;
        EXPECT_EQ(middle(lightsAlone({light})), nothing) << "around the eye";
        for (const double positionZ : {3.2, 3.0}) {
            scenes::Scene flat = lightsAlone({seenLamp(type, {0.0, 0.0, positionZ})});
            flat.cameras[0].projection = scenes::Projection::Orthographic;
            EXPECT_EQ(middle(flat), nothing) << "behind the near plane or cut by it, parallel rays";
        }
    }
}

TEST_F(SeenLightPictures, animatedLightsAreSeenWhereTheyAre) {
    scenes::Light light = seenLamp(LightType::Disk, glm::dvec3(0.0));
    light.radiusMetres = 0.1f;
    scenes::LightAnimation animation;
    animation.kind = scenes::LightAnimationKind::Keyframes;
    animation.keys.timesSeconds = {0.0, 1.0};
    animation.keys.values = {{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}};
    light.animation = animation;
    const scenes::Scene scene = lightsAlone({light});
    frame::FrameSettings settings = settingsOfSize({3, 3});
    for (const double seconds : {0.0, 0.5, 1.0}) {
        settings.timeSeconds = seconds;
        const std::vector<float> radiance = frame(scene, settings).radiance;
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(radiance[std::size_t(4 * (3 + x))], x == int(2.0 * seconds) ? kShown.r : 0.0f) << seconds;
    }
}

// ---- Beside surfaces -----------------------------------------------------------------------------------------------

TEST_F(SeenLightPictures, theNearerHidesTheFartherAndTransparentSurfacesBlend) {
    const glm::vec4 shown(kShown, 1.0f), opaque(0.25f, 0.5f, 0.75f, 1.0f);
    for (const LightType type : kSeenTypes)
        for (const Technique technique : {Technique::Forward, Technique::DeferredVolumes}) {
            SCOPED_TRACE(scenes::infoOf(type).name);
            const auto seen = [&](const glm::vec4& quadColor, double positionZ) {
                scenes::Scene scene = quadScene(plainColor(quadColor));
                scene.lights = {seenLamp(type, {0.0, 0.0, positionZ})};
                return middle(scene, technique);
            };
            EXPECT_EQ(seen(opaque, 1.0), shown);
            EXPECT_EQ(seen(opaque, -1.0), opaque);
            const glm::vec4 glass(0.25f, 0.5f, 0.75f, 0.5f);
            EXPECT_EQ(seen(glass, 1.0), shown) << "before glass";
            EXPECT_EQ(seen(glass, -1.0), glm::vec4(0.5f * kShown + 0.5f * glm::vec3(glass), 1.0f)) << "behind glass";
        }
}

TEST_F(SeenLightPictures, theNearestLightIsSeenWhateverTheirOrder) {
    scenes::Scene scene = amongSurfaces();
    const frame::FrameSettings settings = settingsOfSize({160, 120});
    for (scenes::Light& light : scene.lights) light.positionWS *= glm::dvec3(0.3, 0.3, 1.0);
    const std::vector<float> ascending = frame(scene, settings).radiance;
    std::ranges::reverse(scene.lights);
    EXPECT_EQ(frame(scene, settings).radiance, ascending);
}

TEST_F(SeenLightPictures, areThoseOfTheReferenceFromNearAndFar) {
    using frame::LightingSpace;
    struct Sight {
        const char* name;
        double distanceMetres, fovYRadians; ///< 0: parallel rays
        LightingSpace space;
    };
    for (const Sight& one :
         {Sight{"near", 2.2, 0.9, LightingSpace::World}, Sight{"near, axes of the view", 2.2, 0.9, LightingSpace::View},
          Sight{"parallel", 3.0, 0.0, LightingSpace::World}, Sight{"far", 2e3, 1e-3, LightingSpace::World},
          Sight{"farther, axes of the view", 1e5, 2e-5, LightingSpace::View}}) {
        SCOPED_TRACE(one.name);
        scenes::Scene scene = amongSurfaces();
        scenes::Camera& camera = scene.cameras[0];
        camera.worldFromCamera = scenes::worldFromLookAt(one.distanceMetres * glm::normalize(glm::dvec3(0.3, 0.2, 1.0)),
                                                         glm::dvec3(0.0, 0.0, 0.2));
        if (one.fovYRadians == 0.0) {
            camera.projection = scenes::Projection::Orthographic;
            camera.halfHeightMetres = 0.9;
        } else {
            camera.fovYRadians = one.fovYRadians;
        }
        frame::FrameSettings settings = settingsOfSize({160, 120});
        settings.space = one.space;
        engine::Renderer renderer(context(), scene);
        const engine::RenderedFrame shown = renderer.render(Technique::ClusteredDeferred, settings);
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::Definition);
        const std::vector<std::uint8_t> excluded = validation::shownTriangles(renderer, settings, truth.ids).excluded;
        const Picture picture = engine::toPicture(shown), nearest = truth.nearestTo(picture);
        std::size_t wrong = 0, undecided = 0, lights = 0, compared = 0;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
            if (excluded[i] != 0) continue;
            ++compared;
            undecided += !truth.alternatives[i].empty();
            lights += truth.picture.pixel(i)[0] == 5.0f;
            for (int c = 0; c < 3; ++c)
                if (std::abs(double(picture.pixel(i)[c]) - double(nearest.pixel(i)[c])) > 1e-5) {
                    ++wrong;
                    break;
                }
        }
        fmt::print("{}: {} lit, {} undecided, {} wrong of {}\n", one.name, lights, undecided, wrong, compared);
        EXPECT_EQ(wrong, 0u);
        EXPECT_GT(lights, 200u);
        EXPECT_LT(double(undecided), 0.05 * double(compared));
    }
}

// ---- Extremes ------------------------------------------------------------------------------------------------------

TEST_F(SeenLightPictures, extremeSizesAndPlacesShowTheRadianceOrNothing) {
    frame::FrameSettings settings = settingsOfSize({9, 7});
    scenes::Scene scene = lightsAlone({seenLamp(LightType::Disk, glm::dvec3(0.0))});
    engine::Renderer renderer(context(), scene);
    for (const scenes::Projection projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic})
        for (const LightType type : kSeenTypes)
            for (const float size : {1e-6f, 1e-2f, 1.0f, 1e3f, 1e6f})
                // The eye is at (0, 0, 3).
                for (const glm::dvec3& at :
                     {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 3.0), glm::dvec3(0.0, 0.0, 2.9), glm::dvec3(0.0, 0.0, -1e6),
                      glm::dvec3(0.5, 0.0, 3.0 - 1e-9), glm::dvec3(1e6, 0.0, 2.0), glm::dvec3(0.0, 0.0, 3.0 - 1e6)})
                    for (const glm::dvec3& towards :
                         {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 1e-9), glm::dvec3(1.0, 1.0, 1.0)}) {
                        scene.cameras[0].projection = projection;
                        scenes::Light light = turnedLamp(type, at, towards);
                        light.isTwoSided = true;
                        light.widthMetres = light.heightMetres = light.lengthMetres = light.radiusMetres = size;
                        for (glm::vec2& corner : light.corners.metres) corner *= size;
                        scene.lights = {light};
                        SCOPED_TRACE(
                            fmt::format("{} of {} m at {} {} {}", scenes::infoOf(type).name, size, at.x, at.y, at.z));
                        expectAllOrNothing(renderer.render(Technique::Deferred, settings));
                        if (HasFatalFailure()) return;
                    }
}

/// A wall that fills the view, a hall of 1000 km around a ball, a thread across the picture.
TEST_F(SeenLightPictures, lightsOfAnySizeAreSeenWhereTheyFillThePicture) {
    const auto allShown = [&](const scenes::Light& light) {
        const engine::RenderedFrame shown = frame(lightsAlone({light}), settingsOfSize({9, 7}));
        return shownPixels(shown);
    };
    scenes::Light wall = seenLamp(LightType::Rectangle, {0.0, 0.0, -1e6});
    wall.widthMetres = wall.heightMetres = 1e6f;
    EXPECT_EQ(allShown(wall), 63u);
    scenes::Light ball = seenLamp(LightType::Sphere, {0.0, 0.0, -1e6});
    ball.radiusMetres = 9e5f;
    EXPECT_EQ(allShown(ball), 63u);
    scenes::Light thread = seenLamp(LightType::Tube, glm::dvec3(0.0));
    thread.directionWS = {1.0, 0.0, 0.0};
    thread.lengthMetres = 1e6f;
    thread.radiusMetres = 1e-3f;
    EXPECT_EQ(allShown(thread), 9u);
}

} // namespace
} // namespace tessera
