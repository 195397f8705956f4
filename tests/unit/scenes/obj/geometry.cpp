#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using Obj = ObjFiles;

TEST_F(Obj, aTriangleBecomesANodeNamedAfterTheFile) {
    const Scene scene = importText(kOneTriangle);
    EXPECT_EQ(scene.name, "model");
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].name, "model");
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_THAT(scene.meshes[0].positionsOS, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(scene.meshes[0].indices, ElementsAre(0, 1, 2));
    EXPECT_TRUE(scene.meshes[0].texCoords[0].empty());
    EXPECT_TRUE(scene.meshes[0].colors.empty());
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_TRUE(scene.lights.empty());
}

TEST_F(Obj, polygonsKeepTheirAreaWhenCut) {
    const Scene quad = importText("v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\n");
    EXPECT_EQ(quad.meshes[0].indices.size(), 6u);
    EXPECT_EQ(areaOf(quad), 6.0);
}

TEST_F(Obj, concavePolygonsNeverCoverTheirNotch) {
    // Arrow heads with a notch at (1, 1), of five corners and of four. Each starts at each corner and is used from both
    // sides, in each coordinate plane.
    const std::vector<std::vector<glm::ivec2>> outlines = {{{0, 0}, {1, 1}, {2, 0}, {2, 3}, {0, 3}},
                                                           {{0, 0}, {1, 1}, {2, 0}, {1, 3}}};
    for (const std::vector<glm::ivec2>& outline : outlines) {
        for (std::size_t start = 0; start < outline.size(); ++start) {
            for (int side = 0; side < 2; ++side) {
                for (int plane = 0; plane < 3; ++plane) {
                    std::string vertices;
                    std::string face = "f";
                    for (std::size_t i = 0; i < outline.size(); ++i) {
                        const std::size_t step = side == 0 ? i : outline.size() - i;
                        const glm::ivec2 at = outline[(start + step) % outline.size()];
                        glm::ivec3 position(0);
                        position[plane] = at.x;
                        position[(plane + 1) % 3] = at.y;
                        vertices += fmt::format("v {} {} {}\n", position.x, position.y, position.z);
                        face += fmt::format(" {}", i + 1);
                    }
                    const Scene scene = importText(vertices + face + "\n");
                    const Mesh& mesh = scene.meshes[0];
                    EXPECT_EQ(areaOf(scene), outline.size() == 5 ? 5.0 : 2.0) << start << ' ' << side << ' ' << plane;
                    // All triangles keep the polygon's orientation.
                    for (const glm::vec3& normalOS : mesh.normalsOS)
                        EXPECT_EQ(normalOS[(plane + 2) % 3], side == 0 ? 1.0f : -1.0f);
                }
            }
        }
    }
}

TEST_F(Obj, aConvexQuadIsCutAlongItsShorterDiagonal) {
    const Mesh mesh = importText("v 0 0 0\nv 5 -1 0\nv 10 0 0\nv 5 1 0\nf 1 2 3 4\n").meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const glm::vec3 a = mesh.positionsOS[mesh.indices[i + edge]];
            const glm::vec3 b = mesh.positionsOS[mesh.indices[i + (edge + 1) % 3]];
            EXPECT_LT(glm::distance(a, b), 9.0f); // the longer one has 10
        }
    }
}

TEST_F(Obj, polygonsWithoutAreaGiveTrianglesAllTheSame) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\nf 1 3 2 4 1\n");
    EXPECT_EQ(scene.meshes[0].indices.size(), 15u);
}

TEST_F(Obj, negativeIndicesCountBackFromTheFace) {
    const Scene scene =
        importText("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 8 8 8\nv 0 0 5\nv 1 0 5\nf -2 -1 4\n");
    EXPECT_THAT(scene.meshes[0].positionsOS, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                                         glm::vec3(0, 0, 5), glm::vec3(1, 0, 5), glm::vec3(0, 1, 0)));
}

TEST_F(Obj, facesMayStandBeforeTheirVertices) {
    const Scene scene = importText("f 1 2 3 4\nv 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n");
    EXPECT_EQ(areaOf(scene), 6.0);
}

TEST_F(Obj, equalCornersShareAVertexAndDifferentOnesNever) {
    const std::string positions = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\n";
    const auto vertices = [&](const char* faces) { return importText(positions + faces).meshes[0].positionsOS.size(); };
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\n"), 4u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/2/1 4/1/1\n"), 5u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/2/2 4/1/2\n"), 5u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/2 3/2/2 4/1/2\n"), 6u);
}

TEST_F(Obj, textureCoordinatesCountFromTheTop) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0\nvt 1 0.25\nvt 0 1\nf 1/1 2/2 3/3\n");
    EXPECT_THAT(scene.meshes[0].texCoords[0], ElementsAre(glm::vec2(0.25f, 1), glm::vec2(1, 0.75f), glm::vec2(0, 0)));
    EXPECT_TRUE(scene.meshes[0].texCoords[1].empty());
}

TEST_F(Obj, missingTextureCoordinatesBesideOthersWarn) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1/1 2 3\n");
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("corners have no texture coordinates")));
    EXPECT_EQ(scene.meshes[0].texCoords[0][1], glm::vec2(0, 1));
}

TEST_F(Obj, givenNormalsAreKeptAtUnitLength) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n");
    for (const glm::vec3& normalOS : scene.meshes[0].normalsOS) {
        // Two roundings of single precision.
        EXPECT_NEAR(normalOS.y, 0.6f, 1e-7f);
        EXPECT_NEAR(normalOS.z, 0.8f, 1e-7f);
    }
}

/// Two triangles that meet at a right angle along the Y axis.
constexpr std::string_view kFold = "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0 0 -1\n";

TEST_F(Obj, facesWithoutNormalsAreFlatOutsideSmoothingGroups) {
    for (const char* faces : {"f 1 2 3\nf 1 4 2\n", "s off\nf 1 2 3\nf 1 4 2\n", "s 1\ns 0\nf 1 2 3\nf 1 4 2\n"}) {
        const Mesh mesh = importText(std::string(kFold) + faces).meshes[0];
        ASSERT_EQ(mesh.normalsOS.size(), 6u);
        EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh.normalsOS[3], glm::vec3(1, 0, 0));
    }
}

TEST_F(Obj, aSmoothingGroupAveragesNormalsAcrossItsFaces) {
    for (const char* smooth : {"s 1\n", "s on\n", "s 77\n"}) {
        const Mesh mesh = importText(std::string(kFold) + smooth + "f 1 2 3\nf 1 4 2\n").meshes[0];
        ASSERT_EQ(mesh.normalsOS.size(), 4u);
        const float half = std::sqrt(0.5f);
        // Rounding of single precision.
        EXPECT_NEAR(mesh.normalsOS[0].x, half, 1e-6f);
        EXPECT_NEAR(mesh.normalsOS[0].z, half, 1e-6f);
        EXPECT_EQ(mesh.normalsOS[2], glm::vec3(0, 0, 1));
    }
}

TEST_F(Obj, normalsNeverSmoothAcrossDifferentGroups) {
    const Mesh mesh = importText(std::string(kFold) + "s 1\nf 1 2 3\ns 2\nf 1 4 2\n").meshes[0];
    ASSERT_EQ(mesh.normalsOS.size(), 6u);
    EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
}

TEST_F(Obj, smoothNormalsNeverDependOnHowAPolygonIsCut) {
    // A cube's corner. Its faces are one quad, and two quads cut into triangles along different diagonals. Weights by
    // angle count each face the same; weights by triangle do not.
    const Mesh mesh = importText("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 0 1\ns 1\n"
                                 "f 1 4 3 2\nf 1 5 6\nf 1 6 4\nf 1 2 5\nf 2 7 5\n")
                          .meshes[0];
    const auto corner = std::ranges::find(mesh.positionsOS, glm::vec3(0));
    const glm::vec3 normalOS = mesh.normalsOS[std::size_t(corner - mesh.positionsOS.begin())];
    const float third = -1.0f / std::sqrt(3.0f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(normalOS[i], third, 1e-6f); // rounding of single precision
}

TEST_F(Obj, aTriangleWithoutAreaHasAUnitNormal) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nf 1 2 2\ns 1\nf 1 2 1\n");
    for (const glm::vec3& normalOS : scene.meshes[0].normalsOS) EXPECT_EQ(normalOS, glm::vec3(0, 1, 0));
}

TEST_F(Obj, everyGroupAndObjectIsANode) {
    const Scene scene = importText("v 0 0 0\nv 1 0 0\nv 0 1 0\no left hand\nf 1 2 3\ng thumb  nail\nf 1 2 3\n"
                                   "f 1 3 2\ng empty\n");
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "left hand");
    EXPECT_EQ(scene.nodes[1].name, "thumb nail");
    EXPECT_EQ(scene.meshes[1].indices.size(), 6u);
}

TEST_F(Obj, continuedLinesCommentsAndForeignLineEndsAreRead) {
    const Scene scene =
        importText("\xef\xbb\xbf# comment\r\nv 0 0 0\r\nv 1 \\\r\n 0 0 \r\nv 0 1e0 +0.0\r\n\r\n\tf 1 2 \\\r\n 3\r\n");
    EXPECT_THAT(scene.meshes[0].positionsOS, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
}

TEST_F(Obj, unsupportedStatementsAreNamedInAWarning) {
    const Scene scene = importText(std::string(kOneTriangle) + "curv 0 1 1 2\nhuh\nlod 1\n", strictly());
    EXPECT_THAT(scene.warnings, ElementsAre((folder.path() / "model.obj").string() +
                                            ": statements that are not supported are left out: curv, huh"));
}

TEST_F(Obj, emptyAndMissingFilesAreRefused) {
    const std::string empty = folder.file("model.obj", ""), missing = (folder.path() / "none.obj").string();
    EXPECT_EQ(inputErrorOf([&] { underLedger(importObj, empty); }),
              empty + ": the file is empty; export the model again");
    EXPECT_EQ(inputErrorOf([&] { underLedger(importObj, missing); }),
              missing + ": there is no such file; check the name and the folder");
}

} // namespace
} // namespace tessera::scenes
