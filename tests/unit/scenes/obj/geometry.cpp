#include <algorithm>

#include <fmt/format.h>

#include "scenes/import/Importers.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {
namespace {

using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

Scene importText(const TempFolder& folder, std::string_view text) {
    Scene scene = underLedger(importObj, folder.write("model.obj", text));
    checkScene(scene);
    return scene;
}

double areaOf(const Mesh& mesh) {
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positionsOS[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positionsOS[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positionsOS[mesh.indices[i + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Obj, aTriangleBecomesANodeNamedAfterTheFile) {
    const TempFolder folder;
    const Scene scene = importText(folder, kTriangle);
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

TEST(Obj, aModelThatSinglePrecisionCannotHoldIsWarnedAbout) {
    const TempFolder folder;
    const auto warningsAt = [&](double x) {
        return importText(folder, fmt::format("v {} 0 0\nv {} 0 0\nv {} 1 0\nf 1 2 3\n", x, x + 1, x)).warnings;
    };
    EXPECT_TRUE(warningsAt(500).empty());
    EXPECT_THAT(warningsAt(500'000), ElementsAre(HasSubstr("lies 5e+05 from its origin")));
}

TEST(Obj, polygonsKeepTheirAreaWhenCut) {
    const TempFolder folder;
    const Scene quad = importText(folder, "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\n");
    EXPECT_EQ(quad.meshes[0].indices.size(), 6u);
    EXPECT_EQ(areaOf(quad.meshes[0]), 6.0);
}

TEST(Obj, concavePolygonsNeverCoverTheirNotch) {
    const TempFolder folder;
    // Arrow heads with a notch at (1, 1): of five corners and, the right angle left out, of four; each begun at each
    // corner and seen from both sides, in each coordinate plane.
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
                    const Mesh mesh = importText(folder, vertices + face + "\n").meshes[0];
                    EXPECT_EQ(areaOf(mesh), outline.size() == 5 ? 5.0 : 2.0) << start << ' ' << side << ' ' << plane;
                    // All triangles keep the polygon's orientation.
                    for (const glm::vec3& normalOS : mesh.normalsOS)
                        EXPECT_EQ(normalOS[(plane + 2) % 3], side == 0 ? 1.0f : -1.0f);
                }
            }
        }
    }
}

TEST(Obj, aConvexQuadIsCutAlongItsShorterDiagonal) {
    const TempFolder folder;
    const Mesh mesh = importText(folder, "v 0 0 0\nv 5 -1 0\nv 10 0 0\nv 5 1 0\nf 1 2 3 4\n").meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const glm::vec3 a = mesh.positionsOS[mesh.indices[i + edge]];
            const glm::vec3 b = mesh.positionsOS[mesh.indices[i + (edge + 1) % 3]];
            EXPECT_LT(glm::distance(a, b), 9.0f); // the longer one has 10
        }
    }
}

TEST(Obj, polygonsWithoutAreaGiveTrianglesAllTheSame) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\nf 1 3 2 4 1\n");
    EXPECT_EQ(scene.meshes[0].indices.size(), 15u);
}

TEST(Obj, negativeIndicesCountBackFromTheFace) {
    const TempFolder folder;
    const Scene scene =
        importText(folder, "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 8 8 8\nv 0 0 5\nv 1 0 5\nf -2 -1 4\n");
    EXPECT_THAT(scene.meshes[0].positionsOS, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                                         glm::vec3(0, 0, 5), glm::vec3(1, 0, 5), glm::vec3(0, 1, 0)));
}

TEST(Obj, facesMayStandBeforeTheirVertices) {
    const TempFolder folder;
    const Scene scene = importText(folder, "f 1 2 3 4\nv 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n");
    EXPECT_EQ(areaOf(scene.meshes[0]), 6.0);
}

TEST(Obj, equalCornersShareAVertexAndDifferentOnesNever) {
    const TempFolder folder;
    const std::string positions = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\n";
    const auto vertices = [&](const char* faces) {
        return importText(folder, positions + faces).meshes[0].positionsOS.size();
    };
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\n"), 4u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/2/1 4/1/1\n"), 5u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/2/2 4/1/2\n"), 5u);
    EXPECT_EQ(vertices("f 1/1/1 2/1/1 3/1/1\nf 1/1/2 3/2/2 4/1/2\n"), 6u);
}

TEST(Obj, textureCoordinatesCountFromTheTop) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0\nvt 1 0.25\nvt 0 1\nf 1/1 2/2 3/3\n");
    EXPECT_THAT(scene.meshes[0].texCoords[0], ElementsAre(glm::vec2(0.25f, 1), glm::vec2(1, 0.75f), glm::vec2(0, 0)));
    EXPECT_TRUE(scene.meshes[0].texCoords[1].empty());
}

TEST(Obj, missingTextureCoordinatesBesideOthersWarn) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1/1 2 3\n");
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("corners without texture coordinates")));
    EXPECT_EQ(scene.meshes[0].texCoords[0][1], glm::vec2(0, 1));
}

TEST(Obj, givenNormalsAreKeptAtUnitLength) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n");
    for (const glm::vec3& normalOS : scene.meshes[0].normalsOS) {
        // Two roundings of single precision.
        EXPECT_NEAR(normalOS.y, 0.6f, 1e-7f);
        EXPECT_NEAR(normalOS.z, 0.8f, 1e-7f);
    }
}

/// Two triangles that meet at a right angle along the Y axis.
constexpr std::string_view kFold = "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0 0 -1\n";

TEST(Obj, facesWithoutNormalsAreFlatOutsideSmoothingGroups) {
    const TempFolder folder;
    for (const char* faces : {"f 1 2 3\nf 1 4 2\n", "s off\nf 1 2 3\nf 1 4 2\n", "s 1\ns 0\nf 1 2 3\nf 1 4 2\n"}) {
        const Mesh mesh = importText(folder, std::string(kFold) + faces).meshes[0];
        ASSERT_EQ(mesh.normalsOS.size(), 6u);
        EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh.normalsOS[3], glm::vec3(1, 0, 0));
    }
}

TEST(Obj, aSmoothingGroupAveragesNormalsAcrossItsFaces) {
    const TempFolder folder;
    for (const char* smooth : {"s 1\n", "s on\n", "s 77\n"}) {
        const Mesh mesh = importText(folder, std::string(kFold) + smooth + "f 1 2 3\nf 1 4 2\n").meshes[0];
        ASSERT_EQ(mesh.normalsOS.size(), 4u);
        const float half = std::sqrt(0.5f);
        // Rounding of single precision.
        EXPECT_NEAR(mesh.normalsOS[0].x, half, 1e-6f);
        EXPECT_NEAR(mesh.normalsOS[0].z, half, 1e-6f);
        EXPECT_EQ(mesh.normalsOS[2], glm::vec3(0, 0, 1));
    }
}

TEST(Obj, normalsNeverSmoothAcrossDifferentGroups) {
    const TempFolder folder;
    const Mesh mesh = importText(folder, std::string(kFold) + "s 1\nf 1 2 3\ns 2\nf 1 4 2\n").meshes[0];
    ASSERT_EQ(mesh.normalsOS.size(), 6u);
    EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
}

TEST(Obj, smoothNormalsNeverDependOnHowAPolygonIsCut) {
    const TempFolder folder;
    // A cube's corner, whose three faces are one quad and two quads cut into triangles along either diagonal. By angle
    // each face counts the same, by triangle not.
    const Mesh mesh = importText(folder, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 0 1\ns 1\n"
                                         "f 1 4 3 2\nf 1 5 6\nf 1 6 4\nf 1 2 5\nf 2 7 5\n")
                          .meshes[0];
    const auto corner = std::ranges::find(mesh.positionsOS, glm::vec3(0));
    const glm::vec3 normalOS = mesh.normalsOS[static_cast<std::size_t>(corner - mesh.positionsOS.begin())];
    const float third = -1.0f / std::sqrt(3.0f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(normalOS[i], third, 1e-6f); // rounding of single precision
}

TEST(Obj, zeroNormalsAreReplacedWithAWarning) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(scene.meshes[0].normalsOS[0], glm::vec3(0, 0, 1));
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("normals of zero length")));
}

TEST(Obj, aTriangleWithoutAreaHasAUnitNormal) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nf 1 2 2\ns 1\nf 1 2 1\n");
    for (const glm::vec3& normalOS : scene.meshes[0].normalsOS) EXPECT_EQ(normalOS, glm::vec3(0, 1, 0));
}

TEST(Obj, everyGroupAndObjectIsANode) {
    const TempFolder folder;
    const Scene scene = importText(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\no left hand\nf 1 2 3\ng thumb  nail\nf 1 2 3\n"
                                           "f 1 3 2\ng empty\n");
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "left hand");
    EXPECT_EQ(scene.nodes[1].name, "thumb nail");
    EXPECT_EQ(scene.meshes[1].indices.size(), 6u);
}

TEST(Obj, vertexColorsAreKeptWhenAllVerticesHaveThem) {
    const TempFolder folder;
    const Scene all = importText(folder, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n");
    EXPECT_THAT(all.meshes[0].colors,
                ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(0, 1, 0, 1), glm::vec4(0, 0, 0.5f, 1)));
    // Five numbers are a position and no colour.
    for (const char* last : {"v 0 1 0\n", "v 0 1 0 1 1\n"})
        EXPECT_TRUE(importText(folder, std::string("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\n") + last + "f 1 2 3\n")
                        .meshes[0]
                        .colors.empty());
}

TEST(Obj, continuedLinesCommentsAndForeignLineEndsAreRead) {
    const TempFolder folder;
    const Scene scene = importText(
        folder, "\xef\xbb\xbf# comment\r\nv 0 0 0\r\nv 1 \\\r\n 0 0 \r\nv 0 1e0 +0.0\r\n\r\n\tf 1 2 \\\r\n 3\r\n");
    EXPECT_THAT(scene.meshes[0].positionsOS, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
}

TEST(Obj, skippedElementsAreNamedInAWarning) {
    const TempFolder folder;
    const Scene scene = importText(folder, std::string(kTriangle) + "l 1 2\np 1\nl 2 3\ncurv 0 1 1 2\nhuh\nf 1 2\n");
    const std::string file = (folder.path() / "model.obj").string();
    EXPECT_THAT(scene.warnings,
                ElementsAre(file + ": 1 face(s) with fewer than three corners are left out, the first at line 10",
                            file + ": 3 line and point element(s) are left out; only faces are drawn",
                            file + ": statements that are not supported are left out: curv, huh"));
}

TEST(Obj, brokenTextIsRefusedWithFileAndLine) {
    const TempFolder folder;
    const auto errorOf = [&](std::string_view text) {
        const std::filesystem::path file = folder.write("model.obj", text);
        const std::string error = test::inputErrorOf([&] { underLedger(importObj, file); });
        EXPECT_TRUE(error.starts_with(file.string() + ":")) << error;
        return error.substr(std::min(error.size(), file.string().size() + 1));
    };
    EXPECT_EQ(errorOf(""), " the file is empty; export the model again");
    EXPECT_EQ(errorOf("\xff\xfev"), " the text is UTF-16; save it as UTF-8");
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
              " has no face of three corners or more ('f' statements); export the model with its polygons");
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
              "4: the face refers to position 4, but 3 are defined in the file");
    EXPECT_EQ(errorOf("v 0 0 0\nf 1 2 -2\nv 0 0 1\n"), "2: the face refers to position -2, but 1 is defined above it");
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n"),
              "5: the face refers to texture coordinate 2, but 1 is defined in the file");
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n"),
              "4: the face refers to normal 1, but 0 are defined in the file");
    EXPECT_EQ(errorOf("v 0 0 0\nf 0 1 1\n"), "2: a face's index is 0; indices count from 1");
    EXPECT_EQ(errorOf("v 0 0 0\nf 1 a 1\n"), "2: the face's index 'a' is not a whole number");
    EXPECT_EQ(errorOf("v 0 0 0\nf 1 1/ 1\n"), "2: the face's corner '1/' is not of the form v, v/vt, v//vn or v/vt/vn");
    EXPECT_EQ(errorOf("v 0 0 0\nf 1 /1 1\nvt 0 0\n"), "2: the face's corner '/1' has no position");
    EXPECT_EQ(errorOf("v 0 nan 0\n"), "1: 'v' is given nan, which is not a finite number in single precision");
    EXPECT_EQ(errorOf("v 0 1e39 0\n"), "1: 'v' is given 1e39, which is not a finite number in single precision");
    EXPECT_EQ(errorOf("v 0 1e999 0\n"), "1: 'v' is given 1e999, which is not a finite number in single precision");
    EXPECT_EQ(errorOf("\nv 0 x 0\n"), "2: 'v' needs a number, not 'x'");
    EXPECT_EQ(errorOf("v 0 0\n"), "1: 'v' has 2 of the 3 numbers it needs");
    EXPECT_EQ(errorOf("s blue\n"), "1: the smoothing group 'blue' is neither a number from 0 nor on or off");
}

TEST(Obj, aMissingFileIsNamed) {
    const TempFolder folder;
    const std::filesystem::path file = folder.path() / "none.obj";
    EXPECT_EQ(test::inputErrorOf([&] { underLedger(importObj, file); }),
              file.string() + ": there is no such file; check the name and the folder");
}

} // namespace
} // namespace tessera::scenes
