// Packed area lights: their surfaces, ranges and culling bounds.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "renderer/culling/LightLists.h"
#include "renderer/frame/CullLights.h"
#include "renderer/frame/LightBuffer.h"
#include "scenes/AreaLight.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"
#include "tests/unit/frame/Lights.h"

namespace tessera::frame {
namespace {

using scenes::LightType;
using test::kAreaTypes;
using test::pack;

/// An area light visible to the default camera, which looks along -z.
scenes::Light surfaceLight(LightType type) {
    scenes::Light light;
    light.type = type;
    light.positionWS = {0.0, 0.0, -5.0};
    light.radiusMetres = 0.5f;
    return light;
}

scenes::Light randomSurface(test::Random& random, LightType type) {
    scenes::Light light = surfaceLight(type);
    light.directionWS = random.direction();
    light.alongWS = random.around(light.directionWS, 0.0, 0.0);
    test::giveSizes(light, random, 0.1, 2.0);
    for (std::size_t i = 0; i < light.corners.count; ++i)
        light.corners.metres[i] *= glm::vec2(light.widthMetres, light.heightMetres) * float(random.between(0.5, 1.0));
    return light;
}

TEST(PackedAreaLights, aFlatSurfaceReachesByTwoVectorsWhoseProductPointsWhereItShines) {
    scenes::Light panel = surfaceLight(LightType::Rectangle);
    panel.widthMetres = 3.0f;
    panel.heightMetres = 0.5f;
    panel.color = {1.0f, 0.5f, 0.25f};
    panel.intensity = 8.0f;
    const PackedLights lights = pack({panel});
    EXPECT_EQ(lights.texels.at(0).position, glm::vec4(0, 0, -5, 0)); // no range: 1/range^2 is 0
    EXPECT_EQ(lights.texels.at(0).color, glm::vec4(8, 4, 2, float(int(LightType::Rectangle))));
    EXPECT_EQ(lights.shapes.at(0).axis, glm::vec4(1.5f, 0, 0, 0));
    EXPECT_EQ(lights.shapes.at(0).attenuation, glm::vec4(0, -0.25f, 0, 0));
    panel.isTwoSided = true;
    EXPECT_EQ(pack({panel}).shapes.at(0).attenuation, glm::vec4(0, -0.25f, 0, 1));

    test::Random random(6);
    for (int i = 0; i < 200; ++i) {
        const scenes::Light light = randomSurface(random, i % 2 == 0 ? LightType::Rectangle : LightType::Disk);
        const bool isDisk = light.type == LightType::Disk;
        const shared::LightShapeTexels shape = pack({light}).shapes.at(0);
        const glm::dvec3 axis(shape.axis), across(shape.attenuation);
        const double a = isDisk ? double(light.radiusMetres) : 0.5 * double(light.widthMetres);
        const double b = isDisk ? double(light.radiusMetres) : 0.5 * double(light.heightMetres);
        // Rounding of fp32.
        EXPECT_NEAR(glm::length(axis), a, 2e-7 * a);
        EXPECT_NEAR(glm::length(across), b, 2e-7 * b);
        EXPECT_LT(glm::distance(glm::cross(axis, across) / (a * b), light.directionWS), 4e-7);
        if (!isDisk) {
            EXPECT_LT(glm::distance(axis / a, light.alongWS), 2e-7);
        }
    }
}

TEST(PackedAreaLights, aSphereHasARadiusAndATubeHalfOfItselfToo) {
    EXPECT_EQ(pack({surfaceLight(LightType::Sphere)}).shapes.at(0).axis, glm::vec4(0, 0, 0, 0.5f));
    scenes::Light tube = surfaceLight(LightType::Tube);
    tube.lengthMetres = 3.0f;
    tube.directionWS = {0.0, 1.0, 0.0};
    const PackedLights lights = pack({tube});
    EXPECT_EQ(lights.shapes.at(0).axis, glm::vec4(0, 1.5f, 0, 0.5f));
    EXPECT_TRUE(lights.features.areaLights());
    EXPECT_TRUE(lights.features[LightType::Tube]);
    EXPECT_FALSE(lights.features[LightType::Sphere]);
    EXPECT_FLOAT_EQ(lights.shadows.at(0).shadow.x, float(std::sqrt((3.0 + test::pi * 0.25) / test::pi)));
}

TEST(PackedAreaLights, aPolygonHasItsCornersInPartsOfTheFarthestAndCounterclockwise) {
    scenes::Light light = surfaceLight(LightType::Polygon);
    light.corners = test::cornersOf({{0, 0}, {0, 2}, {1, 0.5f}, {1.5f, 0}}); // clockwise
    PackedLights lights = pack({light, surfaceLight(LightType::Disk)});
    ASSERT_EQ(lights.corners.size(), 2u);
    EXPECT_EQ(glm::vec3(lights.shapes[0].axis), glm::vec3(2, 0, 0));
    EXPECT_EQ(lights.shapes[0].attenuation, glm::vec4(0, -2, 0, 0));
    EXPECT_FLOAT_EQ(lights.shapes[0].axis.w, float(scenes::largestSeenArea(light) / 4.0));
    const shared::LightCornerTexels& corners = lights.corners[0];
    EXPECT_EQ(corners.outline.z, 4.0f);
    EXPECT_LT(glm::distance(glm::dvec2(corners.outline), scenes::middleOf(light.corners) / 2.0), 1e-7);
    EXPECT_EQ(corners.corners[0], glm::vec4(0.75f, 0.0f, 0.5f, 0.25f));
    EXPECT_EQ(corners.corners[1], glm::vec4(0.0f, 1.0f, 0.0f, 0.0f));
    // The reflex corner is in both triangles.
    EXPECT_GT(corners.shareEnds.x, 0.0f);
    EXPECT_LT(corners.shareEnds.x, 1.0f);
    EXPECT_EQ(corners.shareEnds.y, 1.0f);
    const auto numbers = int(corners.lastEnd.y);
    for (const int triangle : {numbers & 511, numbers >> 9})
        EXPECT_TRUE((triangle & 7) == 1 || (triangle >> 3 & 7) == 1 || (triangle >> 6) == 1) << triangle;
    EXPECT_EQ(lights.corners[1].outline, glm::vec4(0.0f)) << "a disk has none";
    const std::size_t with = texelsOf(lights, lights.features).size();
    EXPECT_EQ(with, 2 * std::size_t(LIGHT_TEXELS + LIGHT_SHAPE_TEXELS + LIGHT_CORNER_TEXELS));
    EXPECT_EQ(with * sizeof(glm::vec4), lightBytes(lights.features, 2));
    lights = pack({surfaceLight(LightType::Disk)});
    EXPECT_TRUE(lights.corners.empty());
    EXPECT_EQ(texelsOf(lights, lights.features).size(), std::size_t(LIGHT_TEXELS + LIGHT_SHAPE_TEXELS))
        << "scenes without polygons pay nothing for corners";
}

TEST(PackedAreaLights, inViewSpaceTheSurfaceIsTurnedWithTheView) {
    scenes::Camera camera; // looks along +x: view (x, y, -z) is world (z, y, x)
    camera.worldFromCamera = glm::dmat4(0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1);
    scenes::Light light = surfaceLight(LightType::Rectangle);
    light.positionWS = {5.0, 0.0, 0.0};
    light.directionWS = {-1.0, 0.0, 0.0};
    light.alongWS = {0.0, 1.0, 0.0};
    FrameSettings settings;
    settings.space = LightingSpace::View;
    const PackedLights turned = pack({light}, settings, camera);
    EXPECT_EQ(turned.texels.at(0).position, glm::vec4(0, 0, -5, 0));
    EXPECT_EQ(turned.shapes.at(0).axis, glm::vec4(0, 0.5f, 0, 0));
    EXPECT_EQ(turned.shapes.at(0).attenuation, glm::vec4(-0.5f, 0, 0, 0));
}

TEST(PackedAreaLights, aLightWithoutASurfaceIsDarkAndLeftOut) {
    std::vector<scenes::Light> lights;
    for (const LightType type : kAreaTypes) {
        scenes::Light& light = lights.emplace_back(surfaceLight(type));
        light.radiusMetres = light.widthMetres = 0.0f;
        for (glm::vec2& corner : light.corners.metres) corner *= 1e-7f;
        lights.emplace_back(surfaceLight(type)).intensity = 0.0f;
    }
    lights.push_back(surfaceLight(LightType::Sphere));
    const PackedLights pruned = pack(lights);
    EXPECT_EQ(pruned.dark, 10u);
    EXPECT_THAT(pruned.sceneIndex, testing::ElementsAre(10));
    FrameSettings keep;
    keep.prune = false;
    const PackedLights whole = pack(lights, keep);
    ASSERT_EQ(whole.texels.size(), 11u);
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_EQ(glm::vec3(whole.texels[i].color), glm::vec3(0.0f)) << "dark lights add exactly 0";
}

TEST(PackedAreaLights, theirSurfaceLiesInTheBallThatCullingTakesThemFor) {
    test::Random random(7);
    for (const LightType type : kAreaTypes) {
        for (int i = 0; i < 50; ++i) {
            const scenes::Light light = randomSurface(random, type);
            const bool isRound = type != LightType::Rectangle && type != LightType::Polygon;
            const double exact = scenes::surfaceReachMetres(light) * double(isRound ? AREA_OUTLINE_REACH : 1.0f);
            EXPECT_NEAR(surfaceReachMetres(type, pack({light}).shapes.at(0)), exact, 3e-7 * exact);
        }
    }
    EXPECT_EQ(surfaceReachMetres(LightType::Spot, pack({surfaceLight(LightType::Spot)}).shapes.at(0)), 0.0f);
}

TEST(AreaLightReach, isItsRangeOrWhereItCanCauseNoMoreThanTheTolerance) {
    scenes::Light panel = surfaceLight(LightType::Rectangle);
    panel.widthMetres = 3.0f;
    panel.heightMetres = 4.0f;
    panel.color = {0.25f, 0.5f, 0.125f};
    panel.intensity = 6.0f;
    EXPECT_EQ(reachMetres(panel, 0.0), scenes::kInfinity);
    // The bounding sphere's radius is 2.5 m; 3 cd/m^2 from 12 m^2 cause 1/4 lx at 12 m from it.
    EXPECT_DOUBLE_EQ(reachMetres(panel, 0.25), 14.5);
    panel.rangeMetres = 7.0f;
    EXPECT_EQ(reachMetres(panel, 0.25), 7.0);
    EXPECT_FALSE(mayBeTruncated(panel));
    panel.heightMetres = 0.0f;
    EXPECT_EQ(reachMetres(panel, 0.0), 0.0);
    for (const LightType type : kAreaTypes) {
        scenes::Light light = surfaceLight(type);
        EXPECT_TRUE(mayBeTruncated(light));
        double last = scenes::kInfinity;
        for (double tolerance = 1e-9; tolerance < 1e6; tolerance *= 10.0) {
            const double reach = reachMetres(light, tolerance), beyond = reach - scenes::surfaceReachMetres(light);
            EXPECT_LT(reach, last);
            EXPECT_NEAR(scenes::largestSeenArea(light) / (beyond * beyond), tolerance, 1e-6 * tolerance);
            last = reach;
        }
        light.intensity = 1e30f;
        light.color = glm::vec3(1e8f);
        EXPECT_EQ(reachMetres(light, std::numeric_limits<double>::denorm_min()), scenes::kInfinity);
    }
}

TEST(AreaLightReach, aToleranceCountsThemAsEnded) {
    scenes::Light black = surfaceLight(LightType::Sphere), none = black, ranged = black;
    black.intensity = 0.0f;
    none.radiusMetres = 0.0f;
    ranged.rangeMetres = 2.0f;
    const std::vector<scenes::Light> lights{black, none, ranged, surfaceLight(LightType::Disk)};
    EXPECT_EQ(pack(lights).truncated.endless, 1u);
    EXPECT_EQ(pack(lights).truncated.sum(), 1u);
    EXPECT_EQ(pack(lights).everywhere, 1u);
    FrameSettings settings;
    settings.rangeTolerance = test::pi * 0.25 / 16.0; // 4 m from the disk's bounding sphere
    const PackedLights ended = pack(lights, settings);
    EXPECT_EQ(ended.truncated.ended, 1u);
    EXPECT_NEAR(ended.truncated.longestMetres, 4.5, 1e-12);
    EXPECT_EQ(ended.everywhere, 0u);
    EXPECT_NEAR(ended.texels.back().position.w, 1.0f / (4.5f * 4.5f), 1e-7f);
    EXPECT_EQ(ended.texels.back().position.w, pack({lights.back()}, settings).texels.at(0).position.w);
}

/// A wall of 16x16 pixels with random normals, 5 m ahead of the camera; one tile.
class WallOfNormals {
public:
    explicit WallOfNormals(test::Random& random) {
        camera_.projection = scenes::Projection::Orthographic;
        camera_.nearMetres = 0.0;
        camera_.farMetres = 10.0;
        camera_.halfHeightMetres = 1.0;
        const glm::dvec3 middle = random.direction();
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                depth_.push_back(float(random.between(0.48, 0.52)));
                normals_.push_back(glm::vec3(random.around(middle, 0.99, 1.0)));
                positions_.emplace_back((x + 0.5) * 2.0 / kSide - 1.0, (y + 0.5) * 2.0 / kSide - 1.0,
                                        -10.0 * (1.0 - double(depth_.back())));
                const glm::vec3 normal = normals_.back();
                for (const float part : {normal.x, normal.y, normal.z})
                    words_.push_back(std::bit_cast<std::uint32_t>(part));
            }
        }
    }

    /// Scene indices of the lights in the tile's list.
    std::vector<int> listed(const std::vector<scenes::Light>& lights, culling::NormalTest test) const {
        scenes::Scene scene;
        scene.lights = lights;
        FrameSettings settings;
        settings.prune = false;
        const CameraView view = makeCameraView(camera_, glm::ivec2(kSide), LightingSpace::World, glm::vec3(0.0f));
        const PackedLights packed = packLights(scene, view, settings);
        const std::vector<shared::CullLight> culls = cullLights(packed, view);
        shared::LightingConstants lighting{};
        culling::setTileGrid(lighting, view.constants, kSide);
        culling::BuildInput input{
            {view.constants, lighting}, culls, culling::Method::TileMinmax, {depth_, false}, {}, test, {}};
        input.readNormals = [&] {
            // Culling space has +z ahead.
            return culling::NormalPicture{
                words_, 3, {culling::NormalForm::Vector, 0, 0}, glm::mat3(1, 0, 0, 0, 1, 0, 0, 0, -1)};
        };
        culling::LightListBuilder builder;
        const culling::LightLists& lists = builder.build(input);
        std::vector<int> indices;
        const glm::uvec4 words = lists.tiles.at(0).words;
        for (std::uint32_t i = 0; i < words.w; ++i) indices.push_back(packed.sceneIndex[lists.entries.at(words.z + i)]);
        return indices;
    }

    /// Returns whether a part of the light's bounding sphere is in front of a pixel's surface, within range and on the
    /// light's emitting side.
    bool mayLight(const scenes::Light& light) const {
        const bool hasFront = scenes::infoOf(light.type).isFlat && !light.isTwoSided;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const glm::dvec3 toLight = light.positionWS - positions_[i];
            if (hasFront && glm::dot(toLight, light.directionWS) >= 0.0) continue;
            if (glm::length(toLight) < double(light.rangeMetres) &&
                glm::dot(toLight, glm::dvec3(normals_[i])) + scenes::surfaceReachMetres(light) > 0.0)
                return true;
        }
        return false;
    }

private:
    static constexpr int kSide = 16;
    scenes::Camera camera_;
    std::vector<float> depth_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> words_;
};

TEST(AreaLightCulling, aListByNormalsNeverLacksALightThatHasAPartInFrontOfASurface) {
    test::Random random(9);
    std::size_t behind = 0, saved = 0; // needed lights whose centre is behind the surface; culled lights
    for (int turn = 0; turn < 20; ++turn) {
        const WallOfNormals wall(random);
        std::vector<scenes::Light> lights;
        for (int i = 0; i < 300; ++i) {
            scenes::Light& light =
                lights.emplace_back(randomSurface(random, kAreaTypes[random.index(int(kAreaTypes.size()))]));
            light.positionWS = glm::dvec3(0.0, 0.0, -5.0) + random.direction() * random.between(0.0, 5.0);
            light.rangeMetres = float(random.between(1.0, 8.0));
        }
        const std::vector<int> listed = wall.listed(lights, culling::NormalTest::On);
        const std::vector<int> all = wall.listed(lights, culling::NormalTest::Off);
        saved += all.size() - listed.size();
        for (int i = 0; i < int(lights.size()); ++i) {
            scenes::Light middle = lights[std::size_t(i)];
            const bool isNeeded = wall.mayLight(middle);
            middle.type = LightType::Point;
            if (isNeeded && !wall.mayLight(middle)) ++behind;
            EXPECT_TRUE(!isNeeded || std::binary_search(listed.begin(), listed.end(), i)) << turn << ", light " << i;
        }
    }
    EXPECT_GT(behind, 100u);
    EXPECT_GT(saved, 100u);
}

} // namespace
} // namespace tessera::frame
