// Points and lines, which are drawn as thin solids.
#include "scenes/import/GltfSteps.h"

#include <cmath>
#include <limits>

#include "tests/unit/scenes/gltf/AnimationBuilder.h"
#include "tests/unit/scenes/gltf/ThinSolids.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Tolerance of lengths about 1: far above the rounding of positions, 6e-8, and far below a line's width, 2.5e-3.
constexpr double kRoundedLength = 1e-6;

std::size_t solidsOf(const Mesh& mesh) {
    EXPECT_EQ(mesh.indices.size() % kCornersOfSolid, 0u);
    return mesh.indices.size() / kCornersOfSolid;
}

/// The centre of a point's solid, or of one end of a prism's axis.
glm::dvec3 middleOS(const Mesh& mesh, std::size_t first, std::size_t corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < corners; ++i) sum += cornerOS(mesh, first + i);
    return sum / double(corners);
}

struct Segment {
    glm::dvec3 start, end;
};

/// The axes of the prisms. A prism's first triangle surrounds its start, its last triangle its end.
std::vector<Segment> segmentsOf(const Mesh& mesh) {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < solidsOf(mesh); ++i)
        segments.push_back({middleOS(mesh, i * kCornersOfSolid, 3), middleOS(mesh, (i + 1) * kCornersOfSolid - 3, 3)});
    return segments;
}

/// Expects segments between the five positions, given as pairs of their numbers.
void expectSegments(const Mesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& expected) {
    const auto place = [](std::size_t i) {
        return glm::dvec3(kFivePlaces.at(3 * i), kFivePlaces.at(3 * i + 1), kFivePlaces.at(3 * i + 2));
    };
    const std::vector<Segment> segments = segmentsOf(mesh);
    ASSERT_EQ(segments.size(), expected.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        EXPECT_LT(glm::distance(segments[i].start, place(expected[i].first)), kRoundedLength) << i;
        EXPECT_LT(glm::distance(segments[i].end, place(expected[i].second)), kRoundedLength) << i;
    }
}

// ---- Geometry ------------------------------------------------------------------------------------------------------

TEST(GltfThinSolids, aPointBecomesAnOctahedronOfAStatedShareOfTheModel) {
    const Scene scene = thin(0, {1, 1, 1, 5, 1, 1}).import();
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(solidsOf(mesh), 2u);
    const double halfWidth = 0.5 * pointLineWidths(2) * kLineWidthShare * 4.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 point(i == 0 ? 1.0 : 5.0, 1.0, 1.0);
        glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
        for (std::size_t k = i * kCornersOfSolid; k < (i + 1) * kCornersOfSolid; ++k) {
            EXPECT_NEAR(glm::distance(cornerOS(mesh, k), point), halfWidth, kRoundedLength);
            least = glm::min(least, cornerOS(mesh, k));
            most = glm::max(most, cornerOS(mesh, k));
        }
        EXPECT_LT(glm::distance(least, point - halfWidth), 2.0 * kRoundedLength);
        EXPECT_LT(glm::distance(most, point + halfWidth), 2.0 * kRoundedLength);
        // The surface area times the rounding of positions.
        EXPECT_NEAR(volumeOf(mesh, i), 4.0 / 3.0 * std::pow(halfWidth, 3),
                    7.0 * halfWidth * halfWidth * kRoundedLength);
    }
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(GltfThinSolids, areAsManyAs32BitIndicesCanNameCornersOf) {
    constexpr std::uint64_t kIndices = std::uint64_t(1) << 32, kMost = kIndices / 24; // eight triangles each
    EXPECT_TRUE(canBeIndexed(kMost)) << 24 * kMost;
    EXPECT_FALSE(canBeIndexed(kMost + 1)) << 24 * (kMost + 1);
}

TEST(GltfThinSolids, aSegmentBecomesAClosedPrismOfAStatedShareOfTheModel) {
    const std::vector<std::vector<float>> directions = {
        {2, 0, 0}, {0, 2, 0}, {0, 0, -2}, {1, 2, -1.5f}, {-2, 1e-6f, 0}};
    for (const std::vector<float>& to : directions) {
        const Mesh mesh = thin(1, {0, 0, 0, to[0], to[1], to[2]}).import().meshes.at(0);
        ASSERT_EQ(solidsOf(mesh), 1u);
        const double width = kLineWidthShare * 2.0, length = glm::length(glm::dvec3(to[0], to[1], to[2]));
        EXPECT_NEAR(glm::distance(cornerOS(mesh, 0), cornerOS(mesh, 1)), width, kRoundedLength);
        EXPECT_NEAR(glm::distance(cornerOS(mesh, 21), cornerOS(mesh, 22)), width, kRoundedLength);
        EXPECT_NEAR(volumeOf(mesh, 0), std::sqrt(3.0) / 4.0 * width * width * length,
                    3.0 * width * length * kRoundedLength);
    }
}

TEST(GltfThinSolids, linesLoopsAndStripsPairTheirVertices) {
    const Scene lines = thin(1).import();
    expectSegments(lines.meshes.at(0), {{0, 1}, {2, 3}});
    EXPECT_THAT(lines.warnings,
                ElementsAre(HasSubstr("has 5 corners, which is no multiple of 2; the last line is left")));
    const Scene loop = thin(2).import(), strip = thin(3).import();
    expectSegments(loop.meshes.at(0), {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}});
    expectSegments(strip.meshes.at(0), {{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    EXPECT_THAT(loop.warnings, IsEmpty());
    EXPECT_THAT(strip.warnings, IsEmpty());
    Builder indexed = thin(3);
    indexed.indices({4, 0, 3});
    expectSegments(indexed.import().meshes.at(0), {{4, 0}, {0, 3}});
}

TEST(GltfThinSolids, aLoopOfTwoVerticesIsOneSegment) {
    Builder builder = thin(2);
    builder.indices({1, 4});
    expectSegments(builder.import().meshes.at(0), {{1, 4}});
}

/// A triangle of world size 1 beside a line at a node of scale 0.1.
TEST(GltfThinSolids, widthsAreOfTheWholeModelInTheWorld) {
    Builder builder;
    const int line = builder.add("VEC3", {0, 0, 0, 1, 0, 0});
    builder.json["meshes"].push_back(Json::parse(R"({"primitives": [{"attributes": {}, "mode": 1}]})"));
    builder.json["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = line;
    builder.merge(R"({"nodes": [{"mesh": 0}, {"mesh": 1, "scale": [0.1, 0.1, 0.1]}], "scenes": [{"nodes": [0, 1]}]})");
    const Mesh mesh = builder.import().meshes.at(1);
    EXPECT_NEAR(glm::distance(cornerOS(mesh, 0), cornerOS(mesh, 1)), 10.0 * kLineWidthShare, kRoundedLength);
}

TEST(GltfThinSolids, trianglesBesideThemAreAsWithout) {
    const Scene alone = Builder().import();
    Builder builder;
    builder.json["meshes"][0]["primitives"].push_back(Json::parse(R"({"attributes": {"POSITION": 0}, "mode": 2})"));
    const Scene scene = builder.import();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positionsOS, alone.meshes.at(0).positionsOS);
    EXPECT_EQ(scene.meshes[0].normalsOS, alone.meshes.at(0).normalsOS);
    EXPECT_EQ(scene.meshes[0].indices, alone.meshes.at(0).indices);
    EXPECT_EQ(materialOf(scene), materialOf(alone));
    EXPECT_EQ(solidsOf(scene.meshes[1]), 3u);
    EXPECT_THAT(alone.notes, IsEmpty());
}

TEST(GltfThinSolids, pointsOfManyAreSmallerThanThoseOfFew) {
    EXPECT_EQ(pointLineWidths(1), 8.0);
    EXPECT_NEAR(pointLineWidths(1000), 2.95, 0.05);
    EXPECT_EQ(pointLineWidths(1'000'000), 2.0);
    std::vector<float> many;
    for (int i = 0; i < 1024; ++i) many.insert(many.end(), {float(i % 32), float(i / 32), 0.0f});
    const Scene scene = thin(0, many).import();
    EXPECT_NEAR(2.0 * glm::length(cornerOS(scene.meshes.at(0), 0)), 31.0 / 96.0, kRoundedLength);
}

TEST(GltfThinSolids, aLineForEachKindReportsThem) {
    Builder builder = thin(1);
    for (const int mode : {0, 3, 0}) {
        builder.json["meshes"][0]["primitives"].push_back(Json::parse(R"({"attributes": {"POSITION": 0}})"));
        builder.json["meshes"][0]["primitives"].back()["mode"] = mode;
    }
    EXPECT_THAT(builder.import().notes,
                ElementsAre("its lines are drawn as thin solids, 0.36 % of the model's longest side wide",
                            "its points are drawn as thin solids, 2.9 % of the model's longest side wide"));
    EXPECT_THAT(thin(0).import().notes, ElementsAre(HasSubstr("its points are drawn")));
    EXPECT_THAT(thin(2).import().notes, ElementsAre(HasSubstr("its lines are drawn")));
}

// ---- Attributes ----------------------------------------------------------------------------------------------------

TEST(GltfThinSolids, coloursAndTextureCoordinatesGoWithTheVertices) {
    for (const int mode : {0, 1}) {
        Builder builder = thin(mode, {0, 0, 0, 1, 0, 0});
        builder.attribute("COLOR_0", "VEC3", {1, 0, 0, 0, 1, 0});
        builder.attribute("TEXCOORD_1", "VEC2", {3, 4, 5, 6});
        const Mesh mesh = builder.import().meshes.at(0);
        ASSERT_EQ(mesh.colors.size(), mesh.positionsOS.size());
        ASSERT_EQ(mesh.texCoords[1].size(), mesh.positionsOS.size());
        EXPECT_EQ(solidsOf(mesh), mode == 0 ? 2u : 1u);
        for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i) {
            const bool isFirst = mesh.positionsOS[i].x < 0.5f;
            EXPECT_EQ(mesh.colors[i], isFirst ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1)) << i;
            EXPECT_EQ(mesh.texCoords[1][i], isFirst ? glm::vec2(3, 4) : glm::vec2(5, 6)) << i;
        }
    }
}

TEST(GltfThinSolids, morphTargetsGoWithTheVertices) {
    Builder builder = thin(1, {0, 0, 0, 1, 0, 0});
    builder.target({0, 1, 0, 0, 2, 0});
    builder.json["meshes"][0]["weights"] = Json::array({1});
    Scene scene = builder.import();
    const Mesh rest = scene.rig.shapes.at(0).rest;
    EXPECT_EQ(scene.meshes.at(0).positionsOS, rest.positionsOS);
    EXPECT_NEAR(glm::distance(cornerOS(rest, 0), cornerOS(rest, 1)), kLineWidthShare, kRoundedLength);
    checkScene(scene);
    poseScene(scene, 0.0);
    const std::vector<Segment> segments = segmentsOf(scene.meshes.at(0));
    EXPECT_LT(glm::distance(segments.at(0).start, glm::dvec3(0, 1, 0)), kRoundedLength);
    EXPECT_LT(glm::distance(segments.at(0).end, glm::dvec3(1, 2, 0)), kRoundedLength);
}

TEST(GltfThinSolids, segmentsThatGrowAreThereFromTheBegin) {
    Builder builder = thin(1, {1, 2, 3, 1, 2, 3});
    builder.target({0, 0, 0, 0, 2, 0});
    builder.json["meshes"][0]["weights"] = Json::array({1});
    EXPECT_EQ(solidsOf(builder.import().meshes.at(0)), 1u);
}

/// The joint has a scale of 10 and is at x = 7.
TEST(GltfThinSolids, jointsGoWithTheVerticesAndTheFirstOneGivesTheScale) {
    Builder builder = thin(1, {0, 0, 0, 1, 0, 0});
    builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0}, {"translation": [7, 0, 0], "scale": [10, 10, 10]}],
                      "scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1]}]})");
    builder.attribute("JOINTS_0", "VEC4", std::vector<std::uint8_t>(8, 0));
    builder.attribute("WEIGHTS_0", "VEC4", {1, 0, 0, 0, 1, 0, 0, 0});
    Scene scene = builder.import();
    EXPECT_EQ(scene.rig.shapes.at(0).joints.size(), 4 * kCornersOfSolid);
    checkScene(scene);
    poseScene(scene, 0.0);
    const Mesh& mesh = scene.meshes.at(0);
    // A pose stores vertices relative to their centre.
    const glm::dvec3 along = segmentsOf(mesh).at(0).end - segmentsOf(mesh).at(0).start;
    EXPECT_LT(glm::distance(along, glm::dvec3(10, 0, 0)), 10.0 * kRoundedLength);
    EXPECT_NEAR(glm::distance(cornerOS(mesh, 0), cornerOS(mesh, 1)), 10.0 * kLineWidthShare, 10.0 * kRoundedLength);
}

// ---- Degenerate and refused ----------------------------------------------------------------------------------------

TEST(GltfThinSolids, segmentsWithoutLengthDrawNothing) {
    const Scene some = thin(3, {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0}).import();
    EXPECT_EQ(solidsOf(some.meshes.at(0)), 1u);
    EXPECT_THAT(some.warnings, IsEmpty());
    for (const int mode : {1, 2, 3}) {
        const Scene none = thin(mode, {1, 2, 3, 1, 2, 3}).import();
        EXPECT_THAT(none.meshes, IsEmpty());
        EXPECT_THAT(none.notes, IsEmpty()) << "nothing is drawn";
        EXPECT_THAT(none.warnings, ElementsAre(HasSubstr("/meshes/0/primitives/0: mesh 'mesh 0' has no line of any "
                                                         "length and is left out")));
    }
}

TEST(GltfThinSolids, aLineOfOneVertexDrawsNothing) {
    for (const int mode : {1, 2, 3}) {
        const Scene scene = thin(mode, {1, 2, 3}).import();
        EXPECT_THAT(scene.meshes, IsEmpty());
        EXPECT_TRUE(hasWarning(scene, "has no line of any length and is left out")) << mode;
    }
}

/// At such distances rounding moves corners, by 1/16 m at 1e6 m.
TEST(GltfThinSolids, aSinglePointIsDrawnWhereverItLies) {
    for (const float x : {0.0f, 1.0f, 1e6f, float(kFarthestMetres)}) {
        const Mesh mesh = thin(0, {x, 0, 0}).import().meshes.at(0);
        ASSERT_EQ(solidsOf(mesh), 1u);
        glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
        for (std::size_t i = 0; i < kCornersOfSolid; ++i) {
            least = glm::min(least, cornerOS(mesh, i));
            most = glm::max(most, cornerOS(mesh, i));
        }
        for (glm::length_t axis = 0; axis < 3; ++axis) EXPECT_GT(most[axis], least[axis]) << x;
        for (const glm::vec3& normal : mesh.normalsOS) EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f) << x;
        if (x == 0.0f) {
            EXPECT_NEAR(most.x - least.x, pointLineWidths(1) * kLineWidthShare, 1e-9) << "as in a model of 1 m";
        }
    }
}

TEST(GltfThinSolids, nodesThatFlattenEverythingAreNoFault) {
    Builder builder = thin(1);
    builder.json["nodes"][0]["scale"] = {0, 0, 0};
    const Scene scene = builder.import();
    EXPECT_EQ(solidsOf(scene.meshes.at(0)), 2u);
    checkScene(scene);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_NEAR(glm::distance(cornerOS(mesh, 0), cornerOS(mesh, 1)), kLineWidthShare, kRoundedLength) << "it may grow";
}

TEST(GltfThinSolids, noSolidIsWiderThanItsMeshIsLong) {
    Builder builder = thin(1, {0, 0, 0, 1, 0, 0});
    builder.merge(
        R"({"nodes": [{"mesh": 0, "scale": [1e-6, 1e-6, 1e-6]}, {"mesh": 1}], "scenes": [{"nodes": [0, 1]}]})");
    builder.json["meshes"].push_back(Json::parse(R"({"primitives": [{"attributes": {"POSITION": 0}}]})"));
    const Mesh mesh = builder.import().meshes.at(0);
    EXPECT_NEAR(glm::distance(cornerOS(mesh, 0), cornerOS(mesh, 1)), 1.0, kRoundedLength);
}

TEST(GltfThinSolids, brokenOnesAreRefusedByName) {
    for (int mode = 0; mode < 4; ++mode) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        EXPECT_THAT(thin(mode, {0, 0, 0, nan, 0, 0}).error(),
                    HasSubstr("/meshes/0/primitives/0: vertex 1 of mesh 'mesh 0' has a position that is not finite"));
        const auto errorOf = [mode](std::uint8_t index) {
            Builder builder = thin(mode);
            builder.indices({0, index});
            return builder.error();
        };
        EXPECT_EQ(errorOf(4), "");
        EXPECT_THAT(errorOf(5), HasSubstr("/meshes/0/primitives/0: index 5 of mesh 'mesh 0' is no vertex"));
    }
}

TEST(GltfThinSolids, theirSolidsAreChargedBeforeTheyAreMade) {
    // 27 MB of solids from 20 KB of indices, or 40 KB of pairs; and a tenth of both.
    const auto errorOf = [](int mode, std::size_t count) {
        Builder builder = thin(mode);
        std::vector<std::uint8_t> indices(count);
        for (std::size_t i = 0; i < count; ++i) indices[i] = std::uint8_t(i % 5);
        builder.indices(indices);
        return builder.error(16 * kMiB);
    };
    for (const int mode : {0, 2, 3}) {
        EXPECT_EQ(errorOf(mode, 2000), "") << mode;
        EXPECT_THAT(errorOf(mode, 20000), HasSubstr("model.gltf: /meshes/0/primitives/0: needs ")) << mode;
    }
    EXPECT_THAT(errorOf(1, 40000), HasSubstr("model.gltf: /meshes/0/primitives/0: needs "));
}

} // namespace
} // namespace tessera::scenes::gltf::test
