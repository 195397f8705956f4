#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <ostream>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/AreaLight.h"
#include "scenes/Limits.h"
#include "scenes/Load.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/hall/Lights.h"
#include "scenes/builtin/lamps/Lights.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/MeshRules.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {

/// How GoogleTest shows a scene in a test's name.
void PrintTo(const BuiltinScene& scene, std::ostream* out) {
    *out << scene.name;
}

namespace {

/// The generated scenes, never a scan that this machine may have.
LoadOptions withoutAssets() {
    LoadOptions options;
    options.useAssets = false;
    return options;
}

/// FNV-1a (Fowler, Noll, Vo) over everything a renderer reads.
class Digest {
public:
    template <typename T>
    void add(const std::vector<T>& values) {
        for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) {
            hash_ = (hash_ ^ reinterpret_cast<const unsigned char*>(values.data())[i]) * 1099511628211u;
        }
    }
    template <typename T>
    void add(const T& value) {
        add(std::vector<T>{value});
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

std::uint64_t digest(const Scene& scene) {
    Digest digest;
    for (const Image& image : scene.images) digest.add(image.texels);
    for (const Mesh& mesh : scene.meshes) {
        digest.add(mesh.positionsOS);
        digest.add(mesh.normalsOS);
        digest.add(mesh.texCoords[0]);
        digest.add(mesh.indices);
    }
    for (const Node& node : scene.nodes) {
        digest.add(node.parentFromNode);
        for (const MeshInstance& instance : node.instances) digest.add(glm::ivec2(instance.mesh, instance.material));
    }
    for (const Material& material : scene.materials) {
        digest.add(material.baseColor);
        digest.add(material.emissive);
        digest.add(glm::vec4(material.metallic, material.perceptualRoughness, material.alpha, material.ior));
        digest.add(glm::vec4(material.alphaY, material.exponent, material.anisotropyStrength, material.clearcoat));
        digest.add(material.sheenColor);
        digest.add(glm::vec4(material.attenuationColor, material.transmission));
        digest.add(glm::vec2(material.thicknessMetres, material.attenuationDistanceMetres));
    }
    for (const Light& light : scene.lights) {
        digest.add(light.positionWS);
        digest.add(light.directionWS);
        digest.add(glm::vec4(light.color, light.intensity));
        digest.add(light.rangeMetres);
        digest.add(light.alongWS);
        digest.add(glm::vec4(light.widthMetres, light.heightMetres, light.lengthMetres, light.radiusMetres));
    }
    for (const Camera& camera : scene.cameras) digest.add(camera.worldFromCamera);
    return digest.value();
}

void expectCamerasWithinReach(const Scene& scene) {
    const Box3 boundsWS = worldBounds(scene);
    const double radiusMetres = 0.5 * glm::length(boundsWS.max - boundsWS.min);
    for (const Camera& camera : scene.cameras) {
        const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
        EXPECT_LT(glm::distance(eyeWS, 0.5 * (boundsWS.min + boundsWS.max)), 1.5 * radiusMetres) << camera.name;
        EXPECT_GT(eyeWS.y, boundsWS.min.y) << camera.name;
    }
}

/// Everything stored is used by an instance, and textured meshes have the coordinates for it.
void expectAllUsed(const Scene& scene) {
    std::vector<bool> meshUsed(scene.meshes.size());
    std::vector<bool> materialUsed(scene.materials.size());
    std::vector<bool> imageUsed(scene.images.size());
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            meshUsed[static_cast<std::size_t>(instance.mesh)] = true;
            materialUsed[static_cast<std::size_t>(instance.material)] = true;
            for (const TextureUse& use : scene.materials[static_cast<std::size_t>(instance.material)].textures) {
                if (use.image == kNone) continue;
                imageUsed[static_cast<std::size_t>(use.image)] = true;
                EXPECT_EQ(mesh.texCoords[static_cast<std::size_t>(use.texCoordSet)].size(), mesh.positionsOS.size())
                    << mesh.name;
            }
        }
    }
    for (std::size_t i = 0; i < meshUsed.size(); ++i) EXPECT_TRUE(meshUsed[i]) << scene.meshes[i].name;
    for (std::size_t i = 0; i < materialUsed.size(); ++i) EXPECT_TRUE(materialUsed[i]) << scene.materials[i].name;
    for (std::size_t i = 0; i < imageUsed.size(); ++i) EXPECT_TRUE(imageUsed[i]) << scene.images[i].name;
}

class BuiltinScenes : public testing::TestWithParam<BuiltinScene> {};

TEST_P(BuiltinScenes, areAlwaysSoundAndFaceTheirNormals) {
    const Scene scene = underLedger(GetParam().make, withoutAssets());
    EXPECT_NO_THROW(checkScene(scene));
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_TRUE(scene.warnings.empty());
    expectCamerasWithinReach(scene);
    expectAllUsed(scene);
    for (const Mesh& mesh : scene.meshes) expectMeshRules(mesh);
}

TEST_P(BuiltinScenes, areAlwaysTheSameTwice) {
    EXPECT_EQ(digest(underLedger(GetParam().make, withoutAssets())),
              digest(underLedger(GetParam().make, withoutAssets())));
}

TEST_P(BuiltinScenes, areAlwaysChargedBeforeTheyAreMadeAndForNoLessThanTheyTake) {
    const BuiltinScene& builtin = GetParam();
    const std::uint64_t held = bytesOf(underLedger(builtin.make, withoutAssets()));
    EXPECT_LE(held, builtin.bytes) << sizeText(held);
    EXPECT_LE(builtin.bytes, std::max(std::uint64_t{1} << 20, 8 * held)) << sizeText(held) << ": refuses for nothing";
    LoadOptions options = withoutAssets();
    options.memoryLimitBytes = builtin.bytes - 1;
    EXPECT_EQ(
        test::inputErrorOf([&] { loadScene(std::string(builtin.name), options); }),
        fmt::format("{}: asks for {} of memory, and 0 B are in use; a load may take {}; use a smaller file, or raise "
                    "the memory limit",
                    builtin.name, sizeText(builtin.bytes), sizeText(builtin.bytes - 1)));
}

TEST(BuiltinMemory, lightsThatABuiltinSceneIsAskedForAreChargedBeforeTheyAreMade) {
    LoadOptions options;
    options.lights = kMostLights;
    options.memoryLimitBytes = builtinScene("lattice")->bytes + 1000;
    EXPECT_THAT(test::inputErrorOf([&] { loadScene("lattice", options); }), testing::StartsWith("lattice: asks for "));
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes, testing::ValuesIn(builtinScenes().begin(), builtinScenes().end()),
                         [](const auto& scene) { return std::string(scene.param.name); });

LoadOptions withLights(int count) {
    LoadOptions options = withoutAssets();
    options.lights = count;
    return options;
}

/// What the hall's point lights would shed in all: the sum of colour times intensity.
double power(int count) {
    Scene scene;
    builtin::hall::addPointLights(scene, count);
    double sum = 0.0;
    for (const Light& light : scene.lights) sum += light.intensity * (light.color.x + light.color.y + light.color.z);
    return sum;
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
        EXPECT_TRUE(glm::all(glm::greaterThan(light.positionWS, boundsWS.min))) << light.name;
        EXPECT_TRUE(glm::all(glm::lessThan(light.positionWS, boundsWS.max))) << light.name;
    }
}

TEST(Hall, brightnessNeverDependsOnTheNumberOfLights) {
    const double usual = power(256);
    // 64 lights may be four times as strong; they are spread over places of unlike strength.
    EXPECT_NEAR(power(64), usual, 0.2 * usual);
    EXPECT_NEAR(power(1000), usual, 0.05 * usual);
    // 65,536 roundings of an intensity to single precision.
    EXPECT_NEAR(power(65536), usual, 1e-5 * usual);
}

TEST(Hall, askedForNumberOfLightsIsExactlyMade) {
    for (const int count : {0, 1, 255, 257, 4097, 65536}) {
        Scene scene;
        builtin::hall::addPointLights(scene, count);
        EXPECT_EQ(scene.lights.size(), static_cast<std::size_t>(count));
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
        EXPECT_TRUE(glm::all(glm::greaterThan(light.positionWS, boundsWS.min))) << light.name;
        EXPECT_TRUE(glm::all(glm::lessThan(light.positionWS, boundsWS.max))) << light.name;
        ranges.insert(light.rangeMetres);
    }
    EXPECT_GE(ranges.size(), 5u);
    EXPECT_EQ(std::ranges::count(scene.lights, true, &Light::isTwoSided), 96) << "the sheets over the nave alone";
}

TEST(Lamps, askedForNumberOfLightsIsExactlyMadeAndTheFirstAreSpreadOut) {
    for (const int count : {0, 1, 999, 1001, 4097}) {
        Scene scene;
        builtin::lamps::addLamps(scene, builtin::lamps::lampPlaces(), count);
        EXPECT_EQ(scene.lights.size(), static_cast<std::size_t>(count));
        EXPECT_NO_THROW(checkScene(scene));
    }
    const Scene few = underLedger(builtin::makeLamps, withLights(40));
    ASSERT_EQ(few.lights.size(), 40u);
    for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0})
            EXPECT_GE(std::ranges::count_if(few.lights,
                                            [&](const Light& light) {
                                                return side * light.positionWS.x > 0.0 &&
                                                       end * light.positionWS.z > 0.0;
                                            }),
                      4)
                << side << ' ' << end;
}

TEST(Lamps, whatIsSeenToShineNeverGetsItsOwnLight) {
    const std::vector<builtin::lamps::LampPlace> places = builtin::lamps::lampPlaces();
    for (const builtin::lamps::LampPlace& place : places) {
        const Mesh glow = builtin::lamps::glowingSurfaces({place}, place.lamp);
        ASSERT_EQ(glow.positionsOS.size(), place.light.isTwoSided ? 8u : 4u) << place.light.name;
        for (std::size_t i = 0; i < glow.positionsOS.size(); ++i) {
            const glm::dvec3 fromLight = glm::dvec3(glow.positionsOS[i]) - place.light.positionWS;
            const glm::dvec3 normal(glow.normalsOS[i]);
            // Before a side and facing away, or behind a light that has no back. Half of the 5 mm between them: the
            // rounding of a position 24 m away is 2e-6 m.
            const bool facesAway = glm::dot(normal, fromLight) > 0.0025;
            const bool isBehind = !place.light.isTwoSided && glm::dot(place.light.directionWS, fromLight) < -0.0025;
            EXPECT_TRUE(facesAway || isBehind) << place.light.name;
            // And it is as large as the light.
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

TEST(GlassTable, showsSheetsAndBodiesOfManyColoursInTheStudio) {
    const Scene scene = underLedger(builtin::makeGlass, withoutAssets());
    EXPECT_LE(triangleCount(scene), 60000u);
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->source, "builtin:studio");
    std::set<float> thicknesses, roughnesses;
    int sheets = 0, absorbing = 0;
    for (const Material& material : scene.materials) {
        if (!isTransmissive(material)) continue;
        roughnesses.insert(material.perceptualRoughness);
        sheets += material.thicknessMetres == 0.0f ? 1 : 0;
        const bool absorbs = material.attenuationDistanceMetres > 0.0f && material.attenuationColor != glm::vec3(1.0f);
        absorbing += absorbs ? 1 : 0;
        // A sheet is tinted by its colour, a body by what it absorbs.
        EXPECT_EQ(absorbs, material.thicknessMetres > 0.0f) << material.name;
        EXPECT_EQ(material.doubleSided, material.name.ends_with(" pane")) << material.name;
    }
    EXPECT_EQ(sheets, 6);
    EXPECT_EQ(absorbing, 5);
    EXPECT_EQ(roughnesses.size(), 2u) << "clear and frosted";
    EXPECT_TRUE(std::ranges::all_of(scene.lights, [](const Light& light) { return infoOf(light.type).isArea; }));
    EXPECT_EQ(underLedger(builtin::makeGlass, withLights(1)).lights.size(), 1u);
}

const Node& nodeCalled(const Scene& scene, const std::string& name) {
    return *std::ranges::find(scene.nodes, name, &Node::name);
}

struct FlatTriangle {
    std::array<glm::dvec3, 3> cornersWS;
    glm::dvec3 areaWS() const { // along its normal
        return 0.5 * glm::cross(cornersWS[1] - cornersWS[0], cornersWS[2] - cornersWS[0]);
    }
};

/// Of a node without a parent.
std::vector<FlatTriangle> trianglesOf(const Scene& scene, const Node& node) {
    std::vector<FlatTriangle> triangles;
    for (const MeshInstance& instance : node.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            FlatTriangle& triangle = triangles.emplace_back();
            for (std::size_t corner = 0; corner < 3; ++corner)
                triangle.cornersWS[corner] = glm::dvec3(
                    node.parentFromNode * glm::dvec4(glm::dvec3(mesh.positionsOS[mesh.indices[i + corner]]), 1.0));
        }
    }
    return triangles;
}

/// Source: Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
bool liesBetween(const FlatTriangle& triangle, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 ray = to - from, a = triangle.cornersWS[1] - triangle.cornersWS[0];
    const glm::dvec3 b = triangle.cornersWS[2] - triangle.cornersWS[0], across = glm::cross(ray, b);
    const double determinant = glm::dot(a, across);
    if (determinant == 0.0) return false;
    const glm::dvec3 start = from - triangle.cornersWS[0], up = glm::cross(start, a);
    const double u = glm::dot(start, across) / determinant, v = glm::dot(ray, up) / determinant;
    const double along = glm::dot(b, up) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > 0.0 && along < 1.0;
}

glm::dvec3 frontEyeWS(const Scene& scene) {
    return glm::dvec3(scene.cameras.at(0).worldFromCamera[3]);
}

TEST(GlassTable, theOrangeStandsOnTheTableWithNothingBeforeIt) {
    const Scene scene = underLedger(builtin::makeGlass, withoutAssets());
    const glm::dvec3 eyeWS = frontEyeWS(scene);
    const Node& orange = nodeCalled(scene, "orange");
    constexpr double kRadius = 0.034;
    const glm::dvec3 middleWS(orange.parentFromNode * glm::dvec4(0.0, kRadius, 0.0, 1.0));
    EXPECT_EQ(middleWS.y, kRadius);
    const glm::dvec3 ahead = glm::normalize(middleWS - eyeWS);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0))),
                     up = glm::cross(right, ahead);
    std::vector<glm::dvec3> outline{middleWS};
    for (int i = 0; i < 16; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 16.0;
        outline.push_back(middleWS + 0.97 * kRadius * (std::cos(angle) * right + std::sin(angle) * up));
    }
    for (const Node& node : scene.nodes) {
        if (&node == &orange || node.name == "table") continue;
        for (const FlatTriangle& triangle : trianglesOf(scene, node))
            for (const glm::dvec3& pointWS : outline)
                ASSERT_FALSE(liesBetween(triangle, eyeWS, pointWS)) << node.name << " covers it";
    }
}

/// Faces of a few tones: else a prism is a grey slab.
TEST(GlassTable, thePrismShowsThreeFacesAndOneOfThemMirrorsALampOfTheStudio) {
    const Scene scene = underLedger(builtin::makeGlass, withoutAssets());
    const glm::dvec3 eyeWS = frontEyeWS(scene);
    ASSERT_TRUE(scene.environment);
    const Image& map = scene.environment->map;
    const double turn = glm::radians(double(scene.environment->rotationDegrees));
    const auto mirrored = [&](const glm::dvec3& direction) {
        const glm::dvec3 turned(std::cos(turn) * direction.x - std::sin(turn) * direction.z, direction.y,
                                std::sin(turn) * direction.x + std::cos(turn) * direction.z);
        const glm::dvec2 place = placeInMap(turned) * glm::dvec2(map.width, map.height);
        const int x = std::min(int(place.x), map.width - 1), y = std::min(int(place.y), map.height - 1);
        glm::vec4 texel;
        std::memcpy(&texel, map.texels.data() + std::size_t(y * map.width + x) * sizeof(texel), sizeof(texel));
        return double(texel.g);
    };
    struct Seen {
        glm::dvec3 normalWS;
        double area = 0.0, mirrored = 0.0; ///< as seen, square metres; the mean over places of it
    };
    std::vector<Seen> faces;
    double whole = 0.0;
    for (const FlatTriangle& triangle : trianglesOf(scene, nodeCalled(scene, "prism"))) {
        const glm::dvec3 normalWS = glm::normalize(triangle.areaWS());
        constexpr int kPlaces = 6;
        double area = 0.0, light = 0.0;
        for (int i = 0; i < kPlaces; ++i)
            for (int j = 0; j < kPlaces - i; ++j) {
                const double u = (i + 1.0 / 3.0) / kPlaces, v = (j + 1.0 / 3.0) / kPlaces;
                const glm::dvec3 placeWS =
                    (1.0 - u - v) * triangle.cornersWS[0] + u * triangle.cornersWS[1] + v * triangle.cornersWS[2];
                const glm::dvec3 toEye = glm::normalize(eyeWS - placeWS);
                const double cosine = glm::dot(normalWS, toEye);
                if (cosine <= 0.0) continue;
                constexpr double kShare = 2.0 / (kPlaces * (kPlaces + 1));
                area += kShare * glm::length(triangle.areaWS()) * cosine;
                light += kShare * mirrored(2.0 * cosine * normalWS - toEye);
            }
        whole += area;
        const auto same = [&](const Seen& face) { return glm::dot(face.normalWS, normalWS) > 0.999; };
        const auto known = std::ranges::find_if(faces, same);
        Seen& face = known == faces.end() ? faces.emplace_back() : *known;
        const double share = area > 0.0 ? area / (face.area + area) : 0.0;
        face = {normalWS, face.area + area, glm::mix(face.mirrored, light, share)};
    }
    std::erase_if(faces, [&](const Seen& face) { return face.area < 0.1 * whole; });
    ASSERT_EQ(faces.size(), 3u) << "both slopes and an end";
    std::ranges::sort(faces, {}, &Seen::mirrored);
    EXPECT_GT(faces.back().mirrored, 2.0) << "a lamp";
    EXPECT_LT(faces.front().mirrored, 0.3) << "the room";
}

TEST(Spheres, spanRoughnessAndMetalness) {
    const Scene scene = underLedger(builtin::makeSpheres, withoutAssets());
    int spheres = 0;
    for (const Material& material : scene.materials) {
        if (material.name.find("metalness") == 0) ++spheres;
    }
    EXPECT_EQ(spheres, 55);
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
    const Material* bust = nullptr;
    for (const Material& material : scene.materials) {
        if (material.texture(TextureSlot::Normal).image != kNone) bust = &material;
    }
    ASSERT_NE(bust, nullptr);
    EXPECT_EQ(bust->model, MaterialModel::Microfacet);
    EXPECT_EQ(bust->normalMapSpace, NormalMapSpace::Object);
    EXPECT_FLOAT_EQ(bust->ior, 1.4f);
    EXPECT_GE(scene.lights.size(), 3u);
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name != "bust") continue;
        EXPECT_GE(mesh.indices.size() / 3, 20000u);
        EXPECT_LE(mesh.indices.size() / 3, 40000u);
    }
}

TEST(Head, objectSpaceNormalsAgreeWithTheMeshTheyRefine) {
    const Scene scene = underLedger(builtin::makeHead, withoutAssets());
    const auto bust =
        std::find_if(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& m) { return m.name == "bust"; });
    const auto map =
        std::find_if(scene.images.begin(), scene.images.end(), [](const Image& i) { return i.name == "bust normals"; });
    ASSERT_NE(bust, scene.meshes.end());
    ASSERT_NE(map, scene.images.end());
    double agreement = 0.0;
    for (std::size_t i = 0; i < bust->positionsOS.size(); ++i) {
        const glm::vec2 uv = bust->texCoords[0][i];
        const int x = std::min(static_cast<int>(uv.x * static_cast<float>(map->width)), map->width - 1);
        const int y = std::min(static_cast<int>(uv.y * static_cast<float>(map->height)), map->height - 1);
        std::uint16_t texel[4];
        std::memcpy(texel, map->texels.data() + 8 * (y * map->width + x), sizeof(texel));
        const glm::dvec3 n = glm::dvec3(texel[0], texel[1], texel[2]) / 65535.0 * 2.0 - 1.0;
        EXPECT_NEAR(glm::length(n), 1.0, 1e-4); // 16 bits per component
        agreement += glm::dot(n, glm::dvec3(bust->normalsOS[i]));
    }
    agreement /= static_cast<double>(bust->positionsOS.size());
    EXPECT_GT(agreement, 0.9) << "relief turns normals by some degrees";
    EXPECT_LT(agreement, 0.9999) << "but relief there is";
}

} // namespace
} // namespace tessera::scenes
