// Contents and lights of each built-in scene, as documented.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "scenes/AreaLight.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/hall/Lights.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"
#include "scenes/builtin/lamps/Lights.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"

namespace tessera::scenes {
namespace {

using test::withLights;
using test::withoutAssets;

/// The total power of the hall's point lights: the sum of colour times intensity.
double power(int count) {
    Scene scene;
    builtin::hall::addPointLights(scene, count);
    double sum = 0.0;
    for (const Light& light : scene.lights) sum += light.intensity * (light.color.x + light.color.y + light.color.z);
    return sum;
}

void expectWithin(const Box3& boundsWS, const Light& light) {
    EXPECT_TRUE(glm::all(glm::greaterThan(light.positionWS, boundsWS.min))) << light.name;
    EXPECT_TRUE(glm::all(glm::lessThan(light.positionWS, boundsWS.max))) << light.name;
}

TEST(Hall, hasItsStatedSizeAndLights) {
    const Scene scene = underLedger(builtin::makeHall, withoutAssets());
    EXPECT_GE(triangleCount(scene), 200000u);
    EXPECT_GE(scene.materials.size(), 8u);
    EXPECT_GE(scene.cameras.size(), 3u);
    const Box3 boundsWS = worldBounds(scene);
    EXPECT_NEAR(boundsWS.min.z, -23.0, 1e-5) << "20 m to the end wall, an apse of 3 m";
    EXPECT_NEAR(boundsWS.max.x - boundsWS.min.x, 17.6, 1e-5) << "16 m from wall to wall, a niche of 0.8 m on each side";
    EXPECT_EQ(boundsWS.min.y, 0.0);
    ASSERT_EQ(scene.lights.size(), 258u) << "lamps, the sky and the sun";
    EXPECT_EQ(scene.lights[256].type, LightType::Directional);
    EXPECT_FALSE(scene.lights[256].castsShadow) << "the sky is everywhere";
    EXPECT_EQ(scene.lights[257].type, LightType::Directional);
    EXPECT_TRUE(scene.lights[257].castsShadow);
    EXPECT_EQ(std::ranges::count(scene.lights, true, &Light::castsShadow), 17) << "the sun and 16 lamps";
    for (std::size_t i = 0; i < 256; ++i) {
        const Light& light = scene.lights[i];
        EXPECT_EQ(light.type, LightType::Point);
        EXPECT_GE(light.rangeMetres, 2.0f);
        EXPECT_LE(light.rangeMetres, 5.0f);
        expectWithin(boundsWS, light);
    }
}

/// Counts the triangles at each edge of an arch's round head, by the edge's ends to a tenth of a millimetre.
std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int>
edgesOfHead(const std::vector<Mesh>& meshes, int axis, double plane, const glm::dvec3& middle, double radius) {
    std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
    for (const Mesh& mesh : meshes) {
        const auto isOnHead = [&](std::uint32_t vertex) {
            const glm::dvec3 place(mesh.positionsOS[vertex]);
            return std::abs(place[axis] - plane) < 1e-4 && place.y > middle.y - 1e-4 &&
                   std::abs(glm::distance(place, middle) - radius) < 1e-4;
        };
        const auto rounded = [&](std::uint32_t vertex) {
            const glm::dvec3 place(mesh.positionsOS[vertex]);
            return std::array{std::lround(1e4 * place.x), std::lround(1e4 * place.y), std::lround(1e4 * place.z)};
        };
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::uint32_t from = mesh.indices[i], to = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
            if (isOnHead(from) && isOnHead(to)) ++edges[std::minmax(rounded(from), rounded(to))];
        }
    }
    return edges;
}

// Earlier, sunlight leaked through gaps between them in dots.
TEST(Hall, alcovesMeetTheWallsBeforeThem) {
    using namespace builtin::hall;
    const auto expectShared = [](const auto& edges, std::size_t count) {
        EXPECT_EQ(edges.size(), count);
        for (const auto& [edge, triangles] : edges) EXPECT_EQ(triangles, 2);
    };
    expectShared(edgesOfHead({bayWalls()}, 0, -kAisleOuterX, {-kAisleOuterX, kNicheSpringY, 0.0}, kNicheRadius), 20);
    expectShared(edgesOfHead({endWalls(), apse()}, 2, -kHalfLength, {0.0, kApseSpringY, -kHalfLength}, kApseRadius),
                 40);
}

TEST(Hall, brightnessNeverDependsOnTheNumberOfLights) {
    const double usual = power(256);
    // 64 lights may be four times as strong; their places have different strengths.
    EXPECT_NEAR(power(64), usual, 0.2 * usual);
    EXPECT_NEAR(power(1000), usual, 0.05 * usual);
    // 65,536 roundings of an intensity to single precision.
    EXPECT_NEAR(power(65536), usual, 1e-5 * usual);
}

TEST(Hall, requestedNumberOfLightsIsExactlyMade) {
    for (const int count : {0, 1, 255, 257, 4097, 65536}) {
        Scene scene;
        builtin::hall::addPointLights(scene, count);
        EXPECT_EQ(scene.lights.size(), std::size_t(count));
        EXPECT_NO_THROW(checkScene(scene));
    }
    EXPECT_EQ(underLedger(builtin::makeHall, withLights(3)).lights.size(), 5u) << "and the sky and the sun";
}

TEST(Lamps, areAThousandRectanglesThatEndWithinTheHall) {
    const Scene scene = underLedger(builtin::makeLamps, withoutAssets());
    EXPECT_LE(triangleCount(scene), 60000u);
    EXPECT_GE(scene.cameras.size(), 3u);
    ASSERT_EQ(scene.lights.size(), 1000u);
    const Box3 boundsWS = worldBounds(scene);
    std::set<float> ranges;
    for (const Light& light : scene.lights) {
        EXPECT_EQ(light.type, LightType::Rectangle);
        EXPECT_TRUE(hasSurface(light)) << light.name;
        EXPECT_GT(light.rangeMetres, surfaceReachMetres(light)) << light.name << " ends before its own corners";
        EXPECT_LT(light.rangeMetres, 8.0f) << light.name;
        expectWithin(boundsWS, light);
        ranges.insert(light.rangeMetres);
    }
    EXPECT_GE(ranges.size(), 5u);
    EXPECT_EQ(std::ranges::count(scene.lights, true, &Light::isTwoSided), 96) << "the sheets over the nave alone";
}

TEST(Lamps, requestedNumberOfLightsIsExactlyMadeAndTheFirstAreSpreadOut) {
    for (const int count : {0, 1, 999, 1001, 4097}) {
        Scene scene;
        builtin::lamps::addLamps(scene, builtin::lamps::lampPlaces(), count);
        EXPECT_EQ(scene.lights.size(), std::size_t(count));
        EXPECT_NO_THROW(checkScene(scene));
    }
    const Scene few = underLedger(builtin::makeLamps, withLights(40));
    ASSERT_EQ(few.lights.size(), 40u);
    for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0}) {
            const auto isThere = [&](const Light& light) {
                return side * light.positionWS.x > 0.0 && end * light.positionWS.z > 0.0;
            };
            EXPECT_GE(std::ranges::count_if(few.lights, isThere), 4) << side << ' ' << end;
        }
}

TEST(Lamps, whatIsSeenToShineNeverGetsItsOwnLight) {
    const std::vector<builtin::lamps::LampPlace> places = builtin::lamps::lampPlaces();
    for (const builtin::lamps::LampPlace& place : places) {
        const Mesh glow = builtin::lamps::glowingSurfaces({place}, place.lamp);
        ASSERT_EQ(glow.positionsOS.size(), place.light.isTwoSided ? 8u : 4u) << place.light.name;
        for (std::size_t i = 0; i < glow.positionsOS.size(); ++i) {
            const glm::dvec3 fromLight = glm::dvec3(glow.positionsOS[i]) - place.light.positionWS;
            const glm::dvec3 normal(glow.normalsOS[i]);
            // Either before a side and facing away, or behind a one-sided light. The threshold is half of the 5 mm
            // between them; rounding of a position 24 m away is 2e-6 m.
            const bool facesAway = glm::dot(normal, fromLight) > 0.0025;
            const bool isBehind = !place.light.isTwoSided && glm::dot(place.light.directionWS, fromLight) < -0.0025;
            EXPECT_TRUE(facesAway || isBehind) << place.light.name;
            // The glowing surface is as large as the light.
            EXPECT_NEAR(glm::length(fromLight), std::hypot(surfaceReachMetres(place.light), 0.005), 1e-5);
        }
    }
}

TEST(Studio, showsEveryLayerUnderLightsOfEveryShapeButPolygons) {
    const Scene scene = underLedger(builtin::makeProductStudio, withoutAssets());
    // No lamp of a studio is a polygon, and one would give every light 112 bytes of corners (shaders/shared/light.h).
    for (const LightTypeInfo& type : lightTypes())
        EXPECT_EQ(type.isArea && type.type != LightType::Polygon,
                  std::ranges::count(scene.lights, type.type, &Light::type) > 0)
            << type.name;
    const auto key = std::ranges::find(scene.lights, "key", &Light::name);
    ASSERT_NE(key, scene.lights.end());
    EXPECT_TRUE(key->castsShadow);
    const auto some = [&](auto holds) { return std::ranges::any_of(scene.materials, holds); };
    EXPECT_TRUE(some([](const Material& m) { return m.clearcoat > 0.0f; }));
    EXPECT_TRUE(some([](const Material& m) { return m.sheenColor != glm::vec3(0.0f); }));
    EXPECT_TRUE(some([](const Material& m) { return m.anisotropyStrength > 0.0f; }));
    EXPECT_TRUE(some([](const Material& m) { return m.metallic == 1.0f && m.perceptualRoughness < 0.2f; }));
    EXPECT_TRUE(some([](const Material& m) { return m.metallic == 1.0f && m.perceptualRoughness > 0.4f; }));
    for (const Material& material : scene.materials)
        EXPECT_EQ(material.castsShadow, material.emissive == glm::vec3(0.0f)) << material.name;
    EXPECT_EQ(underLedger(builtin::makeProductStudio, withLights(2)).lights.size(), 2u);
}

TEST(Spheres, spanRoughnessAndMetalness) {
    const Scene scene = underLedger(builtin::makeSpheres, withoutAssets());
    EXPECT_EQ(std::ranges::count_if(scene.materials, [](const Material& m) { return m.name.starts_with("metalness"); }),
              55);
    EXPECT_EQ(scene.lights.size(), 4u);
    EXPECT_EQ(underLedger(builtin::makeSpheres, withLights(2)).lights.size(), 2u);
}

TEST(Models, showEveryModelMaskingAndLayerSomeOfThemTextured) {
    const Scene scene = underLedger(builtin::makeModels, withoutAssets());
    std::set<MaterialModel> models;
    std::set<Masking> maskings;
    std::set<std::size_t> slots;
    bool anisotropic = false, coated = false, cloth = false;
    for (const Material& material : scene.materials) {
        models.insert(material.model);
        maskings.insert(material.masking);
        anisotropic = anisotropic || material.anisotropyStrength > 0.0f;
        coated = coated || material.clearcoat > 0.0f;
        cloth = cloth || material.sheenColor != glm::vec3(0.0f);
        for (std::size_t slot = 0; slot < kTextureSlotCount; ++slot)
            if (material.textures[slot].image != kNone) slots.insert(slot);
    }
    EXPECT_EQ(models.size(), 6u);
    EXPECT_EQ(maskings.size(), 3u);
    EXPECT_TRUE(anisotropic && coated && cloth);
    EXPECT_GE(scene.materials.size(), 12u);
    EXPECT_GE(slots.size(), 7u);
    std::set<LightType> lights;
    for (const Light& light : scene.lights) lights.insert(light.type);
    EXPECT_EQ(lights.size(), 3u);
    EXPECT_EQ(underLedger(builtin::makeModels, withLights(2)).lights.size(), 2u);
}

TEST(Head, generatedBustHasObjectSpaceNormals) {
    const Scene scene = underLedger(builtin::makeHead, withoutAssets());
    const auto bust = std::ranges::find_if(
        scene.materials, [](const Material& m) { return m.texture(TextureSlot::Normal).image != kNone; });
    ASSERT_NE(bust, scene.materials.end());
    EXPECT_EQ(bust->model, MaterialModel::Microfacet);
    EXPECT_EQ(bust->normalMapSpace, NormalMapSpace::Object);
    EXPECT_FLOAT_EQ(bust->ior, 1.4f);
    EXPECT_GE(scene.lights.size(), 3u);
    const auto mesh = std::ranges::find(scene.meshes, "bust", &Mesh::name);
    ASSERT_NE(mesh, scene.meshes.end());
    EXPECT_GE(mesh->indices.size() / 3, 20000u);
    EXPECT_LE(mesh->indices.size() / 3, 40000u);
}

TEST(Head, objectSpaceNormalsAgreeWithTheMeshTheyRefine) {
    const Scene scene = underLedger(builtin::makeHead, withoutAssets());
    const auto bust = std::ranges::find(scene.meshes, "bust", &Mesh::name);
    const auto map = std::ranges::find(scene.images, "bust normals", &Image::name);
    ASSERT_NE(bust, scene.meshes.end());
    ASSERT_NE(map, scene.images.end());
    double agreement = 0.0;
    for (std::size_t i = 0; i < bust->positionsOS.size(); ++i) {
        const glm::vec2 uv = bust->texCoords[0][i];
        const int x = std::min(int(uv.x * float(map->width)), map->width - 1);
        const int y = std::min(int(uv.y * float(map->height)), map->height - 1);
        std::uint16_t texel[4];
        std::memcpy(texel, map->texels.data() + 8 * (y * map->width + x), sizeof(texel));
        const glm::dvec3 n = glm::dvec3(texel[0], texel[1], texel[2]) / 65535.0 * 2.0 - 1.0;
        EXPECT_NEAR(glm::length(n), 1.0, 1e-4); // 16 bits per component
        agreement += glm::dot(n, glm::dvec3(bust->normalsOS[i]));
    }
    agreement /= double(bust->positionsOS.size());
    EXPECT_GT(agreement, 0.9) << "relief turns normals by some degrees";
    EXPECT_LT(agreement, 0.9999) << "but relief there is";
}

} // namespace
} // namespace tessera::scenes
