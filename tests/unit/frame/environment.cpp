#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/frame/EnvironmentFilter.h"
#include "renderer/frame/EnvironmentIrradiance.h"
#include "renderer/frame/EnvironmentMap.h"
#include "shaders/shared/environment.h"
#include "tests/unit/frame/GreyMap.h"

namespace tessera::frame {
namespace {

using std::numbers::pi;
using test::greyMap;

/// Mean radiance of a channel over all directions.
double meanOf(const DividedOctahedron& level, int channel = 0) {
    double sum = 0.0, weights = 0.0;
    const auto cells = [&](int at) {
        return at == 0 || at == level.side ? 0.5 : 1.0;
    }; // fraction of the cells around a corner, per axis
    for (int y = 0; y <= level.side; ++y)
        for (int x = 0; x <= level.side; ++x) {
            // The solid angle of a face's element falls with the cube of its distance.
            const glm::dvec3 direction = directionOf(DividedOctahedron::codeOfCorner(x, y, level.side));
            const double inverse = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
            const double weight = cells(x) * cells(y) * 4.0 / (level.side * level.side) * std::pow(inverse, 3.0);
            sum += weight * double(level.at(x, y)[channel]);
            weights += weight;
        }
    EXPECT_NEAR(weights, 4.0 * pi, 0.01 * 4.0 * pi);
    return sum / weights;
}

TEST(EnvironmentFilter, directionsComeBackFromTheSquareAndEdgesMeet) {
    for (int i = 0; i < 200; ++i) {
        const double up = 1.0 - (i + 0.5) / 100.0, turn = 2.4 * i, level = std::sqrt(1.0 - up * up);
        const glm::dvec3 direction(level * std::cos(turn), up, level * std::sin(turn));
        // Codes are computed in single precision, with a few roundings of 6e-8.
        EXPECT_LT(glm::distance(directionOf(codeOf(glm::vec3(direction))), direction), 1e-6);
    }
    const glm::dvec3 low = directionOf({0.998, 0.005}), behind = directionOf({-0.998, -0.005});
    EXPECT_TRUE(low.x > 0.0 && low.y > 0.0 && low.z < 0.0 && behind.x < 0.0 && behind.y < 0.0 && behind.z < 0.0);
    // Corners on the square's edges that map to one direction hold one value.
    const FilteredEnvironment filtered = filterEnvironment(greyMap(64, 32, [](int x, int y) { return x + 100.0 * y; }));
    for (const DividedOctahedron* level : {&filtered.levels.front(), &filtered.levels.back(), &filtered.irradiance}) {
        const int last = level->side;
        for (int i = 0; i <= last; ++i) {
            EXPECT_EQ(level->at(0, i), level->at(0, last - i)) << i;
            EXPECT_EQ(level->at(last, i), level->at(last, last - i)) << i;
            EXPECT_EQ(level->at(i, 0), level->at(last - i, 0)) << i;
            EXPECT_EQ(level->at(i, last), level->at(last - i, last)) << i;
        }
    }
}

TEST(LatitudeMap, aCoarserOneHoldsTheLightOfEachTexelAtItsPlace) {
    struct Case {
        int width, height, mostWidth, mostHeight;
    };
    for (const Case& one : {Case{33, 17, 16, 8}, {7, 5, 3, 3}, {5, 101, 64, 50}, {1, 99, 1, 32}, {99, 1, 98, 1}})
        for (int i = 0; i < one.width * one.height; ++i) {
            const int column = i % one.width, row = i / one.width;
            SCOPED_TRACE(testing::Message() << one.width << " x " << one.height << ", texel " << column << ", " << row);
            const scenes::Image bright =
                greyMap(one.width, one.height, [&](int x, int y) { return x == column && y == row ? 1e5 : 0.0; });
            const LatitudeMap fine = latitudeMapOf(bright), coarse = coarserMap(bright, one.mostWidth, one.mostHeight);
            ASSERT_EQ(coarse.width, std::min(one.width, one.mostWidth));
            ASSERT_EQ(coarse.height, std::min(one.height, one.mostHeight));
            const auto middleOf = [](const LatitudeMap& map, int x, int y) {
                return glm::dvec2((x + 0.5) / map.width, 0.5 * (map.cosineOfRow(y) + map.cosineOfRow(y + 1)));
            };
            const auto sizeOf = [](const LatitudeMap& map, int y) {
                return glm::dvec2(1.0 / map.width, map.cosineOfRow(y) - map.cosineOfRow(y + 1));
            };
            double light = 0.0;
            glm::dvec2 middle(0.0), largest(0.0);
            for (int y = 0; y < coarse.height; ++y)
                for (int x = 0; x < coarse.width; ++x) {
                    const double here = double(coarse.at(x, y).x) * coarse.solidAngle(y);
                    if (here == 0.0) continue;
                    light += here;
                    middle += here * middleOf(coarse, x, y);
                    largest = glm::max(largest, sizeOf(coarse, y));
                }
            ASSERT_NEAR(light, 1e5 * fine.solidAngle(row), 1e-6 * light);
            // Coarser texels move its centroid by at most half the difference of the texel sizes.
            const glm::dvec2 moved = glm::abs(middle / light - middleOf(fine, column, row));
            const glm::dvec2 most = 0.5 * (largest - sizeOf(fine, row)) + 1e-6;
            ASSERT_LE(moved.x, most.x);
            ASSERT_LE(moved.y, most.y);
        }
}

TEST(EnvironmentMap, samplesLieAsDenselyAsTheirTexelsSayAndMissNoLight) {
    const scenes::Image map = greyMap(32, 16, [](int x, int y) {
        return x == 20 && y == 5 ? 100.0 : y > 12 ? 0.0 : 1.0;
    });
    std::vector<double> summed;
    const LatitudeMap texels = environmentTexels(map, summed);
    double densities = 0.0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
            const double solidAngle = 2.0 * pi / 32.0 * (std::cos(pi * y / 16.0) - std::cos(pi * (y + 1) / 16.0));
            densities += solidAngle * double(texels.at(x, y).a);
        }
    EXPECT_NEAR(densities, 1.0, 1e-6);
    // Interpolation lights the space between a lit and a dark texel, which therefore has samples.
    EXPECT_GT(texels.at(3, 13).a, 0.0f);
    EXPECT_EQ(texels.at(3, 15).a, 0.0f);
    // The mean of radiance over density is the light of the whole map, for any run of samples.
    const std::vector<glm::vec4> samples = makeEnvironmentSamples(texels, summed);
    double whole = 0.0;
    for (int y = 0; y < 16; ++y)
        for (int i = 0; i < 64; ++i)
            for (int j = 0; j < 64; ++j) {
                const glm::dvec2 place((i * 0.5 + 0.25) / 32.0, (y + (j + 0.5) / 64.0) / 16.0);
                whole += texels.radiance(scenes::directionInMap(place)).x * std::sin(pi * place.y) * (2.0 * pi / 64.0) *
                         (pi / 16.0 / 64.0);
            }
    for (const std::size_t run : {0u, 100u, 255u}) {
        double sum = 0.0;
        for (std::size_t i = 256 * run; i < 256 * (run + 1); ++i)
            sum += double(samples[2 * i + 1].x) / double(samples[2 * i].w) / 256.0;
        EXPECT_NEAR(sum, whole, 0.05 * whole) << run;
    }
}

/// Interpolation extends a bright texel's light to its neighbours. The sampling density is the mean interpolated
/// radiance of each texel, checked against a sum over 16 x 16 points.
TEST(EnvironmentMap, texelsAreSampledByTheLightThatIsInterpolatedInThem) {
    const scenes::Image picture = greyMap(16, 8, [](int x, int y) { return x == 5 && y == 3 ? 10.0 : 0.0; });
    std::vector<double> summed;
    const LatitudeMap map = environmentTexels(picture, summed);
    const LatitudeMap plain = latitudeMapOf(picture);
    double all = 0.0;
    std::vector<double> means;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            double mean = 0.0;
            for (int i = 0; i < 256; ++i) {
                const glm::dvec2 share = (glm::dvec2(i % 16, i / 16) + 0.5) / 16.0;
                mean += plain.radiance(scenes::directionInMap((glm::dvec2(x, y) + share) / glm::dvec2(16.0, 8.0))).g /
                        256.0;
            }
            means.push_back(mean);
            all += mean * plain.solidAngle(y);
        }
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const double wanted = means[std::size_t(16 * y + x)] / all;
            EXPECT_NEAR(double(map.at(x, y).a), wanted, 2e-3 * wanted) << x << ", " << y;
        }
}

TEST(EnvironmentFilter, evenLightStaysEvenAndIrradianceIsPiOfIt) {
    const FilteredEnvironment filtered = filterEnvironment(greyMap(64, 32, [](int, int) { return 2.0; }));
    for (const DividedOctahedron& level : filtered.levels)
        for (const glm::vec3& corner : level.corners) ASSERT_NEAR(corner.x, 2.0f, 1e-5f) << level.side;
    for (const glm::vec3& corner : filtered.irradiance.corners) ASSERT_NEAR(corner.x, 2.0f * float(pi), 1e-3f);
}

TEST(EnvironmentFilter, isGivenUpByWhatItsProgressThrows) {
    std::atomic<double> most = 0.0; // largest progress reported after the exception
    std::atomic<bool> isOver = false;
    const auto progress = [&](double done) {
        if (isOver) most = std::max(most.load(), done);
        if (done < 0.2) return;
        isOver = true;
        throw std::runtime_error("superseded");
    };
    const auto even = [](int, int) { return 1.0; };
    EXPECT_THROW(filterEnvironment(greyMap(64, 32, even), progress), std::runtime_error);
    EXPECT_LT(most, 0.9) << "it was filtered to its end";
}

TEST(EnvironmentFilter, everyLevelHoldsTheLightOfABrightTexelWithoutFireflies) {
    // 1e5 in one texel, near an edge between two faces and an edge of the map.
    const scenes::Image map = greyMap(512, 256, [](int x, int y) { return x == 511 && y == 120 ? 1e5 : 0.01; });
    const FilteredEnvironment filtered = filterEnvironment(map);
    double light = 0.01;
    light += 1e5 * 2.0 * pi / 512.0 * (std::cos(pi * 120 / 256.0) - std::cos(pi * 121 / 256.0)) / (4.0 * pi);
    const int levels = int(filtered.levels.size());
    for (int i = 0; i < levels; ++i) {
        const DividedOctahedron& level = filtered.levels[std::size_t(i)];
        // A lobe preserves the total light, up to the error of interpolation between corners.
        EXPECT_NEAR(meanOf(level), light, 0.035 * light) << i;
        // Upper bound: the lamp at the centre of the lobe, with density D / 4 over the mean cosine, which is 1 for
        // sharp lobes and 1/4 for the broadest. The lamp is near a corner of the octahedron, where texels are three
        // times smaller than on average and samples lie apart: a corner with the lamp exactly at the centre of its lobe
        // receives up to 1.54 times that.
        const double alpha = alphaOfLevel(i);
        const double most = 1.6 * (light - 0.01) / (alpha * alpha) * (1.0 + 3.0 * alpha) + 0.01;
        for (const glm::vec3& corner : level.corners) ASSERT_LE(double(corner.x), most) << i;
    }
}

/// The sum must not depend on the texel's position in the octahedron: a single sample per texel would be off by up to a
/// fifth. Each channel has one bright texel.
TEST(EnvironmentFilter, theLightOfABrightTexelDoesNotHangOnItsPlace) {
    const glm::ivec2 places[] = {{57, 31}, {130, 80}, {171, 52}};
    const scenes::Image map = scenes::builtin::drawRadiance("three", 256, 128, [&](int x, int y) {
        glm::dvec3 radiance(0.0);
        for (int c = 0; c < 3; ++c) radiance[c] = glm::ivec2(x, y) == places[c] ? 1e4 : 0.0;
        return radiance;
    });
    const FilteredEnvironment filtered = filterEnvironment(map);
    for (int c = 0; c < 3; ++c) {
        const double top = pi * places[c].y / 128.0, bottom = pi * (places[c].y + 1) / 128.0;
        const double light = 1e4 * 2.0 * pi / 256.0 * (std::cos(top) - std::cos(bottom)) / (4.0 * pi);
        for (const std::size_t level : {5u, 7u}) // wide enough for sums over corners
            EXPECT_NEAR(meanOf(filtered.levels[level], c), light, 0.02 * light) << "texel " << c << ", level " << level;
    }
}

TEST(EnvironmentFilter, levelsLieInTheAtlasWhereShadersLookThemUp) {
    const scenes::Image map = greyMap(64, 32, [](int x, int y) { return x + 100.0 * y; });
    const FilteredEnvironment filtered = filterEnvironment(map);
    constexpr int kLevels = ENVIRONMENT_LEVELS;
    const int halvings = filteredHalvingsOf(map);
    ASSERT_EQ(filtered.levels.size(), std::size_t(kLevels));
    EXPECT_NEAR(alphaOfLevel(0), ENVIRONMENT_LEAST_ALPHA, 1e-12);
    EXPECT_EQ(alphaOfLevel(kLevels - 1), 1.0);
    for (int i = 0; i < kLevels; ++i) EXPECT_NEAR(shared::filteredPlace(float(alphaOfLevel(i))), float(i), 1e-5f);
    const std::vector<glm::vec4> atlas = atlasOf(filtered);
    const glm::ivec2 size = atlasTexels(halvings);
    ASSERT_EQ(atlas.size(), std::size_t(size.x) * std::size_t(size.y));
    std::size_t texels = 0;
    const auto expectAt = [&](const DividedOctahedron& level, int number, int cells) {
        ASSERT_EQ(level.side, cells);
        for (int y = 0; y <= level.side; ++y)
            for (int x = 0; x <= level.side; ++x) {
                const auto row = std::size_t(shared::filteredTop(halvings, number) + y);
                ASSERT_EQ(glm::vec3(atlas[row * std::size_t(size.x) + std::size_t(x)]), level.at(x, y)) << number;
                ++texels;
            }
    };
    for (int level = 0; level < kLevels; ++level)
        expectAt(filtered.levels[std::size_t(level)], level, shared::filteredSide(halvings, level));
    expectAt(filtered.irradiance, kLevels, ENVIRONMENT_IRRADIANCE_SIDE);
    EXPECT_EQ(texels, 8u * 65 * 65 + 2u * 33 * 33 + 65 * 65);
}

/// Error of the irradiance from harmonics up to an order, against the sum over all texels; docs/environment.md states
/// it. A sun is the worst case.
TEST(EnvironmentFilter, irradianceByHarmonicsFallsWithTheirOrder) {
    const scenes::Image sun = greyMap(256, 128, [](int x, int y) { return x == 100 && y == 50 ? 1e5 : 0.0; });
    const double solidAngle = 2.0 * pi / 256.0 * (std::cos(pi * 50 / 128.0) - std::cos(pi * 51 / 128.0));
    const glm::dvec3 towards = scenes::directionInMap({100.5 / 256.0, 50.5 / 128.0});
    double before = 1.0;
    for (const int order : {2, 4, 8, kIrradianceOrder}) {
        constexpr int kCells = 32;
        const DividedOctahedron irradiance = irradianceOf(sun, order, kCells);
        double worst = 0.0;
        for (int y = 0; y <= kCells; ++y)
            for (int x = 0; x <= kCells; ++x) {
                const glm::dvec3 n = directionOf(DividedOctahedron::codeOfCorner(x, y, kCells));
                const double truth = std::max(glm::dot(n, towards), 0.0);
                const double own = double(irradiance.at(x, y).x) / (1e5 * solidAngle);
                worst = std::max(worst, std::abs(own - truth));
            }
        RecordProperty("order" + std::to_string(order), std::to_string(worst));
        EXPECT_LT(worst, 0.7 * before) << order;
        before = worst;
    }
    EXPECT_LE(before, 1e-2); // where the sun is at the horizon
}

/// Constant and linear harmonics give a distant lamp of unit irradiance 1/4 + n.l / 2. A map of 1024 x 512 texels is
/// not averaged, which would move a lamp by up to a quarter of a row and change its sum by up to 8e-4.
TEST(EnvironmentFilter, irradianceOfTheLargestMapThatIsNotAveragedIsThatOfItsTexels) {
    constexpr int kWidth = 1024, kHeight = 512, kCells = 4;
    for (const glm::ivec2 texel : {glm::ivec2(300, 100), glm::ivec2(701, 256), glm::ivec2(12, 409)}) {
        const scenes::Image lamp =
            greyMap(kWidth, kHeight, [&](int x, int y) { return glm::ivec2(x, y) == texel ? 1e5 : 0.0; });
        const double top = std::cos(pi * texel.y / kHeight), bottom = std::cos(pi * (texel.y + 1) / kHeight);
        const double longitude = 2.0 * pi * ((texel.x + 0.5) / kWidth - 0.5), up = 0.5 * (top + bottom);
        const glm::dvec3 towards =
            glm::dvec3(std::sin(longitude), 0.0, -std::cos(longitude)) * std::sqrt(1.0 - up * up) +
            glm::dvec3(0.0, up, 0.0);
        const DividedOctahedron irradiance = irradianceOf(lamp, 1, kCells);
        for (int y = 0; y <= kCells; ++y)
            for (int x = 0; x <= kCells; ++x) {
                const glm::dvec3 n = directionOf(DividedOctahedron::codeOfCorner(x, y, kCells));
                const double own = double(irradiance.at(x, y).x) / (1e5 * 2.0 * pi / kWidth * (top - bottom));
                ASSERT_NEAR(own, std::max(0.25 + 0.5 * glm::dot(n, towards), 0.0), 1e-5)
                    << texel.x << ": " << x << ", " << y;
            }
    }
}

TEST(EnvironmentFilter, aMapOfMoreColumnsOrRowsThanNeededIsFilteredAsTheCoarserOne) {
    constexpr int kOrder = 4, kCells = 8;
    const auto light = [](int x, int y) { return (x * 7919 + y * 104729) % 1009; };
    const std::pair<scenes::Image, scenes::Image> finerAndCoarser[] = {
        {greyMap(16384, 2, [&](int x, int y) { return light(x / 16, y); }), greyMap(1024, 2, light)},
        {greyMap(3, 16384, [&](int x, int y) { return light(x, y / 32); }), greyMap(3, 512, light)}};
    for (const auto& [finer, coarser] : finerAndCoarser) {
        const DividedOctahedron seen = irradianceOf(finer, kOrder, kCells);
        const DividedOctahedron wanted = irradianceOf(coarser, kOrder, kCells);
        for (std::size_t i = 0; i < wanted.corners.size(); ++i)
            ASSERT_NEAR(seen.corners[i].x, wanted.corners[i].x, 1e-5f * wanted.corners[i].x)
                << finer.width << ", " << i;
    }
}

} // namespace
} // namespace tessera::frame
