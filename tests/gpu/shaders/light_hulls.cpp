// The proxy volumes of lights as geometry: closed, around all that the light can affect, and not much larger.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/light_volumes.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

struct Spot {
    glm::vec3 apex{0.0f};
    float reach = 1.0f;
    glm::vec3 axis{0, 0, -1};
    float cosOuter = 0.5f;
    float margin = 0.0f;
};
struct Volume {
    std::vector<glm::vec3> corners; ///< three per triangle
    float margin;                   ///< with which the light would be drawn
    bool vast;
};

class LightHulls : public test::GlTest {
protected:
    LightHulls() {
        view_ = {};
        // Copies the position to x, y and w of the clip coordinates, so that all of it can be read.
        view_.clipFromLS = glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 0, 1), glm::vec4(0));
        view_.forwardLS = {0, 0, -1, 1};
        view_.aheadFromDepth = {10, -10, 1, 0};
        view_.depthKey = {1, 0, 0, 0};
        view_.rayFromPixel = {0.01f, 0.01f, 0, 0};
    }

    std::vector<Volume> volumes(const std::vector<Spot>& spots) {
        std::vector<glm::vec4> inputs;
        for (const Spot& spot : spots)
            inputs.insert(inputs.end(), {{spot.apex, spot.reach}, {spot.axis, spot.cosOuter}, {spot.margin, 0, 0, 0}});
        const gpu::Buffer constants = gpu::Buffer::of("view", std::span(&view_, 1));
        gpu::bindUniformBuffer(UNIFORM_VIEW, constants);
        constexpr std::size_t kOutputsPerSpot = LIGHT_VOLUME_CONE_VERTICES + 1;
        const std::vector<glm::vec4> out =
            bench_.run("test/light_hulls.comp", frame::featureDefines(frame::allFeatures()), inputs, spots.size(),
                       kOutputsPerSpot);
        std::vector<Volume> result;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const glm::vec4* of = &out[i * kOutputsPerSpot];
            Volume& volume = result.emplace_back();
            for (int c = 0; c < LIGHT_VOLUME_CONE_VERTICES; ++c) volume.corners.emplace_back(of[c].x, of[c].y, of[c].w);
            volume.margin = of[kOutputsPerSpot - 1].x;
            volume.vast = of[kOutputsPerSpot - 1].y != 0.0f;
        }
        return result;
    }

    static std::vector<Spot> randomSpots(int count) {
        test::Random random(3);
        std::vector<Spot> spots;
        for (int i = 0; i < count; ++i) {
            Spot& spot = spots.emplace_back();
            spot.apex = glm::vec3(random.direction());
            spot.reach = float(random.logarithmic(0.5, 20.0));
            spot.axis = glm::vec3(random.direction());
            spot.cosOuter = float(std::cos(random.logarithmic(0.01, 84.0 * test::pi / 180.0)));
            spot.margin = spot.reach * (i % 2 == 0 ? 0.02f : 0.2f);
        }
        return spots;
    }

    shared::ViewConstants view_;
    test::ShaderBench bench_;
};

/// Points on the light's outline, including the apex; their convex hull is the lit volume.
std::vector<glm::dvec3> outline(const Spot& spot) {
    std::vector<glm::dvec3> points{glm::dvec3(spot.apex)};
    const glm::dvec3 axis = glm::normalize(glm::dvec3(spot.axis));
    const glm::dvec3 first =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 second = glm::cross(axis, first);
    const double outer = std::acos(double(spot.cosOuter));
    constexpr int kTurns = 64, kRings = 8;
    for (int ring = 0; ring <= kRings; ++ring) {
        const double angle = outer * ring / kRings;
        for (int turn = 0; turn < kTurns; ++turn) {
            const double phi = 2.0 * test::pi * turn / kTurns;
            const glm::dvec3 across = std::cos(phi) * first + std::sin(phi) * second;
            points.push_back(glm::dvec3(spot.apex) +
                             double(spot.reach) * (std::cos(angle) * axis + std::sin(angle) * across));
        }
    }
    return points;
}

TEST_F(LightHulls, theHullOfASpotIsClosed) {
    const std::vector<Spot> spots = randomSpots(50);
    const std::vector<Volume> drawn = volumes(spots);
    for (std::size_t i = 0; i < spots.size(); ++i) {
        SCOPED_TRACE(i);
        using Corner = std::array<float, 3>;
        std::map<std::pair<Corner, Corner>, int> edges; // number of triangles along each directed edge
        const std::vector<glm::vec3>& corners = drawn[i].corners;
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const glm::vec3 &from = corners[c], &to = corners[c - c % 3 + (c + 1) % 3];
            ASSERT_NE(from, to) << "a triangle without a side";
            ++edges[{Corner{from.x, from.y, from.z}, Corner{to.x, to.y, to.z}}];
        }
        for (const auto& [edge, times] : edges) {
            ASSERT_EQ(times, 1);
            const auto back = edges.find({edge.second, edge.first});
            ASSERT_TRUE(back != edges.end()) << "a side that two triangles do not share";
        }
    }
}

TEST_F(LightHulls, theHullOfASpotHoldsItsLightAndTheMarginAroundIt) {
    const std::vector<Spot> spots = randomSpots(200);
    const std::vector<Volume> drawn = volumes(spots);
    double tightest = 1e30, loosestRounding = 0.0;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const Spot& spot = spots[i];
        const std::vector<glm::dvec3> points = outline(spot);
        const std::vector<glm::vec3>& corners = drawn[i].corners;
        for (std::size_t c = 0; c < corners.size(); c += 3) {
            const glm::dvec3 a(corners[c]), b(corners[c + 1]), d(corners[c + 2]);
            const glm::dvec3 area = glm::cross(b - a, d - a), normal = glm::normalize(area);
            double nearest = 1e30;
            for (const glm::dvec3& point : points) nearest = std::min(nearest, glm::dot(a - point, normal));
            // A corner is off by some ten roundings of fp32, which tilts the plane of a narrow triangle.
            const double height =
                glm::length(area) / std::max({glm::length(b - a), glm::length(d - b), glm::length(a - d)});
            const double rounding = 10.0 * 0x1p-24 * (1.0 + spot.reach) * (1.0 + spot.reach / height);
            ASSERT_GE(nearest, spot.margin - rounding)
                << "spot " << i << ", triangle " << c / 3 << ", cosine " << spot.cosOuter;
            tightest = std::min(tightest, nearest / spot.margin);
            loosestRounding = std::max(loosestRounding, rounding / spot.margin);
        }
    }
    EXPECT_LE(loosestRounding, 0.1) << "rounding is granted so much that nothing is judged";
    EXPECT_LE(tightest, 1.001) << "no face touches what it encloses";
}

/// Checks the figures in lib/light/light_volume.glsl.
TEST_F(LightHulls, theHullOfASpotIsNotMuchLargerThanItsLight) {
    std::vector<Spot> spots;
    for (const double degrees : {1.0, 10.0, 30.0, 60.0, 75.0, 84.0}) {
        Spot& spot = spots.emplace_back();
        spot.cosOuter = float(std::cos(degrees * test::pi / 180.0));
        spot.margin = 1e-5f;
    }
    const std::vector<Volume> drawn = volumes(spots);
    double last = 1.054; // area of the octagon over its circle's
    for (std::size_t i = 0; i < spots.size(); ++i) {
        double volume = 0.0;
        const std::vector<glm::vec3>& corners = drawn[i].corners;
        for (std::size_t c = 0; c < corners.size(); c += 3) {
            const glm::dvec3 a(corners[c]), b(corners[c + 1]), d(corners[c + 2]);
            volume += glm::dot(a, glm::cross(b, d)) / 6.0;
        }
        const double light = 2.0 * test::pi / 3.0 * (1.0 - double(spots[i].cosOuter));
        EXPECT_GE(volume / light, last) << "cosine " << spots[i].cosOuter;
        last = volume / light;
    }
    EXPECT_LE(last, 1.395);
}

TEST_F(LightHulls, aVolumeIsAnEighthOfAPixelLargerThanItsLight) {
    view_.rayFromPixel = {0.01f, 0.02f, 0, 0};
    Spot small;
    small.reach = 1e-3f;
    small.cosOuter = 0.9f;
    // The margin is an eighth of a pixel, and less than 1 % more; lengths of a millimetre round by some 1e-8 m.
    EXPECT_NEAR(volumes({small})[0].margin, 0.125 * 0.02, 1e-6 + 1e-3 * 0.125 * 0.02);
    view_.forwardLS.w = 0.0f;
    view_.eyeLS = {0, 0, 50, 50}; // a pixel is that wide a metre ahead of the eye
    EXPECT_NEAR(volumes({small})[0].margin, 0.125 * 0.02 * 50.0, 1e-3 * 0.125 * 0.02 * 50.0);
}

TEST_F(LightHulls, aLightIsVastWhereEitherSideOfThePictureIsTooSmallForIt) {
    for (const glm::vec2 clipPerMetre : {glm::vec2(1.0f, 0.25f), glm::vec2(0.25f, 1.0f)}) {
        SCOPED_TRACE(clipPerMetre.x);
        view_.clipFromLS = glm::mat4(1.0f);
        view_.clipFromLS[0].x = clipPerMetre.x;
        view_.clipFromLS[1].y = clipPerMetre.y;
        std::vector<Spot> spots(2);
        spots[0].reach = 255.0f;
        spots[1].reach = 257.0f;
        view_.forwardLS.w = 1.0f;
        const std::vector<Volume> orthographic = volumes(spots);
        EXPECT_FALSE(orthographic[0].vast);
        EXPECT_TRUE(orthographic[1].vast);
        view_.forwardLS.w = 0.0f;
        EXPECT_FALSE(volumes(spots)[1].vast) << "a perspective camera";
    }
}

} // namespace
} // namespace tessera
