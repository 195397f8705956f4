#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "GltfBuilder.h"
#include "base/Srgb.h"
#include "scenes/Environment.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes::gltf::test {
namespace {

using namespace scenes::test;
using std::numbers::pi;

std::string pfm(int side, const std::function<glm::vec3(int, int)>& light) {
    std::vector<float> rgb;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 texel = light(x, y);
            rgb.insert(rgb.end(), {texel.r, texel.g, texel.b});
        }
    return pfmOf(side, side, rgb);
}

/// Direction of a position on a face, 0..1 from the upper left corner, as viewed from the centre of the room. Up is +Y
/// on the side faces, -Z on the face above and +Z on the face below.
glm::dvec3 seenAt(int face, double x, double y) {
    const double right = 2.0 * x - 1.0, up = 1.0 - 2.0 * y;
    const glm::dvec3 directions[] = {{1.0, up, right},   {-1.0, up, -right}, {-right, 1.0, -up},
                                     {-right, -1.0, up}, {-right, up, 1.0},  {right, up, -1.0}};
    return directions[face];
}

Json& lightOf(Builder& builder) {
    return builder.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

/// Adds a light with these images as faces and without irradiance.
void addLight(Builder& builder, int side, const std::array<std::string, 6>& faces) {
    Json& light = lightOf(builder);
    light = {{"name", "room"}, {"specularImageSize", side}, {"specularImages", Json::array({Json::array()})}};
    builder.json["images"] = Json::array();
    for (const std::string& face : faces) {
        light["specularImages"][0].push_back(builder.json["images"].size());
        builder.json["images"].push_back({{"uri", dataUri(bytesOf(face))}});
    }
    light["irradianceCoefficients"] = std::vector<std::array<double, 3>>(9);
    builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    builder.json["extensionsUsed"] = {"EXT_lights_image_based"};
}

/// A cube whose light is a function of the unit direction.
Builder cubeOf(int side, const std::function<glm::dvec3(glm::dvec3)>& light) {
    std::array<std::string, 6> faces;
    for (int face = 0; face < 6; ++face)
        faces[std::size_t(face)] = pfm(side, [&](int x, int y) {
            return glm::vec3(light(glm::normalize(seenAt(face, (x + 0.5) / side, (y + 0.5) / side))));
        });
    Builder builder;
    addLight(builder, side, faces);
    return builder;
}

std::array<std::string, 6> sixOf(const std::string& face) {
    return {face, face, face, face, face, face};
}

glm::dvec3 texelAt(const Image& map, int x, int y) {
    glm::vec4 texel;
    std::memcpy(&texel, map.texels.data() + std::size_t(y * map.width + x) * sizeof(texel), sizeof(texel));
    return glm::dvec3(texel);
}

/// The largest distance of a texel from a function of its direction.
double worst(const Image& map, const std::function<glm::dvec3(glm::dvec3)>& light) {
    double distance = 0.0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const glm::dvec3 direction = directionInMap({(x + 0.5) / map.width, (y + 0.5) / map.height});
            distance = std::max(distance, glm::distance(texelAt(map, x, y), light(direction)));
        }
    return distance;
}

glm::dvec3 byDirection(glm::dvec3 direction) {
    return 2.0 + direction;
}

TEST(GltfEnvironment, everyTexelOfACubeIsFoundInItsDirection) {
    const Scene scene = cubeOf(16, byDirection).import();
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->map.width, 64);
    EXPECT_EQ(scene.environment->map.height, 32);
    EXPECT_EQ(scene.environment->map.name, "room");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.images.empty()) << "faces are no textures";
    // Bilinear lookup leaves the curvature of a direction over a texel and the lookup across edges. A mirrored, rotated
    // or exchanged face errs by about 1.
    EXPECT_LT(worst(scene.environment->map, byDirection), 0.02);
}

TEST(GltfEnvironment, aCubeKeepsTheLightOfABrightTexelAnywhere) {
    constexpr int kSide = 8;
    for (const int face : {0, 2, 5})
        for (const auto& [column, row] : {std::pair(3, 4), std::pair(0, 0), std::pair(7, 3)}) {
            std::array<std::string, 6> faces = sixOf(pfm(kSide, [](int, int) { return glm::vec3(0.0f); }));
            faces[std::size_t(face)] = pfm(
                kSide, [&, x = column, y = row](int i, int j) { return glm::vec3(i == x && j == y ? 1000.0f : 0.0f); });
            Builder builder;
            addLight(builder, kSide, faces);
            const Image map = builder.import().environment.value().map;
            double sum = 0.0;
            for (int y = 0; y < map.height; ++y)
                for (int x = 0; x < map.width; ++x)
                    sum += texelAt(map, x, y).r * 2.0 * pi / map.width *
                           (std::cos(pi * y / map.height) - std::cos(pi * (y + 1) / map.height));
            const double length = glm::length(seenAt(face, (column + 0.5) / kSide, (row + 0.5) / kSide));
            const double truth = 1000.0 * 4.0 / (kSide * kSide) / (length * length * length);
            // At corners and edges the interpolation reaches texels of other sizes.
            EXPECT_NEAR(sum, truth, 0.05 * truth) << face << ", " << column << ", " << row;
        }
}

TEST(GltfEnvironment, itsRotationTurnsItAndItsIntensityIsTheScenes) {
    Builder builder = cubeOf(16, byDirection);
    // A quarter turn about +X, as a quaternion of length 2: the part above moves to the front, +Z.
    lightOf(builder)["rotation"] = {2.0 * std::sqrt(0.5), 0.0, 0.0, 2.0 * std::sqrt(0.5)};
    lightOf(builder)["intensity"] = 2.5;
    const Scene scene = builder.import();
    EXPECT_EQ(scene.environment.value().intensity, 2.5f);
    EXPECT_EQ(scene.environment->rotationDegrees, 0.0f);
    EXPECT_LT(worst(scene.environment->map, [](glm::dvec3 d) { return byDirection({d.x, d.z, -d.y}); }), 0.02);
}

TEST(GltfEnvironment, picturesWithOpacityHoldLightDividedByIt) {
    const double code200 = linearFromSrgb(200.0 / 255.0);
    const auto lightOf8Bits = [](int channels, int alpha) {
        std::string pixels;
        for (int i = 0; i < 4; ++i)
            pixels += std::string{char(200), char(255), '\0', char(alpha)}.substr(0, std::size_t(channels));
        Builder builder;
        addLight(builder, 2, sixOf(pngOf(2, 2, 8, channels == 4 ? 6 : 2, pixels)));
        return builder.import().environment.value().map;
    };
    const auto expectEven = [](const Image& map, const glm::dvec3& light) {
        EXPECT_LT(worst(map, [&](glm::dvec3) { return light; }), 1e-5 * glm::length(light));
    };
    expectEven(lightOf8Bits(3, 255), {code200, 1.0, 0.0});
    expectEven(lightOf8Bits(4, 255), {code200, 1.0, 0.0});
    expectEven(lightOf8Bits(4, 51), glm::dvec3(code200, 1.0, 0.0) * 5.0);
}

TEST(GltfEnvironment, numbersOfItsFacesThatAreNoLightAreReplacedAndCounted) {
    Builder builder;
    // Opacity 0: red and green are infinite, blue is 0 by 0.
    addLight(builder, 1, sixOf(pngOf(1, 1, 8, 6, std::string("\xff\x0a\0\0", 4))));
    const Scene scene = builder.import();
    EXPECT_TRUE(hasWarning(scene, "the environment 'room' holds NaN in 6 numbers, taken as 0"));
    EXPECT_TRUE(hasWarning(scene, "the environment 'room' holds infinity in 12 numbers, taken as its brightest"));
    EXPECT_LT(worst(scene.environment.value().map, [](glm::dvec3) { return glm::dvec3(1, 1, 0); }), 1e-6);
}

TEST(GltfEnvironment, aFaceThatCannotBeReadOrIsNotSquareIsACheckerboardUnlessLoadsAreStrict) {
    // As a face of 512x512 the line would make the map large.
    for (const auto& [face, flaw] :
         {std::pair<std::string, const char*>("no", "/images/2"),
          {pfmOf(512, 1, std::vector<float>(3 * 512, 0.0f)),
           "/images/2: has 512x1 texels, and is a face of an environment, which is square"}}) {
        std::array<std::string, 6> faces = sixOf(pfm(8, [](int, int) { return glm::vec3(0.25f); }));
        faces[2] = face;
        Builder builder;
        addLight(builder, 8, faces);
        const Scene scene = builder.import();
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_THAT(scene.warnings[0],
                    AllOf(HasSubstr(flaw), HasSubstr("; its side of the environment is a checkerboard")));
        const Image& map = scene.environment.value().map;
        EXPECT_EQ(map.width, 4 * 64) << "that of the checkerboard, which is the largest";
        EXPECT_NE(texelAt(map, 0, 0), glm::dvec3(0.25)) << "above";
        EXPECT_EQ(texelAt(map, 0, map.height - 1), glm::dvec3(0.25)) << "below";
        builder.importOptions.isStrict = true;
        EXPECT_THAT(builder.error(), HasSubstr(flaw));
    }
}

TEST(GltfEnvironment, facesOfOtherSizesThanStatedAreStretchedToTheLargestWithAWarning) {
    // The stated size is ignored: a short file must not request gigabytes.
    Builder builder = cubeOf(16, byDirection);
    lightOf(builder)["specularImageSize"] = 2147483647;
    const Scene scene = builder.import();
    EXPECT_TRUE(hasWarning(scene, "the environment 'room' has faces of other sizes than 2147483647x2147483647 texels, "
                                  "its specularImageSize; all are stretched to the largest"));
    EXPECT_EQ(scene.environment.value().map.width, 64);
    EXPECT_LT(worst(scene.environment->map, byDirection), 0.02);
    // One face has half the texels.
    Builder other = cubeOf(32, byDirection);
    other.json["images"][4] = cubeOf(16, byDirection).json["images"][4];
    const Scene mixed = other.import();
    EXPECT_EQ(mixed.warnings.size(), 1u);
    EXPECT_EQ(mixed.environment.value().map.width, 128);
    EXPECT_LT(worst(mixed.environment->map, byDirection), 0.05);
}

/// Irradiance coefficients of byDirection(): pi times uniform radiance, and 2/3 pi times radiance linear along an axis,
/// over the factors of the harmonics (Ramamoorthi and Hanrahan 2001).
std::vector<std::array<double, 3>> irradianceByDirection() {
    std::vector<std::array<double, 3>> irradiance(9);
    irradiance[0].fill(2.0 * pi / 0.282095);
    irradiance[1][1] = irradiance[2][2] = irradiance[3][0] = 2.0 / 3.0 * pi / 0.488603;
    return irradiance;
}

TEST(GltfEnvironment, irradianceThatIsNotThatOfTheFacesIsNoted) {
    Builder builder = cubeOf(16, byDirection);
    std::vector<std::array<double, 3>> irradiance = irradianceByDirection();
    lightOf(builder)["irradianceCoefficients"] = irradiance;
    EXPECT_THAT(builder.import().notes, IsEmpty());
    const auto scale = [&](double factor) {
        for (std::array<double, 3>& coefficient : irradiance)
            for (double& number : coefficient) number *= factor;
        lightOf(builder)["irradianceCoefficients"] = irradiance;
    };
    scale(1.04);
    EXPECT_THAT(builder.import().notes, IsEmpty()) << "within five percent";
    scale(1.10 / 1.04);
    const std::vector<std::string> notes = builder.import().notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_THAT(notes[0], HasSubstr("the irradianceCoefficients of the environment 'room' differ from the irradiance "
                                    "of its faces by 10 % of that, and the faces count"));
}

/// Light of two harmonics, so that its irradiance is known. One coefficient is off by 1 % less or more than five
/// percent of all. The sum over texels errs by 2e-4 of all.
TEST(GltfEnvironment, everyCoefficientIsComparedToFivePercentOfAll) {
    using V = glm::dvec3;
    const double constant = 0.5 / std::sqrt(pi), linear = std::sqrt(0.75 / pi), mixed = 0.5 * std::sqrt(15.0 / pi);
    const struct {
        std::size_t changed, second; ///< coefficients
        double (*light)(const V&);   ///< 1 and the second one's polynomial
        double irradiance;           ///< of the second
    } cases[] = {{0, 1, [](const V& n) { return 1.0 + n.y; }, 2.0 / 3.0 * pi / linear},
                 {1, 1, [](const V& n) { return 1.0 + n.y; }, 2.0 / 3.0 * pi / linear},
                 {2, 2, [](const V& n) { return 1.0 + n.z; }, 2.0 / 3.0 * pi / linear},
                 {3, 3, [](const V& n) { return 1.0 + n.x; }, 2.0 / 3.0 * pi / linear},
                 {4, 4, [](const V& n) { return 1.0 + 2.0 * n.x * n.y; }, pi / 2.0 / mixed},
                 {5, 5, [](const V& n) { return 1.0 + 2.0 * n.y * n.z; }, pi / 2.0 / mixed},
                 {6, 6, [](const V& n) { return 3.0 * n.z * n.z; }, pi / std::sqrt(5.0 / pi)},
                 {7, 7, [](const V& n) { return 1.0 + 2.0 * n.x * n.z; }, pi / 2.0 / mixed},
                 {8, 8, [](const V& n) { return 1.0 + n.x * n.x - n.y * n.y; }, pi / std::sqrt(15.0 / pi)}};
    for (const auto& one : cases) {
        Builder builder = cubeOf(16, [&](const V& n) { return V(one.light(n)); });
        const double whole = std::hypot(pi / constant, one.irradiance);
        for (const double share : {0.0495, 0.0505}) {
            std::vector<std::array<double, 3>> irradiance(9);
            irradiance[0].fill(pi / constant);
            irradiance[one.second].fill(one.irradiance);
            for (double& number : irradiance[one.changed]) number += share * whole;
            lightOf(builder)["irradianceCoefficients"] = irradiance;
            EXPECT_EQ(builder.import().notes.size(), share > 0.05 ? 1u : 0u) << one.changed << ", " << share;
        }
    }
}

TEST(GltfEnvironment, onlyTheLightOfTheShownSceneIsRead) {
    Builder builder = cubeOf(2, byDirection);
    builder.json["scenes"][0].erase("extensions");
    EXPECT_FALSE(builder.import().environment);
    builder.json["extensionsRequired"] = {"EXT_lights_image_based"};
    EXPECT_EQ(builder.error(), "");
}

TEST(GltfEnvironment, filteredLevelsAreNotRead) {
    Builder builder = cubeOf(2, byDirection);
    builder.json["images"].push_back({{"uri", "nowhere.png"}});
    lightOf(builder)["specularImages"].push_back(std::vector<int>(6, 6));
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.environment);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfEnvironment, brokenOnesAreRefusedByPlace) {
    const auto errorOf = [](const char* key, const Json& value) {
        Builder builder = cubeOf(1, byDirection);
        lightOf(builder)[key] = value;
        return builder.error();
    };
    for (const auto& [key, value, error] :
         {std::tuple("specularImages", "[[0, 1, 2, 3, 4]]",
                     "/specularImages: must hold 6 faces of a cube in each element, but one holds 5"),
          {"specularImages", "[]", "/specularImages: is empty; the six faces of a cube are needed"},
          {"specularImages", "[[0, 1, 2, 3, 4, 9]]", "points at /images/9"},
          {"irradianceCoefficients", "[[1, 1, 1]]", "/irradianceCoefficients: must hold 9 colours, but holds 1"},
          {"rotation", "[0, 0, 0, 0]", "/rotation: is the zero quaternion, which is no rotation"},
          {"intensity", "-1", "/intensity: is -1; it must be at least 0"},
          {"specularImageSize", "0", "/specularImageSize: is 0; it must be at least 1"}})
        EXPECT_THAT(errorOf(key, Json::parse(value)), HasSubstr(error));
    Builder builder = cubeOf(1, byDirection);
    builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
    EXPECT_THAT(builder.error(), HasSubstr("points at /extensions/EXT_lights_image_based/lights/1"));
}

TEST(GltfEnvironment, aModelLightsASceneThatNamesIt) {
    Builder builder = cubeOf(4, byDirection);
    lightOf(builder)["intensity"] = 3.0;
    const auto file = builder.folder.write("model.gltf", builder.json.dump());
    LoadOptions options = loading(&LoadOptions::environment, file.string());
    const Scene scene = loadScene("spheres", options);
    EXPECT_EQ(scene.environment.value().source, file.string());
    EXPECT_EQ(scene.environment->intensity, 3.0f);
    EXPECT_EQ(scene.environment->map.width, 16);
    // Without a requested environment the model's is used, and no studio is supplied.
    EXPECT_EQ(loadScene(file.string(), {}).environment.value().source, file.string());
    // Scene files take the intensity too, unless they state one.
    const auto loaded = [&](const char* how) {
        return loadScene(builder.folder.file("scene.json",
                                             std::string(R"({"tessera": 1, "environment": {"map": "model.gltf")") +
                                                 how + "}}"))
            .environment.value()
            .intensity;
    };
    EXPECT_EQ(loaded(""), 3.0f);
    EXPECT_EQ(loaded(R"(, "intensity": 0.5)"), 0.5f);
    lightOf(builder)["intensity"] = 1e38;
    LoadLedger ledger;
    std::vector<std::string> warnings;
    const std::string bright = builder.folder.file("bright.gltf", builder.json.dump());
    // as the window calls it, without a scene
    EXPECT_THAT(inputErrorOf([&] { environmentCalled(bright, ledger, warnings); }),
                HasSubstr("at most 1e+30 can be shown"));
    builder.json["scenes"][0].erase("extensions");
    options.environment = builder.folder.file("dark.gltf", builder.json.dump());
    EXPECT_THAT(inputErrorOf([&] { loadScene("spheres", options); }),
                HasSubstr("dark.gltf: its scene has no light of EXT_lights_image_based"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
