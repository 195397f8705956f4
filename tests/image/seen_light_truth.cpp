// Visible surfaces of area lights: outlines in closed form, occlusion, and the reference.
#include <cstdint>
#include <numbers>
#include <set>

#include "tests/image/SeenLightTest.h"
#include "validation/compare/ShownTriangles.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::LightType;
using std::numbers::pi;
using namespace test;

scenes::Material plainColor(const glm::vec4& color) {
    scenes::Material material = unlit();
    material.baseColor = color;
    material.doubleSided = true;
    if (color.a < 1.0f) material.alphaMode = scenes::AlphaMode::Blend;
    return material;
}

/// An unlit quad behind the camera, so that only lights are visible.
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

/// Unlit surfaces, opaque and transparent, with lights of each type before, behind and through them.
scenes::Scene amongSurfaces() {
    scenes::Scene scene = quadScene(plainColor({0.2f, 0.3f, 0.4f, 1.0f}));
    addQuad(scene, {0.6f, 0.1f, 0.1f, 0.5f}, quadAt({0.1, 0.0, 0.5}, {0.5, 0.1, 0.2}, {-0.1, 0.4, 0.1}));
    addQuad(scene, {0.1f, 0.6f, 0.1f, 0.25f}, quadAt({-0.2, 0.1, 0.8}, {0.3, 0.0, -0.2}, {0.0, 0.3, 0.05}));
    double turn = 0.4;
    for (const LightType type : kAreaTypes)
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

class SeenLightTruth : public SeenLightTest {
protected:
    /// The centre of an image of 3 x 3 pixels.
    glm::vec4 middle(const scenes::Scene& scene, Technique technique = Technique::Deferred) {
        const std::vector<float> radiance = frameOf(scene, ofSize(3, 3), technique).radiance;
        return {radiance[16], radiance[17], radiance[18], radiance[19]};
    }
    /// Expects every pixel to show the light fully or not at all.
    static void expectAllOrNothing(const engine::RenderedFrame& frame) {
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4) {
            const glm::vec4 seen(frame.radiance[i], frame.radiance[i + 1], frame.radiance[i + 2],
                                 frame.radiance[i + 3]);
            ASSERT_TRUE(seen == glm::vec4(0.0f) || seen == glm::vec4(kShown, 1.0f))
                << seen.r << " " << seen.g << " " << seen.b << " " << seen.a << " at " << i / 4;
        }
    }
};

// ---- Outlines ------------------------------------------------------------------------------------------------------

/// Projected area of a light in m^2, viewed from far away in a direction.
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

// Of 20,000 to 60,000 pixels some 700 lie on the outline and round either way: a few dozen.
constexpr double kOfOutline = 4e-3;

TEST_F(SeenLightTruth, parallelRaysShowTheProjectedArea) {
    constexpr int kSide = 400;
    for (const int samples : {1, 4})
        for (const LightType type : kAreaTypes)
            for (const glm::dvec3 towards : {glm::dvec3(0.02, 0.01, 1.0), glm::dvec3(0.6, -0.3, 0.7)}) {
                const scenes::Light light = turnedLamp(type, {0.1, -0.05, 0.0}, towards);
                scenes::Scene scene = lightsAlone({light});
                makeOrthographic(scene.cameras[0], 0.8);
                frame::FrameSettings settings = withSamples(ofSize(kSide, kSide), samples);
                const engine::RenderedFrame shown =
                    frameOf(scene, settings, samples == 1 ? Technique::Deferred : Technique::Forward);
                double covered = 0.0;
                std::set<float> shares;
                for (std::size_t i = 3; i < shown.radiance.size(); i += 4) {
                    covered += double(shown.radiance[i]);
                    shares.insert(shown.radiance[i]);
                }
                const double squareMetres = covered * std::pow(1.6 / kSide, 2);
                const double wanted = projectedAreaOf(light, {0.0, 0.0, 1.0});
                EXPECT_NEAR(squareMetres / wanted, 1.0, kOfOutline) << scenes::infoOf(type).name << ", " << samples;
                // Coverage changes by sample, not by pixel.
                EXPECT_EQ(shares.size(), std::size_t(samples) + 1) << scenes::infoOf(type).name;
            }
}

TEST_F(SeenLightTruth, perspectiveShowsTheSolidAngle) {
    constexpr int kSide = 400;
    constexpr double kDistance = 1.5;
    for (const LightType type : {LightType::Rectangle, LightType::Disk, LightType::Sphere})
        for (const double aside : {0.0, 0.35}) {
            if (aside != 0.0 && type != LightType::Sphere) continue; // the closed forms hold on the axis
            scenes::Light light = turnedLamp(type, {aside, -aside, 3.0 - kDistance}, {0.0, 0.0, 1.0});
            scenes::Scene scene = lightsAlone({light});
            scene.cameras[0].fovYRadians = 1.0;
            const engine::RenderedFrame shown = frameOf(scene, ofSize(kSide, kSide));
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

TEST_F(SeenLightTruth, flatLightsShowTheirFrontAndSolidsTheirOutside) {
    for (const LightType type : kAreaTypes) {
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

TEST_F(SeenLightTruth, animatedLightsAreSeenWhereTheyAre) {
    scenes::Light light = seenLamp(LightType::Disk, glm::dvec3(0.0));
    light.radiusMetres = 0.1f;
    scenes::LightAnimation animation;
    animation.kind = scenes::LightAnimationKind::Keyframes;
    animation.keys.timesSeconds = {0.0, 1.0};
    animation.keys.values = {{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}};
    light.animation = animation;
    const scenes::Scene scene = lightsAlone({light});
    frame::FrameSettings settings = ofSize(3, 3);
    for (const double seconds : {0.0, 0.5, 1.0}) {
        settings.timeSeconds = seconds;
        const std::vector<float> radiance = frameOf(scene, settings).radiance;
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(radiance[std::size_t(4 * (3 + x))], x == int(2.0 * seconds) ? kShown.r : 0.0f) << seconds;
    }
}

// ---- Beside surfaces -----------------------------------------------------------------------------------------------

TEST_F(SeenLightTruth, theNearerHidesTheFartherAndTransparentSurfacesBlend) {
    const glm::vec4 shown(kShown, 1.0f), opaque(0.25f, 0.5f, 0.75f, 1.0f);
    for (const LightType type : kAreaTypes)
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

TEST_F(SeenLightTruth, theNearestLightIsSeenWhateverTheirOrder) {
    scenes::Scene scene = amongSurfaces();
    const frame::FrameSettings settings = ofSize(160, 120);
    for (scenes::Light& light : scene.lights) light.positionWS *= glm::dvec3(0.3, 0.3, 1.0);
    const std::vector<float> ascending = frameOf(scene, settings).radiance;
    std::ranges::reverse(scene.lights);
    EXPECT_EQ(frameOf(scene, settings).radiance, ascending);
}

TEST_F(SeenLightTruth, areThoseOfTheReferenceFromNearAndFar) {
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
            makeOrthographic(camera, 0.9);
        } else {
            camera.fovYRadians = one.fovYRadians;
        }
        frame::FrameSettings settings = ofSize(160, 120);
        settings.space = one.space;
        engine::Renderer renderer(context(), scene);
        const engine::RenderedFrame shown = renderer.render(Technique::ClusteredDeferred, settings);
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Alternatives::Definition);
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

TEST_F(SeenLightTruth, extremeSizesAndPlacesShowTheRadianceOrNothing) {
    frame::FrameSettings settings = ofSize(9, 7);
    scenes::Scene scene = lightsAlone({seenLamp(LightType::Disk, glm::dvec3(0.0))});
    engine::Renderer renderer(context(), scene);
    for (const scenes::Projection projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic})
        for (const LightType type : kAreaTypes)
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

/// A wall that fills the view, a ball of 900 km radius, a thread across the image.
TEST_F(SeenLightTruth, lightsOfAnySizeAreSeenWhereTheyFillThePicture) {
    const auto allShown = [&](const scenes::Light& light) {
        const engine::RenderedFrame shown = frameOf(lightsAlone({light}), ofSize(9, 7));
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
