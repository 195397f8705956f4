// The image factor of an area light for a lobe: its lookup position against integrals over the light in double, and its
// filter width against the Gaussian of docs/area-lights.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/frame/LightPictures.h"
#include "shaders/shared/slots.h"
#include "tests/gpu/shaders/SeenShapes.h"
#include "tests/support/LightPictures.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using scenes::LightType;
using namespace test;

constexpr int kTexels = 256; ///< of each image's sides

/// At most as far from its centre as a disk's edge.
const std::vector<glm::vec2> kTriangle{{-0.9f, -0.4f}, {0.8f, -0.6f}, {-0.3f, 0.9f}};

/// A light texture with the value factor(x, y), x and y from 0 at the left and at the top to 1.
template <typename Factor>
scenes::LightTexture textureOf(int texels, const Factor& factor) {
    return lightTexture(texels, texels, [&](int x, int y) { return factor((x + 0.5) / texels, (y + 0.5) / texels); });
}

class PicturesSeen : public GlTest {
protected:
    enum Picture { Rectangles, Disks, Triangles, RectangleSquares, DiskSquares, OneTexel };
    static constexpr int kOddTexels = 255; ///< side of OneTexel, whose centre texel is 1

    PicturesSeen() {
        const scenes::LightTexture places =
            textureOf(kTexels, [](double x, double y) { return glm::dvec3(x, y, 1.0); });
        const scenes::LightTexture squares =
            textureOf(kTexels, [](double x, double y) { return glm::dvec3(x * x, y * y, x * y); });
        const scenes::LightTexture one = lightTexture(
            kOddTexels, kOddTexels, [](int x, int y) { return 2 * x + 1 == kOddTexels && x == y ? 1.0f : 0.0f; });
        scenes::LightCorners triangle;
        triangle.count = 0;
        for (const glm::vec2& corner : kTriangle) triangle.add(corner);
        const std::vector<frame::ShownPicture> shown{
            {places, LightType::Rectangle, {}},  {places, LightType::Disk, {}},  {places, LightType::Polygon, triangle},
            {squares, LightType::Rectangle, {}}, {squares, LightType::Disk, {}}, {one, LightType::Rectangle, {}}};
        gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_PICTURES, pictures_.texels(shown).texels(graph::Format::Rgba32Float));
    }
    /// The factor of each light with an image.
    std::vector<glm::dvec3> factors(std::vector<SeenShape> shapes, const glm::mat3& matrix, Picture picture) {
        for (SeenShape& shape : shapes) shape.picture = picture;
        std::vector<glm::dvec3> factors;
        for (const SeenByShader& seen : seenByShader(bench_, shapes, matrix)) factors.push_back(seen.pictureFactor);
        return factors;
    }
    /// Variances of x and y, and their covariance, of the filter on a light's image, in units of the image's sides.
    glm::dvec3 spreadOf(const SeenShape& shape, const glm::mat3& matrix, Picture places, Picture squares) {
        const glm::dvec3 mean = factors({shape}, matrix, places)[0];
        return factors({shape}, matrix, squares)[0] - glm::dvec3(mean.x * mean.x, mean.y * mean.y, mean.x * mean.y);
    }

private:
    ShaderBench bench_;
    frame::LightPicturesGpu pictures_;
};

/// A light straight ahead of the point, rotated about its centre.
SeenShape straightAhead(double distanceMetres, double halfMetres, double radians = 0.0) {
    SeenShape shape;
    shape.middle = glm::dvec3(0.0, 0.0, distanceMetres);
    shape.first = halfMetres * glm::dvec3(std::cos(radians), std::sin(radians), 0.0);
    shape.second = halfMetres * glm::dvec3(-std::sin(radians), std::cos(radians), 0.0);
    return shape;
}

/// Levels keep the positions of a ramp to 2e-3 (LightPictures.aRampStaysTheSameRampInAllLevels), those near the centre
/// better.
TEST_F(PicturesSeen, straightAheadTheirMiddleIsSeen) {
    std::vector<SeenShape> shapes;
    for (double distance = 0.01; distance < 100.0; distance *= 1.3)
        for (const double radians : {0.0, 0.4, 2.0}) shapes.push_back(straightAhead(distance, 0.5, radians));
    for (const glm::dvec3& factor : factors(shapes, kCosineMatrices[0], Rectangles)) {
        EXPECT_NEAR(factor.x, 0.5, 5e-4);
        EXPECT_NEAR(factor.y, 0.5, 5e-4);
    }
}

/// Random lights, except within 0.15 of the distance from their plane, where the integral is too coarse.
std::vector<SeenShape> shapesAnywhere(LightType type, double distanceMetres) {
    Random random(41);
    std::vector<SeenShape> shapes;
    while (shapes.size() < 200) {
        SeenShape shape;
        shape.type = type;
        if (type == LightType::Polygon) shape.corners = kTriangle;
        const glm::dvec3 normal = random.direction(), right = random.around(normal, 0.0, 0.0);
        shape.first = random.between(0.5, 1.0) * right;
        shape.second = random.between(0.5, 1.0) * glm::cross(normal, right);
        shape.middle = random.direction() * distanceMetres;
        shape.middle.z = std::abs(shape.middle.z);
        if (std::abs(glm::dot(glm::dvec3(shape.middle), normal)) > 0.15 * distanceMetres) shapes.push_back(shape);
    }
    return shapes;
}

/// The factor of a ramp is the lookup position, which should be the mean position of the light that a lobe receives.
/// Far away its error is the square of the light's size over its distance.
TEST_F(PicturesSeen, ofARampNearlyTheMeanPlaceIsSeen) {
    const std::pair<LightType, Picture> all[] = {
        {LightType::Rectangle, Rectangles}, {LightType::Disk, Disks}, {LightType::Polygon, Triangles}};
    for (const auto& [type, picture] : all)
        for (const double distance : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
            const std::vector<SeenShape> shapes = shapesAnywhere(type, distance);
            for (std::size_t lobe = 0; lobe < kCosineMatrices.size(); ++lobe) {
                const glm::mat3& matrix = kCosineMatrices[lobe];
                const std::vector<glm::dvec3> found = factors(shapes, matrix, picture);
                std::vector<double> errors;
                for (std::size_t i = 0; i < shapes.size(); ++i) {
                    const double whole = shareByQuadrature(shapes[i], matrix);
                    if (!(whole > 1e-5)) continue;
                    const double x = shareByQuadrature(shapes[i], matrix, [](double right, double) { return right; }),
                                 y = shareByQuadrature(shapes[i], matrix, [](double, double up) { return up; });
                    const glm::dvec2 wanted(0.5 + 0.5 * x / whole, 0.5 - 0.5 * y / whole);
                    const glm::dvec2 error = glm::abs(glm::dvec2(found[i]) - wanted);
                    ASSERT_TRUE(std::isfinite(error.x + error.y));
                    errors.push_back(std::max(error.x, error.y));
                }
                ASSERT_GT(errors.size(), 50u);
                std::ranges::sort(errors);
                const double median = errors[errors.size() / 2], most = errors.back();
                fmt::print("{}, {} m, lobe {}: {} lights, median {:.5f}, most {:.3f}\n", scenes::infoOf(type).name,
                           distance, lobe, errors.size(), median, most);
                const bool isPolygon = type == LightType::Polygon, isNarrow = lobe == 2;
                double far = std::max(0.04 / (distance * distance), 2.5e-4); // levels keep positions nearly as well
                if (isPolygon) far = 0.06 / distance;                        // filtered by columns and rows separately
                if (isNarrow) far = isPolygon ? 0.02 : 0.01; // to it, a twentieth of the distance is large
                EXPECT_LT(median, distance < 5.0 ? 0.065 : far);
                EXPECT_LT(most, distance > 10.0 && lobe == 0 ? 0.035 : 0.22); // for lights cut by the horizon
            }
        }
}

/// Variance of five samples along the slower axis, each weighted by a Gaussian of 0.75 strides, in units of the squared
/// width that the level lacks.
double varianceOfStretch() {
    double moment = 0.0, weights = 0.0;
    for (int place = -2; place <= 2; ++place) {
        const double away = 0.75 * place, weight = std::exp(-0.5 * away * away);
        moment += weight * away * away;
        weights += weight;
    }
    return moment / weights;
}

/// Variance of the documented Gaussian: (0.75 distance)^2 along the axis where directions turn faster; along the
/// slower, up to three times as far, also that of its five samples. Levels add their texels' width, up to 4 % here.
TEST_F(PicturesSeen, straightAheadTheyAreAsWideAsTheirGaussian) {
    constexpr double kLevel = 8.0 / kTexels; // the width of a level, so that no two levels are mixed
    for (const double stretch : {1.0, 1.5, 2.0, 3.0, 6.0})
        for (const double radians : {0.0, 0.3, 1.2, 2.5}) {
            SCOPED_TRACE(testing::Message() << "stretched " << stretch << " times, turned by " << radians);
            // Six times is three times a level of twice the width.
            const double wide = kLevel * stretch, level = std::max(kLevel, wide / 3.0);
            const glm::mat3 matrix(glm::vec3(1, 0, 0), glm::vec3(0, float(stretch), 0), glm::vec3(0, 0, 1));
            const SeenShape shape = straightAhead(wide / 0.75, 0.5, radians); // its sides are 1 m
            const glm::dvec3 found = spreadOf(shape, matrix, Rectangles, RectangleSquares);
            const double fast = level * level, slow = fast + varianceOfStretch() * (wide * wide - fast);
            const double c = std::cos(radians), s = std::sin(radians);
            const glm::dvec3 wanted(c * c * slow + s * s * fast, s * s * slow + c * c * fast, s * c * (slow - fast));
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / fast, wanted[i] / fast, 0.04) << i;
        }
}

/// Tilted disks, at the position that their mean direction meets. A level's excess width over its Gaussian is equal
/// along both axes, so the difference between the axes is compared.
TEST_F(PicturesSeen, aslantTheyAreLongerWhereDirectionsTurnSlower) {
    const std::array<glm::mat3, 3> matrices{
        kCosineMatrices[0], kCosineMatrices[1],
        glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0.3f, 2.0f, 0), glm::vec3(0, 0, 1))};
    double longest = 1.0;
    for (const glm::mat3& matrix : matrices)
        for (const double lean : {0.0, 0.6, 1.0})
            for (const double radians : {0.0, 0.5, 1.3, 2.4}) {
                SCOPED_TRACE(testing::Message() << "lobe " << &matrix - matrices.data() << ", leaning by " << lean
                                                << ", turned by " << radians);
                const glm::dvec3 across(1.0, 0.0, 0.0), up(0.0, std::cos(lean), std::sin(lean));
                const double c = std::cos(radians), s = std::sin(radians);
                SeenShape shape;
                shape.type = LightType::Disk;
                shape.middle = glm::dvec3(0.0, 0.0, 0.06);
                shape.first = 0.5 * (c * across + s * up);
                shape.second = 0.5 * (c * up - s * across);
                const glm::dmat3 toCosine(matrix);
                const glm::dvec3 middle = toCosine * glm::dvec3(shape.middle),
                                 first = toCosine * glm::dvec3(shape.first),
                                 second = toCosine * glm::dvec3(shape.second);
                // 1 / z turns the lobe's weight of z / distance^4 into 1 / distance^4.
                const auto perHeight = [&](double x, double y) { return 1.0 / (middle + x * first + y * second).z; };
                const double whole = shareByQuadrature(shape, matrix, perHeight);
                const double x = shareByQuadrature(
                                 shape, matrix,
                                 [&](double right, double top) { return right * perHeight(right, top); }),
                             y = shareByQuadrature(
                                 shape, matrix, [&](double right, double top) { return top * perHeight(right, top); });
                const glm::dvec3 met = middle + (x * first + y * second) / whole, ahead = glm::normalize(met);
                const auto turn = [&](const glm::dvec3& a, const glm::dvec3& b) {
                    return (glm::dot(a, b) - glm::dot(a, ahead) * glm::dot(b, ahead)) / glm::dot(met, met);
                };
                const double a = turn(first, first), b = turn(second, second), both = turn(first, second);
                const double apart = std::hypot(0.5 * (a - b), both), mean = 0.5 * (a + b);
                const double fast = 0.375 * 0.375 / (mean + apart), slow = 0.375 * 0.375 / (mean - apart);
                longest = std::max(longest, slow / fast);
                // The axes of turning are those of the filter; y of an image runs downwards.
                const double odd = varianceOfStretch() * (slow - std::max(fast, slow / 9.0));
                const glm::dvec2 wanted =
                    apart > 0.0 ? odd / apart * glm::dvec2(0.5 * (b - a), 0.5 * both) : glm::dvec2(0.0);
                const glm::dvec3 spread = spreadOf(shape, matrix, Disks, DiskSquares);
                const glm::dvec2 found(spread.x - spread.y, spread.z);
                // Texels of levels, and the disk's edge, change each by up to 0.055.
                EXPECT_NEAR(found.x / fast, wanted.x / fast, 0.07);
                EXPECT_NEAR(found.y / fast, wanted.y / fast, 0.07);
            }
    EXPECT_GT(longest, 3.0);
}

/// Below a texel, the image itself and its first level are mixed by the filter's width in texels.
TEST_F(PicturesSeen, narrowerThanATexelTheyComeFromBoth) {
    double sum = 0.0;
    for (int texel = -3; texel <= 3; ++texel) sum += std::exp(-0.5 * texel * texel);
    const double filtered = 1.0 / (sum * sum); // of the centre texel
    for (const double texels : {0.25, 0.5, 0.75}) {
        const SeenShape shape = straightAhead(texels / kOddTexels / 0.75, 0.5);
        const double found = factors({shape}, kCosineMatrices[0], OneTexel)[0].x;
        EXPECT_NEAR(found, 1.0 + texels * (filtered - 1.0), 2e-3) << texels;
    }
}

/// From a level narrower than the image to the last one, which is as wide.
TEST_F(PicturesSeen, goingAwayNothingJumps) {
    constexpr int kSteps = 400;
    std::vector<SeenShape> shapes;
    for (int i = 0; i <= kSteps; ++i) shapes.push_back(straightAhead(0.1 * std::pow(20.0, double(i) / kSteps), 0.5));
    const std::vector<glm::dvec3> squares = factors(shapes, kCosineMatrices[0], RectangleSquares);
    const double all = squares.back().x - squares.front().x;
    EXPECT_GT(all, 0.03);
    for (std::size_t i = 1; i < squares.size(); ++i) ASSERT_NEAR(squares[i].x, squares[i - 1].x, 0.02 * all) << i;
}

/// Most light of a tilted plane comes from within some metres; lights are up to 1e12 times as wide.
TEST_F(PicturesSeen, ofVastLightsWhatIsNearestIsSeen) {
    std::vector<SeenShape> shapes;
    for (const double half : {1e4, 1e6, 1e12})
        for (const double lean : {0.0, 0.3, 1.0})
            for (const double radians : {0.0, 0.7}) {
                SeenShape shape = straightAhead(1.0, half, radians);
                for (glm::vec3* side : {&shape.first, &shape.second})
                    *side = glm::dvec3(side->x, double(side->y) * std::cos(lean), double(side->y) * std::sin(lean));
                shapes.push_back(shape);
            }
    for (const glm::dvec3& factor : factors(shapes, kCosineMatrices[0], Rectangles)) {
        EXPECT_NEAR(factor.x, 0.5, 2e-3);
        EXPECT_NEAR(factor.y, 0.5, 2e-3);
    }
}

/// With a corner, an edge or an inner point at the shading point: by 1 / distance^4 nearly all light comes from there.
TEST_F(PicturesSeen, whereALightTouchesThePointItIsSeenThere) {
    const glm::vec3 right(0.5f, 0.0f, 0.25f), up(0.0f, 0.5f, 0.375f); // few bits, so that the point is in the plane
    const std::pair<float, float> touching[] = {
        {-1.0f, -1.0f}, {-1.0f, 1.0f}, {0.0f, 1.0f}, {1.0f, 0.25f}, {0.0f, 0.0f}};
    std::vector<SeenShape> shapes;
    for (const auto& [x, y] : touching) shapes.push_back({LightType::Rectangle, -x * right - y * up, right, 0.0f, up});
    const std::vector<glm::dvec3> found = factors(shapes, kCosineMatrices[0], Rectangles);
    for (std::size_t i = 0; i < found.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "at " << touching[i].first << ", " << touching[i].second);
        EXPECT_NEAR(found[i].x, 0.5 + 0.5 * double(touching[i].first), 1.0 / kTexels);
        EXPECT_NEAR(found[i].y, 0.5 - 0.5 * double(touching[i].second), 1.0 / kTexels);
    }
}

} // namespace
} // namespace tessera
