#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/frame/ComputedCache.h"
#include "renderer/frame/EnvironmentFilter.h"
#include "renderer/frame/EnvironmentIrradiance.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/LobeTable.h"
#include "scenes/builtin/Pictures.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/lobe_table.h"
#include "tests/support/Sweep.h"
#include "tests/support/TempFolder.h"

namespace tessera::frame {
namespace {

using std::numbers::pi;

scenes::Image mapOf(int width, int height, const std::function<double(int, int)>& radiance) {
    return scenes::builtin::drawRadiance("test", width, height,
                                         [&](int x, int y) { return glm::dvec3(radiance(x, y)); });
}

/// Mean radiance over all directions.
double meanOf(const DividedOctahedron& level) {
    double sum = 0.0, weights = 0.0;
    const auto cells = [&](int at) {
        return at == 0 || at == level.side ? 0.5 : 1.0;
    }; // around a corner, along an axis
    for (int y = 0; y <= level.side; ++y)
        for (int x = 0; x <= level.side; ++x) {
            // The solid angle of a piece of a plane falls by the cube of its distance.
            const glm::dvec3 direction = directionOf(DividedOctahedron::codeOfCorner(x, y, level.side));
            const double inverse = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
            const double weight = cells(x) * cells(y) * 4.0 / (level.side * level.side) * std::pow(inverse, 3.0);
            sum += weight * double(level.at(x, y).x);
            weights += weight;
        }
    EXPECT_NEAR(weights, 4.0 * pi, 0.01 * 4.0 * pi);
    return sum / weights;
}

TEST(EnvironmentFilter, directionsComeBackFromTheSquareAndEdgesMeet) {
    for (int i = 0; i < 200; ++i) {
        const double up = 1.0 - (i + 0.5) / 100.0, turn = 2.4 * i, level = std::sqrt(1.0 - up * up);
        const glm::dvec3 direction(level * std::cos(turn), up, level * std::sin(turn));
        // Codes are found in single precision, by a few operations of 6e-8 each.
        EXPECT_LT(glm::distance(directionOf(codeOf(glm::vec3(direction))), direction), 1e-6);
    }
    // Corners on the square's edges that are one place of the sphere hold one value.
    const FilteredEnvironment filtered = filterEnvironment(mapOf(64, 32, [](int x, int y) { return x + 100.0 * y; }));
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
                mapOf(one.width, one.height, [&](int x, int y) { return x == column && y == row ? 1e5 : 0.0; });
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
            // What it lies in spreads it, by no more than their sizes differ.
            const glm::dvec2 moved = glm::abs(middle / light - middleOf(fine, column, row));
            const glm::dvec2 most = 0.5 * (largest - sizeOf(fine, row)) + 1e-6;
            ASSERT_LE(moved.x, most.x);
            ASSERT_LE(moved.y, most.y);
        }
}

TEST(EnvironmentMap, samplesLieAsDenselyAsTheirTexelsSayAndMissNoLight) {
    const scenes::Image map = mapOf(32, 16, [](int x, int y) {
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
    // Light between a lit texel and a dark one is there, and so are samples of it.
    EXPECT_GT(texels.at(3, 13).a, 0.0f);
    EXPECT_EQ(texels.at(3, 15).a, 0.0f);
    // The mean of radiance over density is the light of the whole map, whatever run of samples is taken.
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

TEST(EnvironmentFilter, evenLightStaysEvenAndIrradianceIsPiOfIt) {
    const FilteredEnvironment filtered = filterEnvironment(mapOf(64, 32, [](int, int) { return 2.0; }));
    for (const DividedOctahedron& level : filtered.levels)
        for (const glm::vec3& corner : level.corners) ASSERT_NEAR(corner.x, 2.0f, 1e-5f) << level.side;
    for (const glm::vec3& corner : filtered.irradiance.corners) ASSERT_NEAR(corner.x, 2.0f * float(pi), 1e-3f);
}

TEST(EnvironmentFilter, everyLevelHoldsTheLightOfABrightTexelWithoutFireflies) {
    // 1e5 in one texel, near an edge of two faces and of the map.
    const scenes::Image map = mapOf(512, 256, [](int x, int y) { return x == 511 && y == 120 ? 1e5 : 0.01; });
    const FilteredEnvironment filtered = filterEnvironment(map);
    double light = 0.01;
    light += 1e5 * 2.0 * pi / 512.0 * (std::cos(pi * 120 / 256.0) - std::cos(pi * 121 / 256.0)) / (4.0 * pi);
    const int levels = int(filtered.levels.size());
    for (int i = 0; i < levels; ++i) {
        const DividedOctahedron& level = filtered.levels[std::size_t(i)];
        // A lobe moves light but keeps its sum, as far as triangles between corners can tell.
        EXPECT_NEAR(meanOf(level), light, 0.035 * light) << i;
        // The lamp seen in the middle of the lobe: by its density D / 4 over the mean of the cosine, which is 1 for
        // sharp lobes and 1/4 where they are as broad as can be. The lamp stands near a corner of the octahedron, where
        // texels are three times as small as on average, so that samples lie apart: a corner that has the lamp in the
        // very middle of its lobe sees up to 1.54 of that.
        const double alpha = alphaOfLevel(i);
        const double most = 1.6 * (light - 0.01) / (alpha * alpha) * (1.0 + 3.0 * alpha) + 0.01;
        for (const glm::vec3& corner : level.corners) ASSERT_LE(double(corner.x), most) << i;
    }
}

TEST(EnvironmentFilter, levelsLieInTheAtlasWhereShadersLookThemUp) {
    const scenes::Image map = mapOf(64, 32, [](int x, int y) { return x + 100.0 * y; });
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

/// The error of irradiance by harmonics up to an order, against the sum over all texels: what docs/environment.md
/// tells. A sun is the worst that there is.
TEST(EnvironmentFilter, irradianceByHarmonicsFallsWithTheirOrder) {
    const scenes::Image sun = mapOf(256, 128, [](int x, int y) { return x == 100 && y == 50 ? 1e5 : 0.0; });
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
    EXPECT_LE(before, 1e-2); // where the sun stands at the horizon
}

TEST(EnvironmentFilter, aMapOfMoreColumnsOrRowsThanNeededIsFilteredAsTheCoarserOne) {
    constexpr int kOrder = 4, kCells = 8;
    const auto light = [](int x, int y) { return (x * 7919 + y * 104729) % 1009; };
    const std::pair<scenes::Image, scenes::Image> finerAndCoarser[] = {
        {mapOf(16384, 2, [&](int x, int y) { return light(x / 16, y); }), mapOf(1024, 2, light)},
        {mapOf(3, 16384, [&](int x, int y) { return light(x, y / 32); }), mapOf(3, 512, light)}};
    for (const auto& [finer, coarser] : finerAndCoarser) {
        const DividedOctahedron seen = irradianceOf(finer, kOrder, kCells);
        const DividedOctahedron wanted = irradianceOf(coarser, kOrder, kCells);
        for (std::size_t i = 0; i < wanted.corners.size(); ++i)
            ASSERT_NEAR(seen.corners[i].x, wanted.corners[i].x, 1e-5f * wanted.corners[i].x)
                << finer.width << ", " << i;
    }
}

TEST(EnvironmentFilter, whatWasFilteredOnceIsReadAgainUnlessItsFileIsDamaged) {
    test::TempFolder folder;
    const scenes::Image map = mapOf(32, 16, [](int x, int y) { return x + 0.1 * y; });
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path());
    const auto file = *std::filesystem::directory_iterator(folder.path());
    bool computed = false;
    const auto note = [&](double) { computed = true; };
    const FilteredEnvironment again = cachedEnvironment(map, folder.path(), note);
    EXPECT_FALSE(computed);
    ASSERT_EQ(again.levels.size(), fresh.levels.size());
    for (std::size_t i = 0; i < fresh.levels.size(); ++i) EXPECT_EQ(again.levels[i].corners, fresh.levels[i].corners);
    EXPECT_EQ(again.irradiance.corners, fresh.irradiance.corners);
    std::filesystem::resize_file(file.path(), 1000);
    EXPECT_EQ(cachedEnvironment(map, folder.path(), note).irradiance.corners, fresh.irradiance.corners);
    EXPECT_TRUE(computed);
    // One bit is enough, in the middle as in the last number.
    const auto size = std::streamoff(std::filesystem::file_size(file.path()));
    for (const std::streamoff at : {size / 2, size - 1}) {
        computed = false;
        std::fstream bytes(file.path(), std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekg(at);
        const int byte = bytes.get();
        bytes.seekp(at).put(char(byte ^ 1));
        bytes.close();
        EXPECT_EQ(cachedEnvironment(map, folder.path(), note).irradiance.corners, fresh.irradiance.corners);
        EXPECT_TRUE(computed) << at;
    }
    // Another map of the same shape has another file.
    computed = false;
    cachedEnvironment(mapOf(32, 16, [](int x, int) { return x; }), folder.path(), note);
    EXPECT_TRUE(computed);
}

/// Of the size that people's maps have.
TEST(EnvironmentFilterSlow, aMapOf2048ColumnsTakesFiveSecondsOfTwoCoresAndReadAgainATwentiethOfASecond) {
#ifdef __SANITIZE_ADDRESS__
    constexpr double kSlower = 20.0; // sanitizers take several times as long
#else
    constexpr double kSlower = 1.0;
#endif
    constexpr double kCores = 2.0, kMostSeconds = 5.0, kMostSecondsAgain = 0.05;
    test::TempFolder folder;
    const scenes::Image map =
        mapOf(2048, 1024, [](int x, int y) { return 1.0 + std::sin(0.01 * x) * std::cos(0.03 * y); });
    const std::clock_t start = std::clock(); // of all threads together: other programs do not count
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path());
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC / kCores;
    double secondsAgain = kMostSeconds;
    for (int round = 0; round < 5; ++round) {
        const auto began = std::chrono::steady_clock::now();
        EXPECT_EQ(cachedEnvironment(map, folder.path()).irradiance.corners, fresh.irradiance.corners);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        secondsAgain = std::min(secondsAgain, took.count());
    }
    fmt::print("filtered in {:.2f} s, read again in {:.1f} ms\n", seconds, 1e3 * secondsAgain);
    EXPECT_LE(seconds, kSlower * kMostSeconds);
    EXPECT_LE(secondsAgain, kSlower * kMostSecondsAgain);
}

TEST(EnvironmentFilter, aFolderThatCannotBeWrittenIsToldOnce) {
    takeCacheFault(); // of other tests
    test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "file";
    std::ofstream(file) << "in the way";
    const scenes::Image map = mapOf(32, 16, [](int x, int) { return 2.0 + x; });
    const FilteredEnvironment fresh = filterEnvironment(map);
    EXPECT_EQ(cachedEnvironment(map, file / "cache").irradiance.corners, fresh.irradiance.corners);
    const std::string fault = takeCacheFault();
    EXPECT_NE(fault.find((file / "cache").string()), std::string::npos) << fault;
    EXPECT_NE(fault.find("Not a directory"), std::string::npos) << fault;
    EXPECT_EQ(takeCacheFault(), "");
    cachedEnvironment(map, file / "cache");
    EXPECT_EQ(takeCacheFault(), "") << "it was said";
}

/// Made once for all tests.
const std::vector<glm::vec4>& lobeTable() {
    static const std::vector<glm::vec4> table = makeLobeTable();
    return table;
}

/// A place from 0 to 1 along both sides of a layer, as shaders look it up.
glm::vec4 interpolatedAt(const std::vector<glm::vec4>& table, const glm::dvec2& along, int layer) {
    const glm::dvec2 place = along * (LOBE_TABLE_SIDE - 1.0);
    const glm::ivec2 low = glm::min(glm::ivec2(place), glm::ivec2(LOBE_TABLE_SIDE - 2));
    const glm::vec2 share(place - glm::dvec2(low));
    const auto texel = [&](int i, int j) {
        return table[std::size_t((layer * LOBE_TABLE_SIDE + low.y + j) * LOBE_TABLE_SIDE + low.x + i)];
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x), glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

glm::vec4 lookedUp(const std::vector<glm::vec4>& table, double cosine, double alpha) {
    return interpolatedAt(table, glm::sqrt(glm::dvec2(cosine, alpha)), LOBE_LAYER_GGX);
}

/// F by Snell's law.
double fresnelBySnell(double ior, double cosine) {
    const double sine = std::sqrt(1.0 - cosine * cosine) / ior;
    if (!(sine < 1.0)) return 1.0;
    const double inside = std::sqrt(1.0 - sine * sine);
    const double across = (cosine - ior * inside) / (cosine + ior * inside);
    const double along = (ior * cosine - inside) / (ior * cosine + inside);
    return 0.5 * (across * across + along * along);
}

/// reflectedByDielectric() of shaders/lib/reflectance/even_light.glsl.
double dielectricLookedUp(const std::vector<glm::vec4>& table, double ior, double cosine, double alpha) {
    const double number = double(shared::iorPlace(float(ior)));
    const bool isDenser = ior >= 1.0;
    const int first = std::min(int(number), (isDenser ? LOBE_TABLE_IORS - 1 : LOBE_TABLE_IOR_ONE) - 2);
    const double t = number - first;
    const double shares[] = {0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0)};
    const glm::dvec2 place(double(shared::lobeColumn(float(ior), float(cosine))), std::sqrt(alpha));
    double reflected = 0.0;
    for (int i = 0; i < 3; ++i) {
        if (!isDenser && first + i == LOBE_TABLE_IOR_ONE) continue;
        reflected +=
            shares[i] * double(interpolatedAt(table, place, LOBE_LAYER_DIELECTRIC + (first + i) / 4)[(first + i) % 4]);
    }
    if (isDenser) {
        const double root = double(interpolatedAt(table, place, LOBE_LAYER_SHEEN).z);
        reflected *= fresnelBySnell(ior, root * root);
    }
    return std::clamp(reflected, 0.0, 1.0);
}

/// By half vectors h with the density D n.h, dl = 4 v.h dh: the mean of F G v.h / (n.v n.h).
double reflectedByHalfVectors(double ior, double cosView, double alpha) {
    constexpr int kRings = 512, kTurns = 256;
    const double sine = std::sqrt(1.0 - cosView * cosView);
    const auto masked = [&](double cosine) {
        return 2.0 * cosine / (cosine + std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
    };
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i) {
        const double left = (i + 0.5) / kRings, weight = 4.0 * left * left * left; // finer far from the normal
        const double u = 1.0 - left * left * left * left, slope = alpha * std::sqrt(u / (1.0 - u));
        const double cosHalf = 1.0 / std::sqrt(1.0 + slope * slope), sineHalf = slope * cosHalf;
        for (int j = 0; j < kTurns; ++j) {
            const double turn = 2.0 * pi * (j + std::fmod(0.618 * i, 1.0)) / kTurns;
            const double incidence = cosHalf * cosView + sineHalf * sine * std::cos(turn);
            const double cosLight = 2.0 * incidence * cosHalf - cosView;
            if (!(incidence > 0.0 && cosLight > 0.0)) continue;
            sum += weight * fresnelBySnell(ior, std::min(incidence, 1.0)) * masked(cosLight) * masked(cosView) *
                   incidence / (cosView * cosHalf);
        }
    }
    return sum / (double(kRings) * kTurns);
}

/// Where total reflection begins as elsewhere, and on both sides of index 1; or of every third of these indices.
void expectDielectricsLobe() {
    const std::vector<glm::vec4>& table = lobeTable();
    for (const double ior :
         ::tessera::test::everyNth(std::vector{0.15, 0.4, 0.6, 0.7, 0.75, 0.83, 0.93, 0.98, 1.2, 1.33, 1.5, 2.5}, 3))
        for (const double alpha : {0.005, 0.03, 0.1, 0.3, 0.6, 1.0})
            for (int i = 0; i < 12; ++i) {
                const double cosine = 0.08 + 0.083 * i;
                const double truth = reflectedByHalfVectors(ior, cosine, alpha);
                EXPECT_NEAR(dielectricLookedUp(table, ior, cosine, alpha), truth, 0.02 * truth + 5e-4)
                    << ior << ", alpha " << alpha << ", cosine " << cosine;
            }
}
TEST(LobeTable, aDielectricsLobeIsInterpolatedWithinTwoPercent) {
    expectDielectricsLobe();
}
TEST(LobeTableSlow, aDielectricsLobeIsInterpolatedWithinTwoPercent) {
    expectDielectricsLobe();
}

/// Half-way between the table's indices from 1 to 3 and at an end of that, where a table of reflectances was off by all
/// of them; or of every third of these. Without an absolute part where the viewer's cosine is 0.08 or more.
void expectIndicesFrom1To3() {
    const std::vector<glm::vec4>& table = lobeTable();
    std::vector<double> iors{1.02, 1.1, 3.0};
    constexpr double kAbove = LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE;
    for (double place = 0.5; place < 0.75 * kAbove; place += 1.0) {
        const double contrast = std::pow(place / kAbove, 3.0), ior = (1.0 + contrast) / (1.0 - contrast);
        EXPECT_NEAR(double(shared::iorPlace(float(ior))), LOBE_TABLE_IOR_ONE + place, 0.02);
        iors.push_back(ior);
    }
    for (const double ior : ::tessera::test::everyNth(iors, 3))
        for (const double alpha : {0.001, 0.03, 0.1, 0.3, 1.0})
            for (const double cosine : {0.01, 0.03, 0.08, 0.25, 0.6, 0.993}) {
                const double truth = reflectedByHalfVectors(double(float(ior)), cosine, alpha);
                EXPECT_NEAR(dielectricLookedUp(table, double(float(ior)), cosine, alpha), truth,
                            0.02 * truth + (cosine < 0.08 ? 2e-3 : 0.0))
                    << ior << ", alpha " << alpha << ", cosine " << cosine;
            }
}
TEST(LobeTable, anyIndexFrom1To3IsInterpolatedWithinTwoPercentOfItsReflectance) {
    expectIndicesFrom1To3();
}
TEST(LobeTableSlow, anyIndexFrom1To3IsInterpolatedWithinTwoPercentOfItsReflectance) {
    expectIndicesFrom1To3();
}

TEST(LobeTable, nothingIsReflectedWhereTheIndexIsOne) {
    EXPECT_EQ(shared::iorPlace(1.0f), float(LOBE_TABLE_IOR_ONE)) << "between two places others would be mixed in";
    for (const double alpha : {0.0, 0.3, 1.0})
        for (const double cosine : {0.01, 0.5, 1.0}) {
            EXPECT_LT(dielectricLookedUp(lobeTable(), 1.0, cosine, alpha), 1e-12);
            // From below too, but where reflection is total.
            EXPECT_LT(dielectricLookedUp(lobeTable(), 0.99999, std::max(cosine, 0.5), alpha), 1e-6);
        }
}

/// Blinn's highlight (n.h)^p over all lights dl = 4 v.h dh, by circles of half vectors.
double reflectedByBlinn(double exponent, double cosView) {
    constexpr int kRings = 1000, kTurns = 256;
    const double sine = std::sqrt(1.0 - cosView * cosView), widest = std::min(0.5 * pi, 20.0 / std::sqrt(exponent));
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double away = widest * (i + 0.5) / kRings, turn = 2.0 * pi * (j + 0.5) / kTurns;
            const double cosHalf = std::cos(away);
            const double incidence = cosHalf * cosView + std::sin(away) * sine * std::cos(turn);
            if (incidence > 0.0 && 2.0 * incidence * cosHalf > cosView)
                sum += std::sin(away) * std::pow(cosHalf, exponent) * 4.0 * incidence;
        }
    return sum * (widest / kRings) * (2.0 * pi / kTurns);
}

/// Also of lobes that are narrower than any of the table.
TEST(LobeTable, blinnsHighlightIsInterpolatedWithinHalfAPercentAtAnyExponent) {
    const std::vector<glm::vec4>& table = lobeTable();
    for (const double exponent : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e9})
        for (const double cosine : {0.05, 0.15, 0.5, 0.9, 1.0}) {
            const double alpha = std::min(std::sqrt(2.0 / (exponent + 2.0)), 1.0); // lobeAlpha() of lobes.glsl
            const double reflected = double(lookedUp(table, cosine, alpha).z) / (exponent + 2.0);
            const double truth = reflectedByBlinn(exponent, cosine);
            EXPECT_NEAR(reflected, truth, 5e-3 * truth) << exponent << ", cosine " << cosine;
        }
}

/// A and B of the split sum by perceptual roughness and the viewer's cosine, shading.md section 6.
TEST(LobeTable, holdsThePublishedSplitSum) {
    const std::vector<glm::vec4>& table = lobeTable();
    constexpr double kRoughness[] = {0.25, 0.5, 0.75, 1.0}, kCosines[] = {0.1, 0.5, 1.0};
    constexpr double kA[4][3] = {
        {.5051, .9557, .9957}, {.7519, .8349, .9158}, {.7958, .6547, .6268}, {.7363, .4477, .3067}};
    constexpr double kB[4][3] = {{.3916, .0326, .0}, {.1397, .0223, .0}, {.0526, .0085, .0}, {.0239, .0030, .0}};
    for (int r = 0; r < 4; ++r)
        for (int m = 0; m < 3; ++m) {
            const glm::vec4 lobe = lookedUp(table, kCosines[m], kRoughness[r] * kRoughness[r]);
            EXPECT_NEAR(lobe.x - lobe.y, kA[r][m], 1e-3) << kRoughness[r] << ", " << kCosines[m];
            EXPECT_NEAR(lobe.y, kB[r][m], 1e-3) << kRoughness[r] << ", " << kCosines[m];
        }
}

} // namespace
} // namespace tessera::frame
