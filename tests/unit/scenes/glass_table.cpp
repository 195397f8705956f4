// The built-in scene glass: the objects on its table, and their visibility to the front camera.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "scenes/builtin/Builtin.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"

namespace tessera::scenes {
namespace {

using test::withLights;
using test::withoutAssets;

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
        // Sheets are tinted by their colour, bodies by absorption.
        EXPECT_EQ(absorbs, material.thicknessMetres > 0.0f) << material.name;
        EXPECT_EQ(material.doubleSided, material.name.ends_with(" pane")) << material.name;
    }
    EXPECT_EQ(sheets, 6);
    EXPECT_EQ(absorbing, 5);
    EXPECT_EQ(roughnesses.size(), 3u) << "sheets, clear bodies and a frosted one";
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

/// Triangles of a node without a parent, in world space.
std::vector<FlatTriangle> trianglesOf(const Scene& scene, const Node& node) {
    std::vector<FlatTriangle> triangles;
    for (const MeshInstance& instance : node.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
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

/// The faces must differ in tone; otherwise a prism is a grey slab.
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
        double area = 0.0, mirrored = 0.0; ///< projected area in square metres; mean mirrored radiance
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
                constexpr double kShareOfPlace = 2.0 / (kPlaces * (kPlaces + 1));
                area += kShareOfPlace * glm::length(triangle.areaWS()) * cosine;
                light += kShareOfPlace * mirrored(2.0 * cosine * normalWS - toEye);
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

} // namespace
} // namespace tessera::scenes
