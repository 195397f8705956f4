#include <span>

#include "tests/image/ShadowTest.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::SubsurfaceMethod;
using namespace test;

class Subsurface : public ShadowTest {
protected:
    /// The head with this method in its first material.
    static scenes::Scene headWith(SubsurfaceMethod method) {
        scenes::Scene scene = scenes::loadScene("head");
        scene.materials[0].subsurface.method = method;
        return scene;
    }
};

/// A head, a scene of everything and one whose G-buffer stores material indices, with every pair of method, filter and
/// number of samples, or each with some.
TEST_SWEEP(Subsurface, everyTechniqueGivesTheSamePictureToTheLastBit) {
    struct Case {
        SubsurfaceMethod method;
        frame::ShadowFilter filter;
        int samples;
    };
    // Every pair of method, filter and number of samples.
    constexpr Case kCases[] = {{SubsurfaceMethod::Wrap, frame::ShadowFilter::Traced, 1},
                               {SubsurfaceMethod::DepthMap, frame::ShadowFilter::Pcf, 1},
                               {SubsurfaceMethod::DepthMap, frame::ShadowFilter::Traced, 4},
                               {SubsurfaceMethod::Wrap, frame::ShadowFilter::Pcf, 4}};
    std::size_t turn = 0;
    const auto expectIn = [&](const scenes::Scene& scene, std::span<const Case> cases,
                              const std::vector<Technique>& techniques = {}) {
        SCOPED_TRACE(scene.name);
        engine::Renderer renderer(context(), scene);
        for (const Case& one : cases) {
            frame::FrameSettings settings = withSamples(withShadows(ofSize(96, 54), one.filter), one.samples);
            settings.subsurface = one.method;
            expectParity(renderer, settings,
                         techniques.empty() ? techniquesInTurn(turn++, settings.samples) : techniques);
        }
    };
    const std::span<const Case> cases(kCases);
    if (isWholeSweep()) {
        expectIn(everythingScene(), cases);
        expectIn(headWith(SubsurfaceMethod::Wrap), cases);
        expectIn(evenScene(), cases.subspan(1, 1));
        return;
    }
    // Nearly all of the time is compilation: the head, of two models, is drawn with one technique of each kind, and a
    // uniform scene, of nearly all models, with one. Parity draws everything with each material's own method.
    expectIn(headWith(SubsurfaceMethod::Wrap), cases);
    expectIn(evenScene(), cases.subspan(1, 1), {Technique::TiledDeferred});
}

// Its shadow side is where the light wraps.
TEST_F(Subsurface, aBallThatWrapsLightDoesNotShadowItself) {
    scenes::Scene scene = ballUnderSun();
    scene.nodes[0].instances.resize(1);
    scenes::Material& material = scene.materials[std::size_t(scene.nodes[0].instances[0].material)];
    material.subsurface.method = SubsurfaceMethod::Wrap;
    material.subsurface.wrap = 0.85f;
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(-0.9, -0.3, 0.1));
    engine::Renderer renderer(context(), scene);
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        frame::FrameSettings settings = withoutShadows(ofSize(320, 180));
        settings.shadowFilter = filter;
        const std::vector<float> lit = renderer.render(Technique::Deferred, settings).radiance;
        settings.shadows = kAllLightsCast;
        EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, lit) << infoOf(filter).name;
        settings.subsurface = SubsurfaceMethod::None;
        EXPECT_NE(renderer.render(Technique::Deferred, settings).radiance, lit) << infoOf(filter).name;
    }
}

TEST_F(Subsurface, whatIsInTheWayHidesWrappedLightAsTheReferenceSays) {
    scenes::Scene scene = headWith(SubsurfaceMethod::Wrap);
    frame::FrameSettings settings = exactOfSize(240, 135);
    engine::Renderer renderer(context(), scene);
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("head: {}\n", count.text());
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.undecided, count.covered / 50);
}

// ---- Transmitted light ---------------------------------------------------------------------------------------------

/// Red at the centre of the image.
double middleOf(const Picture& picture) {
    return picture.pixel((std::size_t(picture.height) / 2) * std::size_t(picture.width) +
                         std::size_t(picture.width) / 2)[0];
}

/// A body lit from behind by a sun, a lamp and a spot light, viewed from +z by parallel rays.
scenes::Scene bodyBeforeLights(scenes::Mesh body, double halfHeightMetres) {
    scenes::Scene scene = ballUnderSun();
    scene.meshes = {std::move(body)};
    scene.nodes[0].instances = {{0, 0}};
    scenes::Material material = lambert();
    material.baseColor = glm::vec4(1.0f);
    material.subsurface.method = SubsurfaceMethod::DepthMap;
    material.subsurface.absorptionPerMillimetre = {0.02f, 0.04f, 0.08f};
    scene.materials = {material};
    scenes::Camera& camera = scene.cameras[0];
    camera.worldFromCamera = scenes::worldFromLookAt({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0});
    makeOrthographic(camera, halfHeightMetres);
    camera.nearMetres = 0.01;
    camera.farMetres = 10.0;
    scenes::Light sun = scene.lights[0], lamp = pointLight({0.0, 0.0, -2.0}, 12.0f), spot = lamp;
    sun.directionWS = {0.0, 0.0, 1.0};
    spot.type = scenes::LightType::Spot;
    spot.directionWS = {0.0, 0.0, 1.0};
    spot.innerConeRadians = 0.2f;
    spot.outerConeRadians = 0.4f;
    scene.lights = {sun, lamp, spot};
    return scene;
}

/// Relative tolerances of each filter.
struct PassageBar {
    frame::ShadowFilter filter;
    double ofSlab, ofBall;
};
constexpr PassageBar kPassageBars[] = {{frame::ShadowFilter::Traced, 1e-4, 0.003},
                                       {frame::ShadowFilter::Hard, 0.02, 0.05},
                                       {frame::ShadowFilter::Pcf, 0.02, 0.05},
                                       {frame::ShadowFilter::Pcss, 0.02, 0.05}};

TEST_SWEEP(Subsurface, aSlabLetsThroughAnExponentialOfItsThickness) {
    std::size_t turn = 0;
    for (const double thickness : {0.003, 0.03}) {
        scenes::Mesh slab;
        scenes::builtin::appendBox(slab, {-0.5, -0.5, -thickness}, {0.5, 0.5, 0.0});
        const scenes::Scene scene = bodyBeforeLights(slab, 0.1);
        engine::Renderer renderer(context(), scene);
        for (const PassageBar& bar : kPassageBars) {
            if (!isWholeSweep() && turn++ % 2 != (thickness < 0.01 ? 0 : 1)) continue;
            frame::FrameSettings settings = withShadows(ofSize(65, 65), bar.filter);
            double sum = 0.0;
            for (int light = 0; light < 3; ++light) {
                settings.soloLight = light;
                const double found = middleOf(engine::toPicture(renderer.render(Technique::Deferred, settings)));
                const double full = light == 0 ? 3.0 : 12.0 / 4.0; // irradiance on the visible side
                const double wanted = full * std::exp(-0.02 * 1e3 * thickness);
                EXPECT_NEAR(found, wanted, bar.ofSlab * wanted) << infoOf(bar.filter).name << " light " << light;
                sum += found;
            }
            settings.soloLight.reset();
            const double all = middleOf(engine::toPicture(renderer.render(Technique::Deferred, settings)));
            EXPECT_NEAR(all, sum, 1e-5 * sum) << "several lights at once";
        }
    }
}

/// Transmission through a slab at a point of its front, by the path length inside; exits at the angle of entry.
glm::dvec3 behindSlab(const scenes::Scene& scene, const scenes::Light& light, const glm::dvec3& placeWS,
                      double thicknessMetres) {
    const bool isPlaced = scenes::infoOf(light.type).hasPosition();
    const glm::dvec3 toLight = isPlaced ? light.positionWS - placeWS : -light.directionWS;
    const double metres2 = isPlaced ? glm::dot(toLight, toLight) : 1.0;
    const double cosine = -toLight.z / glm::length(toLight);
    const glm::dvec3 absorption = 1e3 * glm::dvec3(scene.materials[0].subsurface.absorptionPerMillimetre);
    return double(light.intensity) / metres2 * cosine * glm::exp(-absorption * (thicknessMetres / cosine));
}

/// Four faces of a lamp's map lie to its sides; an oblique path's part along the slab's normal is 0.64 at most.
TEST_SWEEP(Subsurface, aSlabLetsThroughAnExponentialOfTheWayAtEveryAngle) {
    constexpr double kThickness = 0.01;
    scenes::Mesh slab;
    scenes::builtin::appendBox(slab, {-0.5, -0.5, -kThickness}, {0.5, 0.5, 0.0});
    scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    scenes::Light sun = scene.lights[0], spot = scene.lights[2];
    sun.directionWS = glm::normalize(glm::dvec3(0.9, -0.6, 1.0));
    spot.positionWS = {0.8, 0.9, -1.3};
    spot.directionWS = glm::normalize(-spot.positionWS);
    scene.lights = {sun, spot};
    for (const glm::dvec3& placeWS : {glm::dvec3(-1.2, 0.1, -1.0), glm::dvec3(1.2, -0.1, -1.0),
                                      glm::dvec3(0.1, -1.2, -1.0), glm::dvec3(-0.1, 1.2, -1.0)})
        scene.lights.push_back(pointLight(placeWS, 12.0f));
    engine::Renderer renderer(context(), scene);
    for (const PassageBar& bar : kPassageBars) {
        if (!isWholeSweep() && bar.filter != frame::ShadowFilter::Traced && bar.filter != frame::ShadowFilter::Hard)
            continue;
        frame::FrameSettings settings = withShadows(ofSize(33, 33), bar.filter);
        for (std::size_t light = 0; light < scene.lights.size(); ++light) {
            settings.soloLight = int(light);
            const Picture picture = engine::toPicture(renderer.render(Technique::Deferred, settings));
            double worst = 0.0;
            for (int y = 0; y < 33; ++y)
                for (int x = 0; x < 33; ++x) {
                    const glm::dvec2 place = (glm::dvec2(x, 32 - y) + 0.5 - 16.5) * (0.1 / 16.5);
                    const glm::dvec3 wanted =
                        behindSlab(scene, scene.lights[light], glm::dvec3(place, 0.0), kThickness);
                    for (int c = 0; c < 3; ++c) {
                        const double found = picture.pixel(std::size_t(y * 33 + x))[c];
                        worst = std::max(worst, std::abs(found - wanted[c]) / wanted[c]);
                    }
                }
            fmt::print("slab, {}, light {}: off by {:.1e} at most\n", infoOf(bar.filter).name, light, worst);
            EXPECT_LE(worst, bar.ofSlab) << infoOf(bar.filter).name << ", light " << light;
        }
    }
}

/// Rays from the middle row of pixels meet the common edge of a large and a small triangle, one of which must count.
TEST_F(Subsurface, aRayThroughTheEdgeOfTwoTrianglesLeavesTheBodyOnce) {
    constexpr double kThickness = 0.03;
    constexpr int kSide = 33;
    scenes::Mesh slab;
    scenes::builtin::appendQuad(slab, {-0.5, -0.5, 0.0}, {0.5, -0.5, 0.0}, {0.5, 0.5, 0.0}, {-0.5, 0.5, 0.0});
    scenes::builtin::appendQuad(slab, {-0.5, 0.0, -kThickness}, {0.0, 0.003, -kThickness}, {0.5, 0.0, -kThickness},
                                {0.0, -0.5, -kThickness});
    scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    scene.lights.resize(1);
    const frame::FrameSettings settings = withShadows(ofSize(kSide, kSide), frame::ShadowFilter::Traced);
    const std::vector<float> radiance = drawn(scene, settings, Technique::Forward);
    for (int x = 0; x < kSide; ++x)
        EXPECT_NEAR(double(radiance[std::size_t(4 * (kSide / 2 * kSide + x))]), 3.0 * std::exp(-20.0 * kThickness),
                    1e-3)
            << x;
}

/// Transmitted light is added to all reflected light: a white body without absorption returns up to twice the light.
TEST_F(Subsurface, lightThatPassesThroughIsAddedToAllThatIsReflected) {
    scenes::Mesh slab;
    scenes::builtin::appendBox(slab, {-0.5, -0.5, -0.003}, {0.5, 0.5, 0.0});
    scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    scene.materials[0].subsurface.absorptionPerMillimetre = glm::vec3(0.0f);
    scenes::Light front = scene.lights[0];
    front.directionWS = -front.directionWS;
    scene.lights = {scene.lights[0], front};
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = withShadows(ofSize(65, 65));
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        settings.shadowFilter = filter;
        EXPECT_NEAR(middleOf(engine::toPicture(renderer.render(Technique::Deferred, settings))), 2.0 * 3.0, 1e-4)
            << infoOf(filter).name;
    }
}

/// The path inside is found among casters. There are others, so that frames have shadows.
TEST_F(Subsurface, aBodyThatCastsNoShadowsLetsNoLightThrough) {
    scenes::Mesh slab;
    scenes::builtin::appendBox(slab, {-0.5, -0.5, -0.003}, {0.5, 0.5, 0.0});
    scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    scene.materials.emplace_back();
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().parentFromNode = glm::dmat4(1.0);
    scene.nodes.back().parentFromNode[3] = glm::dvec4(5.0, 0.0, 0.0, 1.0);
    scene.nodes.back().instances = {{0, 1}};
    const auto middle = [&](frame::ShadowFilter filter) {
        frame::FrameSettings settings = withShadows(ofSize(65, 65), filter);
        settings.soloLight = 0;
        return middleOf(engine::toPicture(frameOf(scene, settings)));
    };
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        scene.materials[0].castsShadow = true;
        EXPECT_NEAR(middle(filter), 3.0 * std::exp(-0.02 * 3.0), 0.06) << infoOf(filter).name;
        scene.materials[0].castsShadow = false;
        EXPECT_EQ(middle(filter), 0.0) << infoOf(filter).name;
    }
}

/// A cascade stores casters at most a texel's width nearer to the sun than they are, here 6 mm, as the slab is steep.
TEST_F(Subsurface, aSteepSlabLetsThroughAnExponentialOfItsWayInCoarseCascades) {
    constexpr double kThickness = 0.004;
    scenes::Mesh slab;
    scenes::builtin::appendBox(slab, {-0.5, -0.5, -kThickness}, {0.5, 0.5, 0.0});
    scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    scene.materials[0].subsurface.absorptionPerMillimetre = glm::vec3(1.0f);
    scene.lights.resize(1);
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(2.5, 0.0, 1.0));
    frame::FrameSettings settings = withShadows(ofSize(33, 33), frame::ShadowFilter::Hard);
    settings.shadowMaps.resolutionTexels = 64;
    engine::Renderer renderer(context(), scene);
    const double found = middleOf(engine::toPicture(renderer.render(Technique::Deferred, settings)));
    const double wanted = behindSlab(scene, scene.lights[0], glm::dvec3(0.0), kThickness).x;
    EXPECT_NEAR(found, wanted, 0.01 * wanted);
}

TEST_F(Subsurface, aBallLetsThroughAnExponentialOfItsChords) {
    constexpr double kRadius = 0.02;
    scenes::Mesh ball;
    scenes::builtin::appendSphere(ball, glm::dvec3(0.0), kRadius, 256, 128);
    const scenes::Scene scene = bodyBeforeLights(ball, 1.1 * kRadius);
    engine::Renderer renderer(context(), scene);
    for (const PassageBar& bar : kPassageBars) {
        frame::FrameSettings settings = withShadows(ofSize(128, 128), bar.filter);
        settings.shadowMaps.resolutionTexels = 512; // 1/200 of the radius: a map is off by a texel where it is steep
        settings.soloLight = 0;
        const Picture picture = engine::toPicture(renderer.render(Technique::Deferred, settings));
        double worst = 0.0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                const glm::dvec2 place = (glm::dvec2(x, y) + 0.5 - 64.0) * (1.1 / 64.0); // of the radius
                const double cosine = std::sqrt(std::max(1.0 - glm::dot(place, place), 0.0));
                if (cosine < 0.3) continue; // the rim
                for (int c = 0; c < 3; ++c) {
                    const double absorption = 1e3 * double(scene.materials[0].subsurface.absorptionPerMillimetre[c]);
                    const double wanted = 3.0 * cosine * std::exp(-absorption * 2.0 * kRadius * cosine);
                    const double found = picture.pixel(std::size_t(y * 128 + x))[c];
                    worst = std::max(worst, std::abs(found - wanted) / wanted);
                }
            }
        fmt::print("ball, {}: off by {:.2} at most\n", infoOf(bar.filter).name, worst);
        EXPECT_LE(worst, bar.ofBall) << infoOf(bar.filter).name;
    }
}

/// A lamp and a spot light behind it, to the side: the path inside is the chord towards them. Where it is shorter than
/// the radius, a texel of the map, a three-hundredth of it, covers too steep a part of the ball's other side.
TEST_F(Subsurface, aBallBeforeALampLetsThroughAnExponentialOfItsChords) {
    constexpr double kRadius = 0.02;
    constexpr int kSide = 64;
    scenes::Mesh ball;
    scenes::builtin::appendSphere(ball, glm::dvec3(0.0), kRadius, 256, 128);
    scenes::Scene scene = bodyBeforeLights(ball, 1.1 * kRadius);
    scenes::Light lamp = pointLight({0.03, 0.02, -0.06}, 12.0f), spot = lamp;
    spot.type = scenes::LightType::Spot;
    spot.directionWS = glm::normalize(-spot.positionWS);
    spot.innerConeRadians = 0.4f;
    spot.outerConeRadians = 0.5f;
    scene.lights = {lamp, spot};
    engine::Renderer renderer(context(), scene);
    const glm::dvec3 absorption = 1e3 * glm::dvec3(scene.materials[0].subsurface.absorptionPerMillimetre);
    for (const PassageBar& bar : kPassageBars) {
        if (bar.filter != frame::ShadowFilter::Traced && bar.filter != frame::ShadowFilter::Hard) continue;
        frame::FrameSettings settings = withShadows(ofSize(kSide, kSide), bar.filter);
        settings.shadowMaps.resolutionTexels = 2048;
        for (int light = 0; light < 2; ++light) {
            settings.soloLight = light;
            const Picture picture = engine::toPicture(renderer.render(Technique::Deferred, settings));
            double worst = 0.0;
            int compared = 0;
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    const glm::dvec2 place = (glm::dvec2(x, kSide - 1 - y) + 0.5 - 0.5 * kSide) * (2.2 / kSide);
                    const double square = 1.0 - glm::dot(place, place);
                    if (square < 0.09) continue; // the rim
                    const glm::dvec3 normal(place, std::sqrt(square));
                    const glm::dvec3 toLight = lamp.positionWS - kRadius * normal;
                    const double cosine = -glm::dot(normal, glm::normalize(toLight));
                    if (cosine < 0.5) continue;
                    ++compared;
                    const glm::dvec3 wanted = double(lamp.intensity) / glm::dot(toLight, toLight) * cosine *
                                              glm::exp(-absorption * (2.0 * kRadius * cosine));
                    for (int c = 0; c < 3; ++c) {
                        const double found = double(picture.pixel(std::size_t(y * kSide + x))[c]);
                        worst = std::max(worst, std::abs(found - wanted[c]) / wanted[c]);
                    }
                }
            fmt::print("ball before a {}, {}: off by {:.2} at most of {}\n", light == 0 ? "lamp" : "spot light",
                       infoOf(bar.filter).name, worst, compared);
            EXPECT_GT(compared, 500);
            EXPECT_LE(worst, bar.ofBall) << infoOf(bar.filter).name << ", light " << light;
        }
    }
}

TEST_F(Subsurface, whatIsInTheWayHidesLightThatPassesThroughAsTheReferenceSays) {
    scenes::Scene scene = headWith(SubsurfaceMethod::DepthMap);
    scene.materials[0].subsurface.scaleMetres = 0.1f;
    frame::FrameSettings settings = exactOfSize(240, 135);
    engine::Renderer renderer(context(), scene);
    const ShadowReference truth = shadowReference(scene, settings);
    const WrongPixels count = wrongPixels(renderer, settings, truth);
    // Rounding moves every path inside by a little, and some by more than a hundredth of the light.
    const auto undecided = std::ranges::count(truth.shadowed.undecidedShadows, 1);
    fmt::print("head: {} pixels wrong, {} undecided, {} changed by shadows of {}\n", count.wrong, undecided,
               count.hidden, count.covered);
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(undecided, std::ptrdiff_t(count.covered / 50));
}

TEST_F(Subsurface, lightThatCastsNoShadowsPassesThroughNothing) {
    scenes::Mesh slab;
    scenes::builtin::appendBox(slab, {-0.5, -0.5, -0.003}, {0.5, 0.5, 0.0});
    const scenes::Scene scene = bodyBeforeLights(slab, 0.1);
    frame::FrameSettings settings = withoutShadows(ofSize(65, 65));
    EXPECT_EQ(middleOf(engine::toPicture(frameOf(scene, settings))), 0.0);
}

} // namespace
} // namespace tessera
