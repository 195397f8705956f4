// Shadows of area lights past the straight edge of a plate, against the visible fraction of the light's surface.
#include <functional>
#include <numbers>

#include "tests/image/AreaLightTest.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/AreaLights.h"

namespace tessera {
namespace {

using scenes::LightType;
using namespace test;

constexpr double kEdgeX = 0.1; ///< edge of the plate, halfway up to the light at x = 0
constexpr glm::ivec2 kFloorPixels{160, 90};
constexpr double kFloorHalfHeight = 0.5; ///< metres of the image

/// A floor, a plate, and a light 1 m above the floor that is 0.8 m long and 0.2 m wide.
scenes::Scene floorUnder(const scenes::Light& light) {
    return floorUnderAPlate(light, kEdgeX, kFloorHalfHeight);
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

/// The x in metres beyond which a plane at the light's height is hidden from a point of the floor.
double hiddenFromX(const glm::dvec3& pointWS) {
    return 2.0 * kEdgeX - pointWS.x;
}

/// Fraction of a circle's area on one side of a line, by the line's distance from the centre in radii: 1 at 1.
double shareOfCircle(double radii) {
    const double t = std::clamp(radii, -1.0, 1.0);
    return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

class AreaShadows : public ShadowTest {
protected:
    std::vector<FloorShare> sharesOf(const scenes::Light& light, int samples) {
        const scenes::Scene scene = floorUnder(light);
        frame::FrameSettings settings = withView(ofSize(kFloorPixels), frame::DebugView::Shadow);
        settings.shadowFilter = frame::ShadowFilter::Traced;
        settings.shadowSamples = samples;
        const engine::RenderedFrame shown = frameOf(scene, settings);
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

    /// `leftOf`: the fraction of a flat light's area below an x.
    void expectShares(const char* name, const scenes::Light& light, const std::function<double(double)>& leftOf) {
        expectSharesAt(name, light, [&](const glm::dvec3& pointWS) { return leftOf(hiddenFromX(pointWS)); });
    }

    /// `truthAt`: the fraction of the light visible from a point of the floor.
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
    // Its second axis points along -y; its sign does not matter.
    light.corners = cornersOf({{-0.4f, -0.1f}, {0.4f, -0.1f}, {-0.4f, 0.1f}});
    expectShares("triangle", light, [](double x) {
        const double beyond = heldToUnit(0.5 - x / 0.8);
        return 1.0 - beyond * beyond;
    });
    // A bridge: its legs are four fifths of its area and half of its length.
    light.corners = cornersOf({{-0.4f, -0.1f},
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

/// The visible fraction of a tube, whose shadow is that of disks that face the point, all along its axis. The plane
/// through the point and the plate's edge cuts each at its distance from that disk's centre, all alike if the axis is
/// parallel to the edge.
double shareOfTube(const scenes::Light& tube, const glm::dvec3& pointWS) {
    const glm::dvec3 toMiddle = tube.positionWS - pointWS, edgeWS(kEdgeX, 0.0, 0.5);
    // Perpendicular to the edge and to the ray past it, towards the visible side, which is -x.
    const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), pointWS - edgeWS));
    const double metres = glm::dot(normal, toMiddle);
    const double sine = std::sqrt(1.0 - metres * metres / glm::dot(toMiddle, toMiddle));
    const double alongMetres = 0.5 * double(tube.lengthMetres) * glm::dot(normal, tube.directionWS);
    constexpr int kDisks = 64;
    double sum = 0.0;
    for (int i = 0; i < kDisks; ++i)
        sum += shareOfCircle((metres + ((2.0 * i + 1.0) / kDisks - 1.0) * alongMetres) /
                             (double(tube.radiusMetres) * sine));
    return sum / kDisks;
}

TEST_F(AreaShadows, ofATubeAlongAnEdgeAreThoseOfDisksThatFaceThePoint) {
    scenes::Light light = lampOverTheFloor(LightType::Tube);
    light.radiusMetres = 0.05f;
    light.lengthMetres = 0.7f;
    light.directionWS = {0.0, 1.0, 0.0};
    expectSharesAt("tube", light, [&](const glm::dvec3& pointWS) { return shareOfTube(light, pointWS); });
}

/// Of a tube as wide as long, places along its axis that follow from those on its disks bias the darker and the
/// brighter half of its shadow against each other.
TEST_F(AreaShadows, ofAWideTubeTakePlacesOnItsDisksAndAlongItsAxisThatAreIndependent) {
    scenes::Light light = lampOverTheFloor(LightType::Tube);
    light.radiusMetres = 0.15f;
    light.lengthMetres = 0.3f;
    light.directionWS = {1.0, 0.0, 0.0};
    double sums[2] = {}, squares[2] = {};
    for (const FloorShare& share : sharesOf(light, 1)) {
        const double truth = shareOfTube(light, share.pointWS), error = share.seen - truth;
        sums[truth < 0.5] += error;
        squares[truth < 0.5] += error * error;
    }
    for (const int half : {0, 1}) {
        EXPECT_GT(squares[half], 100.0);
        EXPECT_LE(std::abs(sums[half]), 4.0 * std::sqrt(squares[half])) << "four standard errors";
    }
}

/// The filter pcss searches for casters as if they were half-way to the lamp. A plate nearer to it has a wider
/// penumbra, which ends abruptly where its edge leaves the search, on both sides: seen from the lamp, a radius per
/// metre aside.
TEST_F(AreaShadows, byPcssOfAPlateNearALampEndAbruptlyOnBothSides) {
    constexpr double kRadiusMetres = 0.06, kPlateMetres = 0.8, kTexelMetres = 2.0 / 1024.0;
    scenes::Light lamp = pointLight({0.0, 0.0, 1.0}, 1.0f);
    lamp.radiusMetres = float(kRadiusMetres);
    lamp.castsShadow = true;
    scenes::Scene scene = floorUnderAPlate(lamp, 0.0, kFloorHalfHeight);
    scene.nodes[1].parentFromNode[3].z = kPlateMetres;
    frame::FrameSettings settings = withView(ofSize(kFloorPixels), frame::DebugView::Shadow);
    settings.shadowFilter = frame::ShadowFilter::Pcss;
    settings.shadowSamples = 64;
    settings.shadowMaps.resolutionTexels = 1024;
    const std::vector<float> seen = drawn(scene, settings);
    int between = 0;
    for (int x = 0; x < kFloorPixels.x; ++x) {
        const double metres = (x + 0.5 - 0.5 * kFloorPixels.x) * 2.0 * kFloorHalfHeight / kFloorPixels.y;
        const float share = *pixelAt(seen, kFloorPixels.x, x, kFloorPixels.y / 2);
        if (std::abs(metres) > kRadiusMetres + kTexelMetres)
            EXPECT_EQ(share, metres < 0.0 ? 1.0f : 0.0f) << metres;
        else
            between += share > 0.3f && share < 0.7f;
    }
    EXPECT_GT(between, 5);
}

/// Every type of light with both techniques and without pruning; in a short sweep with one of them in turn, and every
/// second type without pruning.
TEST_SWEEP(AreaShadows, areTheSameToTheLastBitWithEveryTechniqueAndWithWhatTheSceneDoesNotNeed) {
    const std::vector<engine::Technique> both{engine::Technique::TiledDeferred, engine::Technique::ClusteredForward};
    std::size_t turn = 0;
    for (const LightType type : kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        scenes::Light light = lampOverTheFloor(type);
        light.radiusMetres = 0.2f;
        const scenes::Scene scene = floorUnder(light);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(kFloorPixels);
        expectParity(renderer, settings, isWholeSweep() ? both : std::vector{both[turn % 2]});
        if (!isWholeSweep() && turn++ % 2 != 0) continue;
        const std::vector<float> pruned = renderer.render(engine::Technique::Deferred, settings).radiance;
        settings.prune = false;
        EXPECT_EQ(drawn(scene, settings), pruned);
    }
}

// Sampled light and sampled shadows of an area light are multiplied. The mean of the product is the product of the
// means only if both use independent random numbers.

constexpr int kShadowPixels = 64;
constexpr int kFewSamples = 4; ///< of each kind, so that both are noisy

class AreaSampleShadows : public ShadowTest {
protected:
    /// Every pixel shows the same point of a floor, from below a plate that hides half of a light.
    static scenes::Scene placeUnderAPlate() {
        scenes::Light light = areaLight(scenes::LightType::Rectangle, {0.0, 0.0, 1.0}, {0.5, 0.3, -1.0}, 1.0f);
        light.widthMetres = light.heightMetres = 1.6f;
        light.castsShadow = true;
        light.isSeen = false;
        return floorUnderAPlate(light, 0.0, 1e-5);
    }
    static std::vector<double> redOf(engine::Renderer& renderer, scenes::ShadowRequest shadows) {
        frame::FrameSettings settings = ofSize(kShadowPixels, kShadowPixels);
        settings.area = {frame::AreaLights::Sampled, kFewSamples};
        settings.shadows = shadows;
        settings.shadowFilter = frame::ShadowFilter::Traced;
        settings.shadowSamples = kFewSamples;
        const std::vector<float> radiance = renderer.render(engine::Technique::Deferred, settings).radiance;
        std::vector<double> red;
        for (std::size_t i = 0; i < radiance.size(); i += 4) red.push_back(double(radiance[i]));
        return red;
    }
};

double meanOfProduct(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum / double(a.size());
}
double deviation(const std::vector<double>& values, double mean) {
    return std::sqrt(std::max(meanOfProduct(values, values) - mean * mean, 0.0));
}

TEST_F(AreaSampleShadows, takeRandomNumbersThatTheLightDoesNot) {
    const scenes::Scene scene = placeUnderAPlate();
    engine::Renderer renderer(context(), scene);
    const std::vector<double> light = redOf(renderer, {scenes::ShadowRequest::Kind::None});
    std::vector<double> visible = redOf(renderer, kAllLightsCast);
    const std::vector<double> ones(light.size(), 1.0);
    for (std::size_t i = 0; i < light.size(); ++i) visible[i] /= light[i];
    const double meanLight = meanOfProduct(light, ones), meanVisible = meanOfProduct(visible, ones);
    const double lightNoise = deviation(light, meanLight), shadowNoise = deviation(visible, meanVisible);
    const double correlation = (meanOfProduct(light, visible) - meanLight * meanVisible) / (lightNoise * shadowNoise);
    fmt::print("light {:.3f} +- {:.3f}, visible {:.3f} +- {:.3f}, correlation {:+.3f}\n", meanLight, lightNoise,
               meanVisible, shadowNoise, correlation);
    EXPECT_GT(lightNoise, 0.01 * meanLight);
    EXPECT_GT(shadowNoise, 0.05);
    EXPECT_LE(std::abs(correlation), 4.0 / kShadowPixels) << "four standard errors of independent pixels";
}

} // namespace
} // namespace tessera
