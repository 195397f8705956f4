// The share of a lobe that an area light fills, of lights of any width and from the places where outlines change,
// against integrals over their surfaces in double.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "scenes/Scene.h"
#include "shaders/shared/light.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using scenes::LightType;
constexpr double kHalfTurn = 3.14159265358979323846;

/// As LightShapeTexels; metres, and from the point. What rounding to floats leaves of it is the light itself.
struct SeenShape {
    LightType type = LightType::Rectangle;
    glm::vec3 middle{0.0f};
    glm::vec3 first{0.0f}; ///< half of a rectangle's side or a tube's length, a disk's radius
    float radius = 0.0f;   ///< of a tube
    glm::vec3 second{0.0f};
    bool isTwoSided = true;
    std::vector<glm::vec2> corners{}; ///< of a polygon, counterclockwise: in parts of `first` and `second`
};

/// Of corners: twice the area within them, in their own measure.
double twiceAreaOf(const std::vector<glm::vec2>& corners) {
    double twice = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        twice += a.x * b.y - a.y * b.x;
    }
    return twice;
}

/// As LightCornerTexels, and the share of the product of both vectors that is within the corners.
struct PackedOutline {
    std::array<glm::vec4, LIGHT_CORNER_TEXELS> texels{}; // without its triangles, which shadows alone need
    float areaShare = 0.0f;
};

PackedOutline packedOutline(const std::vector<glm::vec2>& corners) {
    PackedOutline packed;
    if (corners.empty()) return packed;
    const double twice = twiceAreaOf(corners);
    glm::dvec2 middle(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        middle += (a.x * b.y - a.y * b.x) * (a + b) / (3.0 * twice);
        glm::vec4& two = packed.texels[1 + i / 2];
        (i % 2 == 0 ? two.x : two.z) = corners[i].x;
        (i % 2 == 0 ? two.y : two.w) = corners[i].y;
    }
    packed.texels[0] = glm::vec4(glm::vec2(middle), float(corners.size()), 0.0f);
    packed.areaShare = float(0.5 * twice);
    return packed;
}

/// Hollowed outlines: a square without one of its quarters, and one with a notch from below.
const std::vector<glm::vec2> kEll{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
const std::vector<glm::vec2> kBridge{{-1, -1},   {-0.5f, -1}, {-0.5f, 0.5f}, {0.5f, 0.5f},
                                     {0.5f, -1}, {1, -1},     {1, 1},        {-1, 1}};

/// To a clamped cosine: a matte surface, and lobes that lean and are narrow.
const std::array<glm::mat3, 3> kCosineMatrices{
    glm::mat3(1.0f), glm::mat3(glm::vec3(0.3f, 0.0f, 0.1f), glm::vec3(0, 1, 0), glm::vec3(-0.4f, 0.0f, 0.35f)),
    glm::mat3(glm::vec3(0.02f, 0.0f, 0.001f), glm::vec3(0.0f, 0.05f, 0.0f), glm::vec3(0.03f, 0.0f, 1.0f))};

/// What a flat piece facing the point adds: by the square metres it shows to the point times its distance.
class LobeDensity {
public:
    explicit LobeDensity(const glm::mat3& matrix) : matrix_(matrix) {
        const glm::dvec3 horizon = glm::cross(matrix_[0], matrix_[1]);
        scale_ = std::abs(glm::determinant(matrix_)) / kHalfTurn / (0.5 + 0.5 * horizon.z / glm::length(horizon));
    }
    double at(const glm::dvec3& place) const {
        const glm::dvec3 seen = matrix_ * place;
        if (!(place.z > 0.0 && seen.z > 0.0)) return 0.0;
        return scale_ * seen.z / (glm::dot(seen, seen) * glm::dot(seen, seen));
    }

private:
    glm::dmat3 matrix_;
    double scale_;
};

/// Over a square of -1..1 both ways, by `columns` x `rows` pieces of Gauss's four points a side.
template <typename Value>
double overSquare(int columns, int rows, const Value& value) {
    constexpr double kPlaces[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
    constexpr double kWeights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
    double sum = 0.0;
    for (int i = 0; i < columns * 4; ++i)
        for (int j = 0; j < rows * 4; ++j)
            sum += kWeights[i % 4] * kWeights[j % 4] *
                   value((2 * (i / 4) + 1 + kPlaces[i % 4]) / columns - 1.0,
                         (2 * (j / 4) + 1 + kPlaces[j % 4]) / rows - 1.0);
    return sum / (columns * rows);
}

/// All of the light above the horizon of surface and cosine, or next to nothing of it below.
double shareByQuadrature(const SeenShape& shape, const glm::mat3& matrix) {
    const LobeDensity density(matrix);
    const glm::dvec3 middle(shape.middle), first(shape.first), second(shape.second);
    if (shape.type == LightType::Polygon) { // triangles from the first corner, those that turn back taken away
        double share = 0.0;
        for (std::size_t i = 2; i < shape.corners.size(); ++i) {
            const glm::dvec2 a = shape.corners[i - 1] - shape.corners[0], b = shape.corners[i] - shape.corners[0];
            const glm::dvec3 corner = middle + double(shape.corners[0].x) * first + double(shape.corners[0].y) * second;
            const glm::dvec3 toA = a.x * first + a.y * second, toB = b.x * first + b.y * second;
            share += 0.25 * (a.x * b.y - a.y * b.x) * overSquare(50, 50, [&](double x, double y) {
                         const double along = 0.5 + 0.5 * x;
                         return along * density.at(corner + along * glm::mix(toA, toB, 0.5 + 0.5 * y));
                     });
        }
        return std::abs(glm::dot(middle, glm::cross(first, second))) * share;
    }
    if (shape.type == LightType::Rectangle)
        return std::abs(glm::dot(middle, glm::cross(first, second))) *
               overSquare(100, 10, [&](double x, double y) { return density.at(middle + x * first + y * second); });
    const auto disk = [&](const glm::dvec3& at, const glm::dvec3& right, const glm::dvec3& up, double facing) {
        return facing * overSquare(10, 20, [&](double x, double y) {
                   const double along = 0.5 + 0.5 * x, angle = kHalfTurn * y;
                   return 0.5 * kHalfTurn * along *
                          density.at(at + along * (std::cos(angle) * right + std::sin(angle) * up));
               });
    };
    if (shape.type == LightType::Disk)
        return disk(middle, first, second, std::abs(glm::dot(middle, glm::cross(first, second))));
    const double radius = double(shape.radius), half = glm::length(first);
    const glm::dvec3 axis = first / half;
    const double along = -glm::dot(middle, axis);
    const glm::dvec3 outwards = -middle - along * axis;
    const double away = glm::length(outwards);
    const glm::dvec3 right = outwards / away, up = glm::cross(axis, right);
    double share = 0.0;
    if (away > radius) {
        const double seenHalf = std::acos(radius / away);
        share += overSquare(100, 10, [&](double x, double y) {
            const glm::dvec3 normal = std::cos(seenHalf * y) * right + std::sin(seenHalf * y) * up;
            const glm::dvec3 place = middle + x * first + radius * normal;
            return half * seenHalf * radius * std::max(-glm::dot(place, normal), 0.0) * density.at(place);
        });
    }
    const double beyond = std::abs(along) - half;
    if (beyond > 0.0)
        share += disk(middle + (along > 0.0 ? first : -first), radius * right, radius * up, radius * radius * beyond);
    return share;
}

std::vector<double> sharesSeen(test::ShaderBench& bench, const std::vector<SeenShape>& shapes,
                               const glm::mat3& matrix) {
    std::vector<glm::vec4> inputs;
    for (const SeenShape& shape : shapes) {
        const PackedOutline outline = packedOutline(shape.corners);
        const float radius = shape.type == LightType::Polygon ? outline.areaShare : shape.radius;
        inputs.insert(inputs.end(), {{shape.middle, float(int(shape.type))},
                                     {shape.first, radius},
                                     {shape.second, shape.isTwoSided ? 1.0f : 0.0f}});
        inputs.insert(inputs.end(), outline.texels.begin(), outline.texels.end());
        inputs.insert(inputs.end(), {{matrix[0], 0.0f}, {matrix[1], 0.0f}, {matrix[2], 0.0f}});
    }
    shader::Defines defines = frame::featureDefines(frame::allFeatures());
    defines.emplace_back("ENVIRONMENT_COMPENSATION", "0");
    std::vector<double> shares;
    for (const glm::vec4& out : bench.run("test/area_shares.comp", defines, inputs, shapes.size(), 1))
        shares.push_back(double(out.x));
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

/// Corners rounded to 1e-7 of the distance made strips of 1e-6 wrong by 4 %.
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
            // Where lines and places begin, at 2e-3; elsewhere within 2e-5.
            EXPECT_NEAR(shares[i] / truth, 1.0, 4e-4)
                << scenes::infoOf(shape.type).name << ", " << glm::length(shape.first) << " x "
                << std::max(shape.radius, glm::length(shape.second)) << ", lobe " << &matrix - kCosineMatrices.data();
        }
    }
}

/// Beside the rectangle, which is a line from 2e-3 on.
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

/// The part of a shape's plane between two places, in parts of its vectors.
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

/// Of a pair of sides at right angles, anywhere about the point and above or across its horizon.
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

/// Above the horizon and across it, seen from either side, where the horizon leaves one piece, two or none.
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
            // However the corners are numbered.
            std::vector<glm::vec2>& turned = whole.back().corners;
            std::rotate(turned.begin(), turned.begin() + random.index(int(turned.size())), turned.end());
            for (const auto& [least, most] : parts) pieces.push_back(rectangleWithin(whole.back(), least, most));
        }
        for (const glm::mat3& matrix : kCosineMatrices) {
            const std::vector<double> shares = run(whole, matrix), partShares = run(pieces, matrix);
            for (std::size_t i = 0; i < whole.size(); ++i) {
                double sum = 0.0;
                for (std::size_t part = 0; part < parts.size(); ++part) sum += partShares[i * parts.size() + part];
                // Rectangles that a lobe sees from their edge are lines (narrowLightsKeepTheirDigits).
                EXPECT_NEAR(shares[i], sum, 1e-5 + 4e-4 * sum)
                    << corners.size() << " corners, light " << i << ", lobe " << &matrix - kCosineMatrices.data();
            }
        }
    }
}

/// Edges that are neither along nor across, against the integral over the surface.
TEST_F(AreaShares, aPolygonAcrossTheHorizonIsTheIntegralOverIt) {
    const std::vector<std::vector<glm::vec2>> outlines{
        {{-0.5f, -0.7f}, {0.9f, -0.1f}, {-0.2f, 0.8f}},
        {{-1, 0}, {0.1f, -0.4f}, {1, 0}, {0.1f, 0.9f}, {0, 0}}, // points inwards at its last corner
        {{0.2f, 0}, {0.7f, 0.7f}, {0, 0.2f}, {-0.7f, 0.7f}, {-0.2f, 0}, {-0.7f, -0.7f}, {0, -0.2f}, {0.7f, -0.7f}}};
    test::Random random(32);
    std::vector<SeenShape> shapes;
    while (shapes.size() < 60) {
        const SeenShape shape = randomPolygon(random, outlines[shapes.size() % outlines.size()]);
        // Quadrature needs a plane some way off.
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

/// A point in a notch is not within, one in a leg beside it is, and gets the lune that a whole plane fills.
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

/// Along lines on which a point comes to see an end, and comes out of the cylinder's continuation, by an end's edge:
/// there the light used to step by 1e-3.
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

/// A plane of light that stands slantwise on a surface fills a lune of (1 - cos) / 2, from however near before it.
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
    const char* file; ///< below shaders/
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

/// Large and narrow lights, above the horizon and across it, of which every fault above changes some.
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
    // Its legs stand up from below the horizon.
    shapes.push_back({LightType::Polygon, {0.1f, 0.8f, 0.15f}, {0.5f, 0, 0}, 0.0f, {0, 0.1f, -0.4f}, true, kBridge});
    // So small that it counts as a place, beside its position and low over the horizon.
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

/// Absolute, or in parts of all of a light.
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
