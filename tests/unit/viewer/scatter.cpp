#include "viewer/edit/Scatter.h"

#include <set>

#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "viewer/edit/Surfaces.h"

namespace tessera::viewer {
namespace {

double luminance(const glm::vec3& color) {
    return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

/// A floor of 20 x 20 m at y = 0 that faces up, with a ceiling that faces down if `ceilingMetres` is above 0.
scenes::Scene floorScene(float ceilingMetres = 0.0f) {
    scenes::Scene scene;
    scene.materials.emplace_back();
    scenes::Mesh& mesh = scene.meshes.emplace_back();
    mesh.positionsOS = {{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}};
    mesh.normalsOS.assign(4, {0, 1, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.nodes.emplace_back().instances.push_back({0, 0});
    if (ceilingMetres > 0.0f) {
        scenes::Node& ceiling = scene.nodes.emplace_back(scene.nodes.front());
        ceiling.parentFromNode = glm::dmat4(glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1));
        ceiling.parentFromNode[3] = glm::dvec4(0, ceilingMetres, 0, 1);
    }
    return scene;
}

TEST(Scatter, theSameSeedIsTheSameLightsAndAnotherNeverIs) {
    const scenes::Scene scene = scenes::loadScene("room");
    const Scatter scatter{.count = 50};
    EXPECT_TRUE(scatterLights(scene, scatter) == scatterLights(scene, scatter));
    EXPECT_FALSE(scatterLights(scene, scatter) == scatterLights(scene, {.count = 50, .seed = 2}));
}

TEST(Scatter, everyLightIsInsideTheBoundsOfEveryBuiltinScene) {
    for (const char* name : {"hall", "spheres", "models", "lattice", "room"}) {
        scenes::Scene scene = scenes::loadScene(name);
        const scenes::Box3 boundsWS = scenes::worldBounds(scene);
        scene.lights = scatterLights(scene, {.count = 300});
        ASSERT_EQ(scene.lights.size(), 300u);
        std::set<std::string> names;
        for (const scenes::Light& light : scene.lights) {
            EXPECT_EQ(glm::clamp(light.positionWS, boundsWS.min, boundsWS.max), light.positionWS) << name;
            names.insert(light.name);
        }
        EXPECT_EQ(names.size(), 300u);
        EXPECT_NO_THROW(scenes::checkScene(scene));
    }
}

TEST(Scatter, lightsAreAboveTheSurfaceAndBelowACeiling) {
    const scenes::Scene scene = floorScene(0.2f);
    for (const scenes::Light& light : scatterLights(scene, {.count = 200})) {
        EXPECT_GT(light.positionWS.y, 0.03);
        EXPECT_LT(light.positionWS.y, 0.17) << "four fifths of the way, at most";
        const double nearMetres = std::min(light.positionWS.y, 0.2 - light.positionWS.y);
        EXPECT_LT(double(light.intensity) / (nearMetres * nearMetres), 10.0) << "it burns what is near";
    }
}

/// Mean over the middle of the floor, whose edges lack neighbours.
template <typename Value>
double meanOverFloor(const std::vector<scenes::Light>& lights, Value value) {
    double sum = 0.0;
    int points = 0;
    for (double x = -5.0; x <= 5.0; x += 0.5)
        for (double z = -5.0; z <= 5.0; z += 0.5, ++points)
            for (const scenes::Light& light : lights) {
                const glm::dvec3 toLight = light.positionWS - glm::dvec3(x, 0.0, z);
                const double d = glm::length(toLight);
                if (d < double(light.rangeMetres)) sum += value(light, toLight, d);
            }
    return sum / points;
}

TEST(Scatter, aboutAsManyLightsAsRequestedReachAPointWhateverTheirNumber) {
    scenes::Scene scene = floorScene();
    scenes::Node& above = scene.nodes.emplace_back(scene.nodes.front());
    above.parentFromNode = glm::dmat4(glm::dmat3(1e-3, 0, 0, 0, -1e-3, 0, 0, 0, -1e-3)); // space, hardly a surface
    above.parentFromNode[3] = glm::dvec4(9.0, 15.0, 9.0, 1.0);
    for (const int count : {500, 4000}) {
        for (const double wanted : {4.0, 12.0}) {
            const std::vector<scenes::Light> lights = scatterLights(scene, {.count = count, .lightsPerPoint = wanted});
            const double mean = meanOverFloor(lights, [](const auto&, const auto&, double) { return 1.0; });
            // A quarter of 500 lights is over the points: their number varies by 9 percent, that of 4000 lights by 3
            // percent.
            EXPECT_NEAR(mean, wanted, (count < 1000 ? 0.25 : 0.1) * wanted) << count;
            const double lux =
                meanOverFloor(lights, [](const scenes::Light& light, const glm::dvec3& toLight, double d) {
                    const double window = 1.0 - std::pow(d / double(light.rangeMetres), 4.0);
                    return double(light.intensity) * window * window * (toLight.y / d) / (d * d);
                });
            // Edges of the floor are darker and are included.
            EXPECT_NEAR(lux, 0.5, 0.1) << count;
        }
    }
}

TEST(Scatter, surfacesOfEveryBuiltinSceneAreAsBrightAndHardlyAnyBurns) {
    for (const char* name : {"hall", "spheres", "models", "lattice", "room"}) {
        const scenes::Scene scene = scenes::loadScene(name);
        const std::vector<scenes::Light> lights = scatterLights(scene, {.count = 300});
        const Surfaces surfaces(scene);
        double sum = 0.0;
        int burnt = 0;
        constexpr int kPlaces = 1000;
        for (int i = 0; i < kPlaces; ++i) {
            // An additive sequence: Roberts 2018.
            const glm::dvec3 at = glm::fract((i + 0.5) * glm::dvec3(0.8191725, 0.6710436, 0.5497005));
            const Surfaces::Place place = surfaces.at(at.x, at.y, at.z);
            glm::dvec3 radiance(0.0); // reflected by a white surface
            for (const scenes::Light& light : lights) {
                const glm::dvec3 toLight = light.positionWS - place.positionWS;
                const double d = glm::length(toLight), cosine = glm::dot(toLight, place.normalWS) / d;
                if (d >= double(light.rangeMetres) || cosine <= 0.0) continue;
                const double window = 1.0 - std::pow(d / double(light.rangeMetres), 4.0);
                radiance +=
                    glm::dvec3(light.color) * (double(light.intensity) * window * window * cosine / (d * d) / 3.14159);
            }
            sum += 3.14159 * luminance(radiance);
            burnt += glm::any(glm::greaterThan(radiance, glm::dvec3(1.0)));
        }
        EXPECT_GT(sum / kPlaces, 0.25) << name;
        EXPECT_LT(sum / kPlaces, 0.6) << name;
        EXPECT_LT(burnt, kPlaces / 25) << name;
    }
}

TEST(Scatter, coloursAreThoseOfLampsAndOfOneLuminance) {
    int warm = 0, cool = 0;
    for (const scenes::Light& light : scatterLights(floorScene(), {.count = 100})) {
        EXPECT_NEAR(luminance(light.color), 1.0, 1e-6);
        EXPECT_GE(light.color.r, light.color.g) << "no lamp is green";
        EXPECT_GE(light.color.g, 0.94f * light.color.b);
        warm += light.color.r > 3.0f * light.color.b;
        cool += light.color.r < 1.3f * light.color.b;
    }
    EXPECT_GT(warm, 40);
    EXPECT_GT(cool, 2);
    // Source: CIE standard illuminants A, of 2856 K, and (approximately) D65.
    const glm::vec3 bulb = lampColor(2856.0), day = lampColor(6500.0);
    EXPECT_NEAR(bulb.r, 1.845f, 0.03f);
    EXPECT_NEAR(bulb.g, 0.826f, 0.03f);
    EXPECT_NEAR(bulb.b, 0.233f, 0.03f);
    for (const int channel : {0, 1, 2}) EXPECT_NEAR(day[channel], 1.0f, 0.08f);
}

TEST(Scatter, rangesDifferAndWallsHaveLampsOfTheirOwn) {
    scenes::Scene scene = floorScene(8.0f);
    const double middle = 4.0;
    int above = 0;
    std::set<float> ranges;
    const std::vector<scenes::Light> lights = scatterLights(scene, {.count = 200});
    for (const scenes::Light& light : lights) {
        above += light.positionWS.y > middle;
        ranges.insert(light.rangeMetres);
    }
    EXPECT_NEAR(above, 100, 30) << "the ceiling is as large as the floor";
    EXPECT_GT(*ranges.rbegin(), 1.5f * *ranges.begin());
    // There are no lights below the floor, from where nothing is visible.
    for (const scenes::Light& light : lights) EXPECT_TRUE(light.positionWS.y > 0.0 && light.positionWS.y < 8.0);
}

TEST(Scatter, aSceneOfNothingGetsItsLightsAboutTheOrigin) {
    const std::vector<scenes::Light> lights = scatterLights(scenes::Scene(), {.count = 20});
    ASSERT_EQ(lights.size(), 20u);
    for (const scenes::Light& light : lights) EXPECT_LE(glm::length(light.positionWS), std::sqrt(3.0));
    EXPECT_TRUE(scatterLights(scenes::Scene(), {.count = 0}).empty());
}

TEST(Surfaces, placesAreAsLikelyOnAnySquareMetre) {
    scenes::Scene scene = floorScene();
    scene.meshes[0].positionsOS[1].x = -5.0f; // the first triangle is smaller than the second
    const Surfaces surfaces(scene);
    int first = 0;
    constexpr int kPlaces = 10000;
    for (int i = 0; i < kPlaces; ++i) {
        const Surfaces::Place place = surfaces.at((i + 0.5) / kPlaces, 0.3, 0.6);
        EXPECT_EQ(place.normalWS, glm::dvec3(0, 1, 0));
        first += (i + 0.5) / kPlaces * surfaces.areaSquareMetres() < 150.0;
    }
    EXPECT_DOUBLE_EQ(surfaces.areaSquareMetres(), 150.0 + 200.0);
    EXPECT_NEAR(double(first) / kPlaces, 150.0 / 350.0, 1e-3);
}

} // namespace
} // namespace tessera::viewer
