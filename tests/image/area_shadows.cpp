// Shadows of area lights past the straight edge of a plate, against the share of the light's own surface that is left.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "scenes/LookAt.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using scenes::LightType;

constexpr double kEdgeX = 0.1; ///< of the plate, half way to the light, which lies at x above it
constexpr glm::ivec2 kFloorPixels{160, 90};
constexpr double kFloorHalfHeight = 0.5; ///< metres of the picture

/// A floor, a light 1 m above it that is 0.8 m long and 0.2 m wide, and half way between a plate that ends at kEdgeX.
/// The camera looks down from below the plate.
scenes::Scene floorUnderAPlate(const scenes::Light& light) {
    scenes::Material matte;
    matte.model = scenes::MaterialModel::Lambert;
    matte.doubleSided = true;
    scenes::Scene scene = test::quadScene(matte);
    scenes::Node& plate = scene.nodes.emplace_back();
    plate.parentFromNode[3] = glm::dvec4(kEdgeX + 1.0, 0.0, 0.5, 1.0);
    plate.instances = {{0, 0}};
    scene.lights = {light};
    scenes::Camera& camera = scene.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = kFloorHalfHeight;
    camera.nearMetres = 0.0;
    camera.worldFromCamera = scenes::worldFromLookAt({0.0, 0.0, 0.3}, {0.0, 0.0, 0.0});
    return scene;
}

scenes::Light lampOverTheFloor(LightType type) {
    scenes::Light light;
    light.type = type;
    light.positionWS = {0.0, 0.0, 1.0};
    light.directionWS = {0.0, 0.0, -1.0};
    light.widthMetres = 0.8f;
    light.heightMetres = 0.2f;
    light.castsShadow = true;
    light.isSeen = false;
    return light;
}

struct FloorShare {
    double seen;
    glm::dvec3 pointWS;
};

/// From where on a plane at the light's height is hidden from a point of the floor: x in metres.
double hiddenFromX(const glm::dvec3& pointWS) {
    return 2.0 * kEdgeX - pointWS.x;
}

/// Of a circle's area, the share on one side of a line, by the line's distance from the middle in radii: 1 at 1.
double shareOfCircle(double radii) {
    const double t = std::clamp(radii, -1.0, 1.0);
    return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

class AreaShadows : public test::ShadowTest {
protected:
    /// Of every type of light with two techniques and without pruning, or with one of these two in turn and every other
    /// one without pruning.
    void expectSameToTheLastBit();
    std::vector<FloorShare> sharesOf(const scenes::Light& light, int samples) {
        const scenes::Scene scene = floorUnderAPlate(light);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = kFloorPixels;
        settings.view = frame::DebugView::Shadow;
        settings.shadowFilter = frame::ShadowFilter::Traced;
        settings.shadowSamples = samples;
        const engine::RenderedFrame shown = renderer.render(engine::Technique::Deferred, settings);
        std::vector<FloorShare> shares;
        for (int y = 0; y < kFloorPixels.y; ++y)
            for (int x = 0; x < kFloorPixels.x; ++x) {
                const double metresAPixel = 2.0 * kFloorHalfHeight / kFloorPixels.y;
                const glm::dvec2 floor = (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(kFloorPixels)) * metresAPixel;
                shares.push_back({double(shown.radiance[4 * (std::size_t(y) * kFloorPixels.x + std::size_t(x))]),
                                  glm::dvec3(floor, 0.0)});
            }
        return shares;
    }

    /// `leftOf`: the share of the area of a flat light below an x.
    void expectShares(const char* name, const scenes::Light& light, const std::function<double(double)>& leftOf) {
        expectSharesAt(name, light, [&](const glm::dvec3& pointWS) { return leftOf(hiddenFromX(pointWS)); });
    }

    /// `truthAt`: the share of the light in sight of a point of the floor.
    void expectSharesAt(const char* name, const scenes::Light& light,
                        const std::function<double(const glm::dvec3&)>& truthAt) {
        double before = 1.0;
        for (const int samples : {4, 16, 64}) {
            SCOPED_TRACE(fmt::format("{}, {} samples", name, samples));
            double sum = 0.0, squares = 0.0, count = 0.0;
            for (const FloorShare& share : sharesOf(light, samples)) {
                const double truth = truthAt(share.pointWS);
                const double error = share.seen - truth;
                if (truth <= 0.0 || truth >= 1.0) {
                    EXPECT_NEAR(error, 0.0, 1e-6);
                    continue;
                }
                sum += error;
                squares += error * error;
                count += 1.0;
            }
            ASSERT_GT(count, 500.0);
            const double rms = std::sqrt(squares / count);
            fmt::print("{}, {} samples: RMS {:.4f} of {} pixels\n", name, samples, rms, count);
            // The random numbers of pixels are independent: four standard errors.
            EXPECT_LE(std::abs(sum / count), 4.0 * rms / std::sqrt(count));
            EXPECT_LE(rms, 0.6 * before) << "the error falls with the number of samples";
            before = rms;
        }
        EXPECT_LE(before, 0.03) << "independent places would leave 0.05";
    }
};

double heldToUnit(double share) {
    return std::min(std::max(share, 0.0), 1.0);
}

TEST_F(AreaShadows, ofARectangleAreAsWideAlongItAndAcrossItAsItIs) {
    scenes::Light light = lampOverTheFloor(LightType::Rectangle);
    expectShares("along", light, [](double x) { return heldToUnit(0.5 + x / 0.8); });
    light.alongWS = {0.0, 1.0, 0.0};
    expectShares("across", light, [](double x) { return heldToUnit(0.5 + x / 0.2); });
}

TEST_F(AreaShadows, ofADiskAreThoseOfItsCircle) {
    scenes::Light light = lampOverTheFloor(LightType::Disk);
    light.radiusMetres = 0.3f;
    expectShares("disk", light, [](double x) { return shareOfCircle(x / 0.3); });
}

TEST_F(AreaShadows, ofAPolygonAreThoseOfItsOutline) {
    scenes::Light light = lampOverTheFloor(LightType::Polygon);
    // Its second axis points along -y, whichever way round that is.
    light.corners = test::cornersOf({{-0.4f, -0.1f}, {0.4f, -0.1f}, {-0.4f, 0.1f}});
    expectShares("triangle", light, [](double x) {
        const double beyond = heldToUnit(0.5 - x / 0.8);
        return 1.0 - beyond * beyond;
    });
    // A bridge: four fifths of it are its legs, which are half of its length.
    light.corners = test::cornersOf({{-0.4f, -0.1f},
                                     {-0.2f, -0.1f},
                                     {-0.2f, 0.05f},
                                     {0.2f, 0.05f},
                                     {0.2f, -0.1f},
                                     {0.4f, -0.1f},
                                     {0.4f, 0.1f},
                                     {-0.4f, 0.1f}});
    expectShares("bridge", light, [](double x) {
        const double left = heldToUnit((x + 0.4) / 0.2), bar = heldToUnit((x + 0.2) / 0.4),
                     right = heldToUnit((x - 0.2) / 0.2);
        return 0.4 * left + 0.2 * bar + 0.4 * right;
    });
}

TEST_F(AreaShadows, ofATubeAreWideAlongItAndNarrowAcrossIt) {
    scenes::Light light = lampOverTheFloor(LightType::Tube);
    light.radiusMetres = 0.05f;
    light.lengthMetres = 0.7f;
    const auto softPixels = [&](const glm::dvec3& axisWS) {
        light.directionWS = axisWS;
        int count = 0;
        for (const FloorShare& share : sharesOf(light, 64)) count += share.seen > 0.05 && share.seen < 0.95;
        return double(count);
    };
    const double along = softPixels({1.0, 0.0, 0.0}), across = softPixels({0.0, 1.0, 0.0});
    ASSERT_GT(across, 500.0);
    EXPECT_GT(along / across, 6.0) << "an eighth as wide as long, and round across";
    EXPECT_LT(along / across, 10.0);
}

/// Its shadow is that of disks which face the point, all along its axis. Where the axis runs along the plate's edge,
/// the plane through a point and that edge cuts all of them alike: as far from their middles as from the light's.
TEST_F(AreaShadows, ofATubeAlongAnEdgeAreThoseOfDisksThatFaceThePoint) {
    constexpr double kRadiusMetres = 0.05;
    scenes::Light light = lampOverTheFloor(LightType::Tube);
    light.radiusMetres = float(kRadiusMetres);
    light.lengthMetres = 0.7f;
    light.directionWS = {0.0, 1.0, 0.0};
    expectSharesAt("tube", light, [&](const glm::dvec3& pointWS) {
        const glm::dvec3 toMiddle = light.positionWS - pointWS, edgeWS(kEdgeX, 0.0, 0.5);
        // At right angles to the edge and to what looks past it, to the side in sight, which is that of -x.
        const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), pointWS - edgeWS));
        const double metres = glm::dot(normal, toMiddle);
        const double sine = std::sqrt(1.0 - metres * metres / glm::dot(toMiddle, toMiddle));
        return shareOfCircle(metres / (kRadiusMetres * sine));
    });
}

using AreaShadowsSlow = AreaShadows;

void AreaShadows::expectSameToTheLastBit() {
    const std::vector<engine::Technique> both{engine::Technique::TiledDeferred, engine::Technique::ClusteredForward};
    std::size_t turn = 0;
    for (const LightType type : test::kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        scenes::Light light = lampOverTheFloor(type);
        light.radiusMetres = 0.2f;
        const scenes::Scene scene = floorUnderAPlate(light);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = kFloorPixels;
        expectParity(renderer, settings, test::isWholeSweep() ? both : std::vector{both[turn % 2]});
        if (!test::isWholeSweep() && turn++ % 2 != 0) continue;
        const std::vector<float> pruned = renderer.render(engine::Technique::Deferred, settings).radiance;
        settings.prune = false;
        EXPECT_EQ(engine::Renderer(context(), scene).render(engine::Technique::Deferred, settings).radiance, pruned);
    }
}
TEST_F(AreaShadows, areTheSameToTheLastBitWithEveryTechniqueAndWithWhatTheSceneDoesNotNeed) {
    expectSameToTheLastBit();
}
TEST_F(AreaShadowsSlow, areTheSameToTheLastBitWithEveryTechniqueAndWithWhatTheSceneDoesNotNeed) {
    expectSameToTheLastBit();
}

} // namespace
} // namespace tessera
