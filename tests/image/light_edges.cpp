// Light culling at its limits: lights that barely reach a pixel, and lights just above its surface.
#include <functional>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ImageTest.h"
#include "tests/support/CullingScenes.h"
#include "tests/support/Random.h"
#include "validation/culling/LightOracle.h"
#include "validation/culling/PixelPositions.h"

namespace tessera {
namespace {

using culling::Builder;
using culling::Method;
using engine::Technique;
using namespace test;

/// A method with a deferred technique and one that shades as it rasterises.
struct Methods {
    Method method;
    Technique techniques[2];
};
constexpr Methods kEdgeMethods[] = {{Method::TileMinmax, {Technique::TiledDeferred, Technique::ForwardPlus}},
                                    {Method::Tile25d, {Technique::TiledDeferred, Technique::ForwardPlus}},
                                    {Method::Cluster, {Technique::ClusteredDeferred, Technique::ClusteredForward}},
                                    {Method::Zbin, {Technique::ClusteredDeferred, Technique::ClusteredForward}}};

/// A random light whose range or cone ends just behind a surface point.
scenes::Light lightThatJustReaches(const glm::dvec3& surfaceWS, Random& random) {
    scenes::Light light;
    light.intensity = float(random.logarithmic(1.0, 1e3));
    const glm::dvec3 toSurfaceWS = random.direction();
    const double metres = random.logarithmic(0.05, 50.0);
    light.positionWS = surfaceWS - metres * toSurfaceWS;
    // From the smallest distance that fp32 resolves after some roundings to the distance that a bound too small by a
    // hundredth would cut off.
    const double hair = random.logarithmic(1e-6, 1e-2);
    light.rangeMetres = float(metres * (1.0 + hair));
    if (random.unit() < 0.3) {
        light.type = scenes::LightType::Spot;
        light.rangeMetres = float(1.5 * metres);
        light.outerConeRadians = float(random.logarithmic(0.5, 179.0) * pi / 180.0);
        const double cosine = std::cos(double(light.outerConeRadians) * (1.0 - hair));
        light.directionWS = random.around(toSurfaceWS, cosine, cosine);
    }
    return light;
}

/// A light just above the plane of a surface, with a range far beyond it.
scenes::Light lightJustInFront(const glm::dvec3& surfaceWS, const glm::dvec3& normalWS, Random& random) {
    scenes::Light light;
    light.intensity = float(random.logarithmic(1.0, 1e3));
    const double metres = random.logarithmic(0.05, 50.0);
    const double hair = random.logarithmic(1e-7, 1e-2);
    const glm::dvec3 toLightWS = random.around(glm::normalize(normalWS), hair, hair);
    light.positionWS = surfaceWS + metres * toLightWS;
    light.rangeMetres = float(metres * random.between(1.1, 3.0));
    if (random.unit() < 0.3) {
        light.type = scenes::LightType::Spot;
        light.outerConeRadians = float(random.logarithmic(0.5, 179.0) * pi / 180.0);
        const double cosine = std::cos(double(light.outerConeRadians) * random.unit());
        light.directionWS = random.around(-toLightWS, cosine, 1.0);
    }
    return light;
}

/// Half of the time moves to the first or last pixel of eight, where tiles end.
int towardsTilesEdge(int pixel, int size, Random& random) {
    if (random.unit() < 0.5) return pixel;
    return std::min(size - 1, pixel / 8 * 8 + (random.unit() < 0.5 ? 0 : 7));
}

/// Contents of a frame: the view depths of its depth values, depth values from the bottom row on, and RGBA normals from
/// the top row on. Normals of transparent surfaces are blended, and shorter than 1.
struct Seen {
    frame::DepthInterval depths;
    std::vector<float> depth, normalWS;
};

/// Lights to replace the scene's, at the surfaces of random pixels; none if the image shows no surface.
std::vector<scenes::Light> lightsByAHair(const scenes::Scene& scene, const frame::FrameSettings& settings,
                                         const Seen& seen, bool ofHorizon, Random& random) {
    const validation::PixelPositions positions(scene.cameras[0], settings, seen.depths);
    const glm::ivec2 size = settings.sizePixels;
    std::vector<scenes::Light> lights;
    for (int i = 0; i < 400 && lights.size() < 100; ++i) {
        const int column = towardsTilesEdge(random.index(size.x), size.x, random);
        const int rowFromTop = towardsTilesEdge(random.index(size.y), size.y, random);
        const int row = size.y - 1 - rowFromTop;
        const float pixelDepth = seen.depth[std::size_t(row) * std::size_t(size.x) + std::size_t(column)];
        if (!(pixelDepth > 0.0f)) continue;
        const glm::dvec3 surfaceWS = positions.positionWS(column, row, pixelDepth);
        const float* const normalWS =
            &seen.normalWS[4 * (std::size_t(rowFromTop) * std::size_t(size.x) + std::size_t(column))];
        lights.push_back(ofHorizon ? lightJustInFront(surfaceWS, {normalWS[0], normalWS[1], normalWS[2]}, random)
                                   : lightThatJustReaches(surfaceWS, random));
    }
    return lights;
}

class LightEdges : public ImageTest {
protected:
    /// Tests random scenes with the eye times(seed) times as far away; a short sweep takes few, pruned. Lights end just
    /// behind a surface or, with `ofHorizon`, stand just in front of one, with lists that omit lights behind surfaces.
    void expectSound(std::uint64_t seeds, const std::function<double(std::uint64_t)>& times, bool ofHorizon = false);

    /// Renders depth and normals with one sun: no light changes them, and its programs serve all scenes.
    Seen see(engine::Renderer& renderer, scenes::Scene& scene, frame::FrameSettings settings) {
        scene.lights = {sunLight({0.0, 0.0, -1.0}, 1.0f)};
        renderer.draw(Technique::Forward, settings);
        Seen seen{renderer.downloadLists().depths, renderer.downloadDepth(), {}};
        settings.view = frame::DebugView::Normal;
        seen.normalWS = renderer.render(Technique::Deferred, settings).radiance;
        return seen;
    }
};

void LightEdges::expectSound(std::uint64_t seeds, const std::function<double(std::uint64_t)>& times, bool ofHorizon) {
    constexpr glm::ivec2 kSizes[] = {{97, 61}, {33, 17}, {64, 64}, {130, 9}};
    if (!isWholeSweep()) seeds = std::max<std::uint64_t>(seeds / 24, 6); // six distances of the eye
    std::uint64_t needed = 0, evaluated = 0;
    std::size_t lights = 0, scenes = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        scenes::Scene scene = randomLitScene(seed);
        scene.cameras[0] = seenFromAfar(scene.cameras[0], times(seed));
        Random random(seed + 5000);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(kSizes[random.index(int(std::size(kSizes)))]);
        // Without pruning all scenes share their programs, though these are large. They allow for coats, which disable
        // culling by normals.
        settings.prune = ofHorizon || !isWholeSweep();
        scene.lights = lightsByAHair(scene, settings, see(renderer, scene, settings), ofHorizon, random);
        if (scene.lights.empty()) continue;
        ++scenes;
        lights += scene.lights.size();
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        for (const Methods& method : kEdgeMethods) {
            frame::FrameSettings requested = settings;
            requested.culling.method = method.method;
            requested.culling.tilePixels = culling::kTileSides[random.index(4)];
            requested.culling.builder = culling::builderTable()[std::size_t(random.index(3))].builder;
            SCOPED_TRACE(fmt::format("seed {}, {}, tile {}, {}x{}", seed, infoOf(method.method).name,
                                     *requested.culling.tilePixels, requested.sizePixels.x, requested.sizePixels.y));
            requested.culling.normals = ofHorizon ? culling::NormalTest::On : culling::NormalTest::Off;
            if (ofHorizon) requested.culling.builder = Builder::Cpu;
            const Technique technique = method.techniques[ofHorizon ? 0 : random.index(2)];
            EXPECT_TRUE(renderer.render(technique, requested).radiance == truth);
            EXPECT_EQ(renderer.downloadLists().culling.normals == culling::NormalTest::On,
                      ofHorizon && method.method != Method::Zbin);
            const validation::LightOracleFigures figures = validation::judgeLights(renderer, technique, requested);
            const validation::LightOracleFigures::Pair first =
                figures.firstMissing.value_or(validation::LightOracleFigures::Pair{});
            EXPECT_EQ(figures.falseNegatives, 0u)
                << "first at pixel " << first.x << ", " << first.y << ", light " << first.light;
            needed += figures.needed;
            evaluated += figures.evaluated;
        }
        if (HasFailure()) break;
    }
    fmt::print("{} scenes, {} lights by a hair: {} pairs needed, {} visited\n", scenes, lights, needed, evaluated);
    EXPECT_GT(lights, 50 * seeds) << "too few lights to prove anything";
}

double nearby(std::uint64_t) {
    return 1.0;
}
double farAway(std::uint64_t seed) {
    return std::pow(10.0, double(1 + seed % 6));
}

TEST_SWEEP(LightEdges, aLightThatReachesAPixelByAHairIsNotMissing) {
    expectSound(200, nearby);
}

TEST_SWEEP(LightEdges, aLightThatReachesAPixelByAHairIsNotMissingWhereTheEyeIsFarAway) {
    expectSound(48, farAway);
}

TEST_SWEEP(LightEdges, aLightThatStandsByAHairInFrontOfASurfaceIsNotMissing) {
    expectSound(120, nearby, true);
}

// A flat wall has no extent along its normal: only margins for rounding keep the lights in its plane.
TEST_F(LightEdges, lightsInThePlaneOfAWallAreNotMissingFromAnyDistance) {
    std::size_t lit = 0;
    for (std::uint64_t seed = 1; seed <= 48 && !HasFailure(); ++seed) {
        Random random(seed);
        scenes::Scene scene = quadScene({});
        const double tilt = seed % 3 == 0 ? 0.0 : random.logarithmic(1e-5, 1.0);
        scene.nodes[0].parentFromNode = glm::rotate(glm::dmat4(1.0), tilt, random.direction());
        scenes::Camera& camera = scene.cameras[0];
        if (seed % 2 == 0) {
            makeOrthographic(camera, 1.0);
        }
        camera = seenFromAfar(camera, std::pow(10.0, double(seed % 7)));
        const glm::dmat4& worldFromQuad = scene.nodes[0].parentFromNode;
        for (int i = 0; i < 60; ++i) {
            const double height = random.logarithmic(1e-10, 1e-2) * (random.unit() < 0.5 ? -1.0 : 1.0);
            const glm::dvec4 placeOS(random.between(-1.0, 1.0), random.between(-1.0, 1.0), height, 1.0);
            scenes::Light light = pointLight(glm::dvec3(worldFromQuad * placeOS), 1e3f);
            light.rangeMetres = 0.3f;
            scene.lights.push_back(light);
        }
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(64, 64);
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        lit += std::size_t(std::ranges::count_if(truth, [](float value) { return value > 0.0f && value != 1.0f; }));
        settings.culling.normals = culling::NormalTest::On;
        settings.culling.builder = Builder::Cpu;
        settings.culling.tilePixels = 8;
        for (const Technique technique : {Technique::TiledDeferred, Technique::ClusteredDeferred}) {
            SCOPED_TRACE(fmt::format("seed {}, {}", seed, infoOf(technique).name));
            EXPECT_TRUE(renderer.render(technique, settings).radiance == truth);
            EXPECT_EQ(renderer.downloadLists().culling.normals, culling::NormalTest::On);
        }
    }
    EXPECT_GT(lit, 50000u) << "lights that light nothing prove nothing";
}

TEST_SWEEP(LightEdges, aLightThatStandsByAHairInFrontOfASurfaceIsNotMissingWhereTheEyeIsFarAway) {
    expectSound(48, farAway, true);
}

} // namespace
} // namespace tessera
