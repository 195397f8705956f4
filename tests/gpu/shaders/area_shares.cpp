// The fraction of a lobe that an area light covers, for lights of any width and where outlines change, compared with
// integrals over their surfaces in double.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gpu/shaders/SeenShapes.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using scenes::LightType;
using namespace test;

/// Concave outlines: a square without one of its quarters, and one with a notch from below.
const std::vector<glm::vec2> kEll{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
const std::vector<glm::vec2> kBridge{{-1, -1},   {-0.5f, -1}, {-0.5f, 0.5f}, {0.5f, 0.5f},
                                     {0.5f, -1}, {1, -1},     {1, 1},        {-1, 1}};

std::vector<double> sharesSeen(ShaderBench& bench, const std::vector<SeenShape>& shapes, const glm::mat3& matrix) {
    std::vector<double> shares;
    for (const SeenByShader& seen : seenByShader(bench, shapes, matrix)) shares.push_back(seen.share);
    return shares;
}

class AreaShares : public test::GlTest {
protected:
    std::vector<double> run(const std::vector<SeenShape>& shapes, const glm::mat3& matrix) {
        return sharesSeen(bench_, shapes, matrix);
    }

private:
    test::ShaderBench bench_;
};

/// Earlier fault: corners rounded to 1e-7 of the distance made strips of 1e-6 wrong by 4 %.
TEST_F(AreaShares, narrowLightsKeepTheirDigits) {
    std::vector<SeenShape> shapes;
    for (double width = 1e-6; width < 1.5e-2; width *= 2.15)
        for (int i = 0; i < 7; ++i) {
            const glm::dvec3 middle(-0.4 + 0.13 * i, 0.2 * i - 0.5, 1.0 + 0.1 * i);
            const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 0.3 + 0.2 * i, -0.1));
            const glm::dvec3 across = width * glm::normalize(glm::cross(along, glm::dvec3(0.2, 0.4, 1.0)));
            const float radius = float(width);
            shapes.push_back({LightType::Rectangle, middle, 0.5 * along, 0.0f, across});
            shapes.push_back({LightType::Rectangle, middle, across, 0.0f, 0.5 * along});
            shapes.push_back({LightType::Rectangle, middle, width * along, 0.0f, across});
            shapes.push_back({LightType::Disk, middle, width * along, 0.0f, across});
            shapes.push_back({LightType::Tube, middle, 0.5 * along, radius});
            shapes.push_back({LightType::Tube, middle, width * along, radius});
            shapes.push_back({LightType::Polygon, middle, width * along, 0.0f, across, true, kEll});
        }
    for (const glm::mat3& matrix : kCosineMatrices) {
        const std::vector<double> shares = run(shapes, matrix);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const SeenShape& shape = shapes[i];
            const double truth = shareByQuadrature(shape, matrix);
            // Near 2e-3 of the distance, where lights become lines and points; elsewhere within 2e-5.
            EXPECT_NEAR(shares[i] / truth, 1.0, 4e-4)
                << scenes::infoOf(shape.type).name << ", " << glm::length(shape.first) << " x "
                << std::max(shape.radius, glm::length(shape.second)) << ", lobe " << &matrix - kCosineMatrices.data();
        }
    }
}

/// Lights that extend from near to far at a small angle, where most of their light comes from the near end.
TEST_F(AreaShares, narrowLightsThatRunAwayFromThePointKeepTheirDigits) {
    std::vector<SeenShape> shapes;
    for (const double height : {0.01, 0.03, 0.05})
        for (const double end : {1.0, 3.0, 10.0, 30.0})
            for (const double rise : {0.0, 0.002, 0.02}) {
                const glm::dvec3 from(0.3, 0.0, height), to(end, 0.0, height + rise * (end - 0.3));
                const glm::dvec3 half = 0.5 * (to - from);
                const glm::dvec3 across = 1e-4 * glm::normalize(glm::dvec3(0.2, 1.0, 0.3));
                shapes.push_back({LightType::Rectangle, from + half, half, 0.0f, across});
                shapes.push_back({LightType::Tube, from + half, half, 1e-4f});
            }
    const std::vector<double> shares = run(shapes, kCosineMatrices[0]);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        EXPECT_NEAR(shares[i] / shareByQuadrature(shapes[i], kCosineMatrices[0]), 1.0, 3e-4)
            << scenes::infoOf(shapes[i].type).name << " " << i / 2;
}

/// Strips parallel to the surface at height h, from near the point to the horizon: the integral of h^2 / (x^2 + h^2)^2
/// along x. The sine of the angle they span is below 0.2, where the shader uses series, accurate to 2e-6. For no other
/// lines does that angle weigh more.
TEST_F(AreaShares, aNarrowStripTowardsTheHorizonIsTheIntegralAlongIt) {
    std::vector<SeenShape> shapes;
    for (const double end : {3.0, 30.0, 300.0})
        for (double height = 0.03; height < 0.0615; height += 0.001)
            shapes.push_back({LightType::Rectangle,
                              {0.5 * (end + 0.3), 0.0, height},
                              {0.5 * (end - 0.3), 0.0, 0.0},
                              0.0f,
                              {0.0f, 1e-5f, 0.0f}});
    const std::vector<double> shares = run(shapes, kCosineMatrices[0]);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const glm::dvec3 middle(shapes[i].middle), half(shapes[i].first), across(shapes[i].second);
        const double h = middle.z;
        const auto upTo = [h](double x) { return 0.5 * (x / (x * x + h * h) + std::atan(x / h) / h); };
        const double truth = 2.0 * across.y / std::numbers::pi * (upTo(middle.x + half.x) - upTo(middle.x - half.x));
        EXPECT_NEAR(shares[i] / truth, 1.0, 3e-6) << "at height " << h << ", to " << middle.x + half.x;
    }
}

/// Compared with the rectangle, which is treated as a line below 2e-3 of its distance.
TEST_F(AreaShares, aNarrowPolygonIsRightToItsDistanceOverItsWidth) {
    for (const double width : {2e-5, 2e-4, 2e-3, 2e-2}) {
        std::vector<SeenShape> rectangles, polygons;
        for (int i = 0; i < 7; ++i) {
            const glm::dvec3 middle(-0.4 + 0.13 * i, 0.2 * i - 0.5, 1.0 + 0.1 * i);
            const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 0.3 + 0.2 * i, -0.1));
            const glm::dvec3 across = 0.5 * width * glm::normalize(glm::cross(along, glm::dvec3(0.2, 0.4, 1.0)));
            rectangles.push_back({LightType::Rectangle, middle, 0.5 * along, 0.0f, across});
            polygons.push_back(
                {LightType::Polygon, middle, 0.5 * along, 0.0f, across, true, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}});
        }
        for (const glm::mat3& matrix : kCosineMatrices) {
            const std::vector<double> wanted = run(rectangles, matrix), shares = run(polygons, matrix);
            for (std::size_t i = 0; i < shares.size(); ++i)
                EXPECT_NEAR(shares[i] / wanted[i], 1.0, 1e-6 * double(glm::length(polygons[i].middle)) / width + 1e-4)
                    << "width " << width << ", lobe " << &matrix - kCosineMatrices.data();
        }
    }
}

/// The part of a shape's plane between two positions in units of its vectors, as a rectangle.
SeenShape rectangleWithin(const SeenShape& shape, const glm::dvec2& least, const glm::dvec2& most) {
    SeenShape part = shape;
    const glm::dvec2 middle = 0.5 * (least + most), half = 0.5 * (most - least);
    part.type = LightType::Rectangle;
    part.corners.clear();
    part.middle = glm::dvec3(shape.middle) + middle.x * glm::dvec3(shape.first) + middle.y * glm::dvec3(shape.second);
    part.first = half.x * glm::dvec3(shape.first);
    part.second = half.y * glm::dvec3(shape.second);
    return part;
}

/// A polygon with perpendicular vectors, anywhere around the point and above or across its horizon.
SeenShape randomPolygon(test::Random& random, const std::vector<glm::vec2>& corners) {
    SeenShape shape;
    shape.type = LightType::Polygon;
    const glm::dvec3 normal = random.direction(), right = random.around(normal, 0.0, 0.0);
    shape.first = random.between(0.3, 1.5) * right;
    shape.second = random.between(0.3, 1.5) * glm::cross(normal, right);
    shape.middle = random.direction() * random.between(0.3, 2.0);
    shape.middle.z = std::abs(shape.middle.z);
    shape.corners = corners;
    return shape;
}

/// Polygons above the horizon and across it, from either side, of which the horizon leaves one piece, two or none.
TEST_F(AreaShares, aHollowedPolygonIsTheSumOfItsParts) {
    using Part = std::pair<glm::dvec2, glm::dvec2>;
    const std::pair<std::vector<glm::vec2>, std::vector<Part>> cases[] = {
        {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{{-1, -1}, {1, 1}}}},
        {kEll, {{{-1, -1}, {1, 0}}, {{-1, 0}, {0, 1}}}},
        {kBridge, {{{-1, -1}, {-0.5, 0.5}}, {{0.5, -1}, {1, 0.5}}, {{-1, 0.5}, {1, 1}}}}};
    for (const auto& [corners, parts] : cases) {
        test::Random random(31);
        std::vector<SeenShape> whole, pieces;
        for (int i = 0; i < 2000; ++i) {
            whole.push_back(randomPolygon(random, corners));
            // The result must not depend on the first corner.
            std::vector<glm::vec2>& turned = whole.back().corners;
            std::rotate(turned.begin(), turned.begin() + random.index(int(turned.size())), turned.end());
            for (const auto& [least, most] : parts) pieces.push_back(rectangleWithin(whole.back(), least, most));
        }
        for (const glm::mat3& matrix : kCosineMatrices) {
            const std::vector<double> shares = run(whole, matrix), partShares = run(pieces, matrix);
            for (std::size_t i = 0; i < whole.size(); ++i) {
                double sum = 0.0;
                for (std::size_t part = 0; part < parts.size(); ++part) sum += partShares[i * parts.size() + part];
                // Rectangles viewed edge-on by a lobe are treated as lines (narrowLightsKeepTheirDigits).
                EXPECT_NEAR(shares[i], sum, 1e-5 + 4e-4 * sum)
                    << corners.size() << " corners, light " << i << ", lobe " << &matrix - kCosineMatrices.data();
            }
        }
    }
}

/// Oblique edges, compared with the integral over the surface.
TEST_F(AreaShares, aPolygonAcrossTheHorizonIsTheIntegralOverIt) {
    const std::vector<std::vector<glm::vec2>> outlines{
        {{-0.5f, -0.7f}, {0.9f, -0.1f}, {-0.2f, 0.8f}},
        {{-1, 0}, {0.1f, -0.4f}, {1, 0}, {0.1f, 0.9f}, {0, 0}}, // concave at its last corner
        {{0.2f, 0}, {0.7f, 0.7f}, {0, 0.2f}, {-0.7f, 0.7f}, {-0.2f, 0}, {-0.7f, -0.7f}, {0, -0.2f}, {0.7f, -0.7f}}};
    test::Random random(32);
    std::vector<SeenShape> shapes;
    while (shapes.size() < 60) {
        const SeenShape shape = randomPolygon(random, outlines[shapes.size() % outlines.size()]);
        // Quadrature needs a plane at some distance.
        const glm::vec3 normal = glm::normalize(glm::cross(shape.first, shape.second));
        if (std::abs(glm::dot(shape.middle, normal)) > 0.15f) shapes.push_back(shape);
    }
    for (const glm::mat3& matrix : {kCosineMatrices[0], kCosineMatrices[1]}) {
        const std::vector<double> shares = run(shapes, matrix);
        for (std::size_t i = 0; i < shapes.size(); ++i)
            EXPECT_NEAR(shares[i], shareByQuadrature(shapes[i], matrix), 2e-3)
                << shapes[i].corners.size() << " corners, light " << i;
    }
}

/// A point in the notch is outside. One in a leg beside it is inside, and receives the lune that a whole plane covers.
TEST_F(AreaShares, aPointInThePlaneOfAPolygonGetsLightWithinItsCornersAlone) {
    const glm::dvec3 right(0.5, 0.0, 0.0), up(0.0, 0.3, 0.4), normal = glm::normalize(glm::cross(right, up));
    const double lune = 0.5 * (1.0 - std::abs(normal.z));
    for (const double side : {1.0, -1.0}) // legs up, and down
        for (const auto& [x, isWithin] : {std::pair{-0.75, true}, {0.0, false}, {0.75, true}, {-2.0, false}}) {
            std::vector<SeenShape> shapes;
            const std::vector<double> offs{0.0, 1e-12, 1e-8, 1e-7, 1e-6};
            for (const double off : offs)
                shapes.push_back({LightType::Polygon, -side * (x * right - 0.25 * up) - off * normal, side * right,
                                  0.0f, side * up, true, kBridge});
            const std::vector<double> shares = run(shapes, kCosineMatrices[0]);
            for (std::size_t i = 0; i < shares.size(); ++i)
                EXPECT_NEAR(shares[i], isWithin ? lune : 0.0, 20.0 * offs[i] + 2e-5)
                    << "at " << x << ", side " << side << ", before it by " << offs[i];
        }
}

/// Along lines on which an end becomes visible, and on which the point leaves the cylinder's continuation past an end's
/// edge: there the light used to jump by 1e-3.
TEST_F(AreaShares, ofATubeNothingJumpsWhereItsOutlineChanges) {
    constexpr int kSteps = 20000;
    for (const double size : {1.0, 0.1, 0.02, 0.003})
        for (int line = 0; line < 3; ++line) {
            const glm::dvec3 axis = line == 1 ? glm::normalize(glm::dvec3(0.2, 0.5, 1.0)) : glm::dvec3(0.0, 1.0, 0.0);
            const glm::dvec3 aside = glm::normalize(glm::cross(axis, glm::dvec3(1.0, 0.0, 0.1)));
            std::vector<SeenShape> shapes;
            for (int i = 0; i <= kSteps; ++i) {
                const double x = double(i) / kSteps;
                const glm::dvec3 middle = line == 0   ? glm::dvec3(0.3 * size, -(0.3 + 0.4 * x) * size, 1.0)
                                          : line == 1 ? 1.2 * axis + (0.1 + 0.2 * x) * size * aside
                                                      : size * glm::dvec3(0.05, -0.3 - 0.4 * x, 0.6);
                shapes.push_back({LightType::Tube, middle, 0.5 * size * axis, float(0.2 * size)});
            }
            const std::vector<double> shares = run(shapes, kCosineMatrices[0]);
            for (std::size_t i = 2; i < shares.size(); ++i)
                ASSERT_LT(std::abs(shares[i] - 2.0 * shares[i - 1] + shares[i - 2]), 1e-4 * shares[i])
                    << "size " << size << ", line " << line << ", step " << i;
            for (const std::size_t i : {std::size_t(0), std::size_t(kSteps / 2), std::size_t(kSteps)})
                EXPECT_NEAR(shares[i] / shareByQuadrature(shapes[i], kCosineMatrices[0]), 1.0, 4e-4)
                    << "size " << size << ", line " << line << ", step " << i;
        }
}

/// A plane of light oblique to a surface covers a lune of (1 - cos) / 2, however near in front of it the point is.
TEST_F(AreaShares, aPointInThePlaneOfAFlatLightGetsLightAsOneBeforeIt) {
    const glm::dvec3 right(0.5, 0.0, 0.0), up(0.0, 0.3, 0.4), normal = glm::normalize(glm::cross(right, up));
    const double lune = 0.5 * (1.0 - std::abs(normal.z));
    for (const LightType type : {LightType::Rectangle, LightType::Disk})
        for (const bool isTwoSided : {false, true})
            for (const double place : {0.0, 0.5, 1.0, 1.000001, 1.5, 3.0}) {
                std::vector<SeenShape> shapes;
                const std::vector<double> offs{0.0, 1e-38, 1e-12, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3};
                for (const double off : offs)
                    shapes.push_back({type, -place * right - off * normal, right, 0.0f, up, isTwoSided});
                const std::vector<double> shares = run(shapes, kCosineMatrices[0]);
                for (std::size_t i = 0; i < shares.size(); ++i) {
                    SCOPED_TRACE(testing::Message() << scenes::infoOf(type).name << ", two-sided " << isTwoSided
                                                    << ", at " << place << ", before it by " << offs[i]);
                    if (!isTwoSided && offs[i] == 0.0)
                        EXPECT_EQ(shares[i], 0.0) << "its plane belongs to its back";
                    else if (place < 1.0)
                        EXPECT_NEAR(shares[i], lune, 2.0 * offs[i] + 1e-5);
                    else if (place > 1.1)
                        EXPECT_LE(shares[i], offs[i] + 1e-6);
                    else
                        EXPECT_TRUE(shares[i] >= 0.0 && shares[i] <= lune + 1e-5) << shares[i];
                }
            }
}

struct AreaFault {
    const char* fault;
    const char* file; ///< relative to shaders/
    const char* from;
    const char* to;
};

constexpr AreaFault kAreaFaults[] = {
    {"the horizon cut away above", "lib/light/area_edges.glsl", "aIsAbove = a.z > 0.0, bIsAbove = b.z > 0.0",
     "aIsAbove = a.z < 0.0, bIsAbove = b.z < 0.0"},
    {"an edge left out", "lib/light/area_light.glsl", "edge = 0; edge <= outline.edges",
     "edge = 1; edge <= outline.edges"},
    {"the edge along the horizon left out", "lib/light/area_light.glsl", "closes = comesUp && horizon.isBelow",
     "closes = false"},
    {"the edge that closes an outline left out", "lib/light/area_light.glsl", "horizon.isBelow && horizon.hasEntered",
     "false"},
    {"two-sided lights dark behind", "lib/light/area_outline.glsl", "!shinesFromBothSides(second.w) && !", "!"},
    {"one-sided lights bright behind", "lib/light/area_outline.glsl", "!shinesFromBothSides(second.w) && !",
     "false && !"},
    {"the lobe's matrix transposed", "lib/light/area_light.glsl", "= lobe.cosineFromSurface * (part == 0 ?",
     "= transpose(lobe.cosineFromSurface) * (part == 0 ?"},
    {"the share above the surface left out", "lib/light/area_light.glsl", "(0.5 * kInversePi) * lobe.perAbove",
     "(0.5 * kInversePi)"},
    {"a tube without its far end", "lib/light/area_light.glsl", "share += shareOfPlace(outline.middle - halfLine",
     "share += 0.0 * shareOfPlace(outline.middle - halfLine"},
    {"a tube's side as wide from beside its end", "lib/light/area_outline.glsl", "(sinHalf * sinHalf * sinHalf)",
     "1.0"},
    {"what closes a hollowed outline always along one way", "lib/light/area_edges.glsl", "along < 0.0 ? -1.0 : 1.0",
     "1.0"},
    {"a polygon's corners in twos", "lib/light/light_store.glsl", "(number & 1) == 0 ? two.xy : two.zw", "two.xy"},
    {"a small polygon in its position", "lib/light/area_light.glsl", "outline.middle + outline.toSide;\n        return",
     "outline.middle;\n        return"},
    {"lines not cut at the horizon", "lib/light/area_light.glsl", "part.x = max(part.x, crossing)", "part.x = -1.0"},
};

/// Large and narrow lights, above the horizon and across it. Every fault above changes some of them.
std::vector<SeenShape> faultFindingShapes() {
    const glm::vec3 high(-0.2f, 0.3f, 1.0f), low(0.7f, 0.4f, 0.1f), along(0.2f, -0.1f, 0.4f),
        across(0.3f, 0.25f, -0.1f);
    std::vector<SeenShape> shapes;
    for (const glm::vec3& middle : {high, low})
        for (const bool isTwoSided : {false, true})
            for (const float side : {-1.0f, 1.0f}) {
                shapes.push_back({LightType::Rectangle, middle, along, 0.0f, side * across, isTwoSided});
                shapes.push_back({LightType::Disk, middle, 0.4f * along, 0.0f, side * 0.4f * across, isTwoSided});
                shapes.push_back({LightType::Rectangle, middle, along, 0.0f, side * 1e-3f * across, isTwoSided});
            }
    shapes.push_back({LightType::Rectangle, low, -along, 0.0f, across, true});
    // Its legs rise from below the horizon.
    shapes.push_back({LightType::Polygon, {0.1f, 0.8f, 0.15f}, {0.5f, 0, 0}, 0.0f, {0, 0.1f, -0.4f}, true, kBridge});
    // So small that it is treated as a point, beside its position and low above the horizon.
    shapes.push_back({LightType::Polygon,
                      {0.0f, 1.0f, 0.01f},
                      {0, 0, 1e-3f},
                      0.0f,
                      {1e-3f, 0, 0},
                      true,
                      {{0.5f, -1}, {1, -1}, {1, 1}, {0.5f, 1}}});
    shapes.push_back({LightType::Tube, high, along, 0.1f});
    shapes.push_back({LightType::Tube, glm::vec3(0.0f, 2e-3f, 0.9f), glm::vec3(0.0f, 0.0f, 0.2f), 1e-3f});
    return shapes;
}

/// The largest error, relative to the true fraction or to 1e-9, whichever is larger.
double worstShareError(test::ShaderBench& bench) {
    const std::vector<SeenShape> shapes = faultFindingShapes();
    double worst = 0.0;
    for (const glm::mat3& matrix : {kCosineMatrices[0], kCosineMatrices[1]}) {
        const std::vector<double> shares = sharesSeen(bench, shapes, matrix);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const SeenShape& shape = shapes[i];
            const bool isBehind = shape.type != LightType::Tube && !shape.isTwoSided &&
                                  !(glm::dot(glm::cross(shape.first, shape.second), shape.middle) < 0.0f);
            const double truth = isBehind ? 0.0 : shareByQuadrature(shape, matrix);
            const double error = std::abs(shares[i] - truth) / std::max(truth, 1e-9);
            worst = std::max(worst, error < 1e30 ? error : 1e30); // NaN too
        }
    }
    return worst;
}

TEST_F(AreaShares, everyFaultShowsInALight) {
    test::ShaderBench plain;
    EXPECT_LT(worstShareError(plain), 2e-3);
    for (const AreaFault& fault : kAreaFaults) {
        test::ShaderBench bench([&](const std::filesystem::path& folder) {
            std::ifstream stream(folder / fault.file, std::ios::binary);
            std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
            const std::size_t place = text.find(fault.from);
            ASSERT_NE(place, std::string::npos) << fault.file << " no longer holds " << fault.from;
            text.replace(place, std::string_view(fault.from).size(), fault.to);
            std::ofstream(folder / fault.file, std::ios::binary) << text;
        });
        EXPECT_GT(worstShareError(bench), 0.01) << fault.fault;
    }
}

} // namespace
} // namespace tessera
