// The factor of an area light's picture as a lobe sees it: its place against integrals over the light in double, and
// its width against the Gaussian of docs/area-lights.md.
#include <algorithm>
#include <cmath>
#include <numbers>

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

constexpr int kTexels = 256; ///< of each picture's sides

/// Over pictures whose texels are powers of their place: x and y from 0 at the left and at the top to 1.
class PicturesSeen : public GlTest {
protected:
    enum Picture { Places, Squares };

    PicturesSeen() {
        const auto place = [](int x, int y) { return glm::dvec2(x + 0.5, y + 0.5) / double(kTexels); };
        const std::vector<frame::ShownPicture> shown{
            {lightTexture(kTexels, kTexels, [&](int x, int y) { return glm::dvec3(place(x, y), 1.0); }),
             LightType::Rectangle,
             {}},
            {lightTexture(kTexels, kTexels,
                          [&](int x, int y) {
                              const glm::dvec2 at = place(x, y);
                              return glm::dvec3(at.x * at.x, at.y * at.y, at.x * at.y);
                          }),
             LightType::Rectangle,
             {}}};
        gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_PICTURES, pictures_.texels(shown).texels(graph::Format::Rgba32Float));
    }
    /// Each light with a picture.
    std::vector<glm::dvec3> factors(std::vector<SeenShape> shapes, const glm::mat3& matrix, Picture picture) {
        for (SeenShape& shape : shapes) shape.picture = picture;
        std::vector<glm::dvec3> factors;
        for (const SeenByShader& seen : seenByShader(bench_, shapes, matrix)) factors.push_back(seen.pictureFactor);
        return factors;
    }

private:
    ShaderBench bench_;
    frame::LightPicturesGpu pictures_;
};

/// Before the point, turned about its own middle.
SeenShape straightAhead(double distanceMetres, double halfMetres, double radians = 0.0) {
    SeenShape shape;
    shape.middle = glm::dvec3(0.0, 0.0, distanceMetres);
    shape.first = halfMetres * glm::dvec3(std::cos(radians), std::sin(radians), 0.0);
    shape.second = halfMetres * glm::dvec3(-std::sin(radians), std::cos(radians), 0.0);
    return shape;
}

/// Levels keep the places of a ramp to 2e-3 (LightPictures.aRampStaysTheSameRampInAllLevels), those of their middle
/// better.
TEST_F(PicturesSeen, straightAheadTheirMiddleIsSeen) {
    std::vector<SeenShape> shapes;
    for (double distance = 0.01; distance < 100.0; distance *= 1.3)
        for (const double radians : {0.0, 0.4, 2.0}) shapes.push_back(straightAhead(distance, 0.5, radians));
    for (const glm::dvec3& factor : factors(shapes, kCosineMatrices[0], Places)) {
        EXPECT_NEAR(factor.x, 0.5, 5e-4);
        EXPECT_NEAR(factor.y, 0.5, 5e-4);
    }
}

/// The factor of a ramp is the mean place of the light that a lobe sees. The further away, the nearer to even its light
/// is over a rectangle: then its centre is right to the square of the rectangle over its distance.
TEST_F(PicturesSeen, ofARampTheMeanPlaceIsSeen) {
    for (const double distance : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
        Random random(41);
        std::vector<SeenShape> shapes;
        while (shapes.size() < 300) {
            SeenShape shape;
            const glm::dvec3 normal = random.direction(), right = random.around(normal, 0.0, 0.0);
            shape.first = random.between(0.5, 1.0) * right;
            shape.second = random.between(0.5, 1.0) * glm::cross(normal, right);
            shape.middle = random.direction() * distance;
            shape.middle.z = std::abs(shape.middle.z);
            // The integral needs a plane some way off.
            if (std::abs(glm::dot(glm::dvec3(shape.middle), normal)) > 0.15 * distance) shapes.push_back(shape);
        }
        for (std::size_t lobe = 0; lobe < kCosineMatrices.size(); ++lobe) {
            const glm::mat3& matrix = kCosineMatrices[lobe];
            const std::vector<glm::dvec3> found = factors(shapes, matrix, Places);
            std::vector<double> errors;
            for (std::size_t i = 0; i < shapes.size(); ++i) {
                const double all = shareByQuadrature(shapes[i], matrix);
                if (!(all > 1e-5)) continue;
                const double x = shareByQuadrature(shapes[i], matrix, [](double right, double) { return right; }),
                             y = shareByQuadrature(shapes[i], matrix, [](double, double up) { return up; });
                const glm::dvec2 wanted(0.5 + 0.5 * x / all, 0.5 - 0.5 * y / all);
                const glm::dvec2 error = glm::abs(glm::dvec2(found[i]) - wanted);
                errors.push_back(std::max(error.x, error.y));
            }
            std::ranges::sort(errors);
            const double median = errors[errors.size() / 2];
            fmt::print("{} m, lobe {}: {} lights, median {:.5f}, most {:.3f}\n", distance, lobe, errors.size(), median,
                       errors.back());
            // The third lobe is so narrow that lights of a twentieth of their distance are large to it.
            const double far = lobe == 2 ? 0.01 : 0.04 / (distance * distance);
            EXPECT_LT(median, distance < 5.0 ? 0.045 : far);
            EXPECT_LT(errors.back(), 0.17); // of what the horizon cuts
        }
    }
}

/// The variances of what is seen: 0.75 of the distance squared along the faster turn; along the slower the level's own
/// and that of five places, of which each fifth weighs as a Gaussian of 0.75 strides. Levels add the width of their
/// texels.
TEST_F(PicturesSeen, straightAheadTheyAreAsWideAsTheirGaussian) {
    constexpr double kLevel = 8.0 / kTexels; // of a level itself, so that none is mixed of two
    double moment = 0.0, weights = 0.0;
    for (int place = -2; place <= 2; ++place) {
        const double away = 0.75 * place, weight = std::exp(-0.5 * away * away);
        moment += weight * away * away;
        weights += weight;
    }
    for (const double stretch : {1.0, 1.5, 2.0, 3.0, 6.0})
        for (const double radians : {0.0, 0.3, 1.2, 2.5}) {
            SCOPED_TRACE(testing::Message() << "stretched " << stretch << " times, turned by " << radians);
            // Six times is three times of a level twice as wide.
            const double wide = kLevel * stretch, level = std::max(kLevel, wide / 3.0);
            const glm::mat3 matrix(glm::vec3(1, 0, 0), glm::vec3(0, float(stretch), 0), glm::vec3(0, 0, 1));
            const SeenShape shape = straightAhead(wide / 0.75, 0.5, radians); // its sides are 1 m
            const glm::dvec3 places = factors({shape}, matrix, Places)[0],
                             squares = factors({shape}, matrix, Squares)[0];
            const glm::dvec3 found(squares.x - places.x * places.x, squares.y - places.y * places.y,
                                   squares.z - places.x * places.y);
            const double slow = level * level + moment / weights * (wide * wide - level * level), fast = level * level;
            const double c = std::cos(radians), s = std::sin(radians);
            const glm::dvec3 wanted(c * c * slow + s * s * fast, s * s * slow + c * c * fast, s * c * (slow - fast));
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / fast, wanted[i] / fast, 0.04) << i;
        }
}

} // namespace
} // namespace tessera
