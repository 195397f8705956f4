// Light culling at the very edge of lights: those that reach a pixel by a hair.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "tests/support/CullingScenes.h"
#include "tests/support/GlContext.h"
#include "tests/support/Random.h"
#include "tests/support/Sweep.h"
#include "validation/culling/LightOracle.h"
#include "validation/culling/PixelPositions.h"

namespace tessera {
namespace {

using culling::Method;
using engine::Technique;

/// A technique of each method, a deferred one and one that shades as it rasterises.
struct Methods {
    Method method;
    Technique techniques[2];
};
constexpr Methods kEdgeMethods[] = {{Method::TileMinmax, {Technique::TiledDeferred, Technique::ForwardPlus}},
                                    {Method::Tile25d, {Technique::TiledDeferred, Technique::ForwardPlus}},
                                    {Method::Cluster, {Technique::ClusteredDeferred, Technique::ClusteredForward}},
                                    {Method::Zbin, {Technique::ClusteredDeferred, Technique::ClusteredForward}}};

/// A light, somewhere, whose range or cone ends a hair behind the surface of a pixel.
scenes::Light lightThatJustReaches(const glm::dvec3& surfaceWS, test::Random& random) {
    scenes::Light light;
    light.intensity = float(random.logarithmic(1.0, 1e3));
    const glm::dvec3 toSurfaceWS = random.direction();
    const double metres = random.logarithmic(0.05, 50.0);
    light.positionWS = surfaceWS - metres * toSurfaceWS;
    // From the least distance that fp32 resolves after some roundings to the distance that a bound too small by a
    // hundredth would cut off.
    const double hair = random.logarithmic(1e-6, 1e-2);
    light.rangeMetres = float(metres * (1.0 + hair));
    if (random.unit() < 0.3) {
        light.type = scenes::LightType::Spot;
        light.rangeMetres = float(1.5 * metres);
        light.outerConeRadians = float(random.logarithmic(0.5, 179.0) * test::pi / 180.0);
        const double cosine = std::cos(double(light.outerConeRadians) * (1.0 - hair));
        light.directionWS = random.around(toSurfaceWS, cosine, cosine);
    }
    return light;
}

/// Half of the time the first or last of eight, since tiles end there.
int towardsTilesEdge(int pixel, int size, test::Random& random) {
    if (random.unit() < 0.5) return pixel;
    return std::min(size - 1, pixel / 8 * 8 + (random.unit() < 0.5 ? 0 : 7));
}

/// In place of the scene's lights; none where the picture shows no surface.
std::vector<scenes::Light> lightsByAHair(const scenes::Scene& scene, const frame::FrameSettings& settings,
                                         const frame::DepthInterval& depths, std::span<const float> depth,
                                         test::Random& random) {
    const validation::PixelPositions positions(scene.cameras[0], settings, depths);
    const glm::ivec2 size = settings.sizePixels;
    std::vector<scenes::Light> lights;
    for (int i = 0; i < 400 && lights.size() < 100; ++i) {
        const int column = towardsTilesEdge(random.index(size.x), size.x, random);
        const int rowFromTop = towardsTilesEdge(random.index(size.y), size.y, random);
        const int row = size.y - 1 - rowFromTop;
        const float pixelDepth = depth[std::size_t(row) * std::size_t(size.x) + std::size_t(column)];
        if (!(pixelDepth > 0.0f)) continue;
        lights.push_back(lightThatJustReaches(positions.positionWS(column, row, pixelDepth), random));
    }
    return lights;
}

class LightEdges : public test::GlTest {
protected:
    /// Random scenes, a quarter of them unless the sweep is whole, their eyes so many times as far away by seed.
    void expectSound(std::uint64_t seeds, const std::function<double(std::uint64_t)>& times);
};

void LightEdges::expectSound(std::uint64_t seeds, const std::function<double(std::uint64_t)>& times) {
    constexpr glm::ivec2 kSizes[] = {{97, 61}, {33, 17}, {64, 64}, {130, 9}};
    if (!test::isWholeSweep()) seeds /= 4;
    std::uint64_t needed = 0, evaluated = 0;
    std::size_t lights = 0, scenes = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        scenes::Scene scene = test::randomLitScene(seed);
        scene.cameras[0] = test::seenFromAfar(scene.cameras[0], times(seed));
        test::Random random(seed + 5000);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = kSizes[random.index(int(std::size(kSizes)))];
        settings.prune = false; // all scenes share their programs
        renderer.draw(Technique::Forward, settings);
        scene.lights =
            lightsByAHair(scene, settings, renderer.downloadLists().depths, renderer.downloadDepth(), random);
        if (scene.lights.empty()) continue;
        ++scenes;
        lights += scene.lights.size();
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        for (const Methods& method : kEdgeMethods) {
            frame::FrameSettings asked = settings;
            asked.culling.method = method.method;
            asked.culling.tilePixels = culling::kTileSides[random.index(4)];
            asked.culling.builder = culling::builderTable()[std::size_t(random.index(3))].builder;
            SCOPED_TRACE(fmt::format("seed {}, {}, tile {}, {}x{}", seed, infoOf(method.method).name,
                                     *asked.culling.tilePixels, asked.sizePixels.x, asked.sizePixels.y));
            EXPECT_TRUE(renderer.render(method.techniques[random.index(2)], asked).radiance == truth);
            const engine::DrawnLists drawn = renderer.downloadLists();
            const std::vector<float> depth = renderer.downloadDepth();
            const validation::LightOracleFigures figures = validation::judgeLights({scene, asked, drawn, depth, {}});
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

using LightEdgesSlow = LightEdges;

double nearby(std::uint64_t) {
    return 1.0;
}
double farAway(std::uint64_t seed) {
    return std::pow(10.0, double(1 + seed % 6));
}

TEST_F(LightEdges, aLightThatReachesAPixelByAHairIsNotMissing) {
    expectSound(200, nearby);
}
TEST_F(LightEdgesSlow, aLightThatReachesAPixelByAHairIsNotMissing) {
    expectSound(200, nearby);
}

TEST_F(LightEdges, aLightThatReachesAPixelByAHairIsNotMissingWhereTheEyeIsFarAway) {
    expectSound(48, farAway);
}
TEST_F(LightEdgesSlow, aLightThatReachesAPixelByAHairIsNotMissingWhereTheEyeIsFarAway) {
    expectSound(48, farAway);
}

} // namespace
} // namespace tessera
