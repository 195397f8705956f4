// Flawed OBJ files: the rest is imported, one warning names place and value, and a strict load fails.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using ObjRepairs = ObjFiles;

TEST_F(ObjRepairs, commentsBehindDataAreNoData) {
    folder.write("m.mtl",
                 "newmtl red # the colour\nKd 1 0 0 # red\nnewmtl blue #2\nKd 0 0 1\nnewmtl blue #3\nKd 0 1 0\n");
    const std::string text =
        "mtllib m.mtl # library\nv 0 0 0 # first\nv 1 0 0#second\nv 0 1 0 #\ng part # one\ns off # flat\n"
        "usemtl red # first\nf 1 2 3 # the face\nusemtl red\nf 1 2 3#\nusemtl blue #3\nf 1 2 3\n";
    const Scene scene = importText(text, strictly());
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(scene.nodes.at(0).name, "part");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].name, "red");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(scene.materials[1].name, "blue #3");
    EXPECT_EQ(scene.materials[1].baseColor, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(areaOf(scene), 1.5);
    EXPECT_EQ(importText("v 0 0 0\nv 1 0 0 # C:\\models\\\nv 0 1 0\nf 1 2 3\n").meshes.size(), 1u);
}

TEST_F(ObjRepairs, emptyPartsOfACornerAreAbsent) {
    const std::string begin = std::string(kThreeVertices) + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    for (const char* face : {"f 1// 2// 3//", "f 1/ 2/ 3/", "f 1/1/ 2/2/ 3/3/", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1"}) {
        const Scene scene = importText(begin + face + "\n", strictly());
        EXPECT_THAT(scene.warnings, IsEmpty()) << face;
        EXPECT_EQ(areaOf(scene), 0.5) << face;
        const bool hasTexCoords = std::string_view(face).starts_with("f 1/1");
        EXPECT_EQ(scene.meshes[0].texCoords[0].empty(), !hasTexCoords) << face;
    }
}

TEST_F(ObjRepairs, normalsWithoutDirectionAreDerived) {
    for (const char* normal : {"nan nan nan", "-nan(ind) -nan(ind) -nan(ind)", "-1.#IND -1.#IND -1.#IND", "inf 0 0",
                               "0 0 0", "0 1", "0 1e39 0", "x y z"}) {
        const Scene scene = importText(std::string(kThreeVertices) + "vn " + normal + "\nf 1//1 2//1 3//1\n");
        EXPECT_THAT(onlyWarning(scene),
                    AllOf(StartsWith("model.obj:4: "), testing::EndsWith("; faces that use it get their own normals")))
            << normal;
        for (const glm::vec3& normalOS : scene.meshes.at(0).normalsOS)
            EXPECT_EQ(normalOS, glm::vec3(0, 0, 1)) << normal;
    }
}

TEST_F(ObjRepairs, textureCoordinatesThatAreNoNumbersAreZero) {
    const std::string end = "\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    const Scene both = importText(std::string(kThreeVertices) + "vt nan nan" + end);
    EXPECT_EQ(
        onlyWarning(both),
        "model.obj:4: 'vt' is given nan, which is not a finite number in single precision; the number is taken as 0");
    EXPECT_EQ(both.meshes.at(0).texCoords[0].at(0), glm::vec2(0, 1));
    EXPECT_EQ(importText(std::string(kThreeVertices) + "vt 0.5 inf" + end).meshes.at(0).texCoords[0].at(0),
              glm::vec2(0.5f, 1));
    // Components that no coordinate needs are not read.
    EXPECT_THAT(importText(std::string(kThreeVertices) + "vt 0.5 0.5 nan" + end).warnings, IsEmpty());
}

TEST_F(ObjRepairs, whatNoElementUsesIsNoFlaw) {
    for (const char* unused : {"v nan nan nan\n", "v 1 2\n", "vt nan inf\n", "vn 0 0 0\n", "vt\n", "v 1e30 0 0\n",
                               "v 9 9 9 255 0 nan\n", "s blue\ns off\n", "mtllib\n", "mtllib none.mtl\n"})
        EXPECT_THAT(importText(unused + std::string(kThreeVertices) + "f -3 -2 -1\n", strictly()).warnings, IsEmpty())
            << unused;
    EXPECT_THAT(importText("usemtl none\nusemtl\n" + std::string(kOneTriangle) + "usemtl none\n").warnings,
                ElementsAre(HasSubstr("'usemtl' gives no name")));
}

TEST_F(ObjRepairs, oneBadFaceIsLeftOut) {
    const std::string model = [] {
        std::string text;
        for (int i = 0; i < 32 * 32; ++i) text += fmt::format("v {} {} 0\n", i % 32, i / 32);
        for (int i = 0; i < 31 * 31; ++i) {
            const int at = i / 31 * 32 + i % 31 + 1;
            text += fmt::format("f {} {} {} {}\n", at, at + 1, at + 33, at + 32);
        }
        return text;
    }();
    struct Bad {
        const char* lines;
        const char* flaw;
    };
    for (const auto& [lines, flaw] : {
             Bad{"f 1 2 99999\n", "1986: the position 99999 is used, but 1024 are defined in the file"},
             {"f 1 2 -1025\n", "1986: the position -1025 is used, but 1024 are defined above it"},
             {"f 0 1 2\n", "1986: an index is 0; indices count from 1"},
             {"f 1 2 x\n", "1986: the index 'x' is not a whole number"},
             {"f 1 2 3.5\n", "1986: the index '3.5' is not a whole number"},
             {"f 1 /1 2\n", "1986: the corner '/1' has no position"},
             {"f 1 2 3///1\n", "1986: the corner '3///1' has more than three parts"},
             {"f 1 2\n", "1986: 'f' has 2 of the 3 corners it needs"},
             {"f\n", "1986: 'f' has 0 of the 3 corners it needs"},
             {"l 1\n", "1986: 'l' has 1 of the 2 corners it needs"},
             {"v 1 2\nf 1 2 -1\n", "1986: 'v' has 2 of the 3 numbers it needs"},
             {"v 1 1e16 0\nf 1 2 -1\n", "1986: the position lies more than 1e+15 m away"},
             {"v 1 nan 0\nf 1 2 -1\n", "1986: 'v' is given nan, which is not a finite number in single precision"},
             {"v 1 1,5 0\nf 1 2 -1\n", "1986: 'v' needs a number, not '1,5'"},
         }) {
        const Scene scene = importText(model + lines);
        const std::string warning = onlyWarning(scene);
        EXPECT_THAT(warning, StartsWith(std::string("model.obj:") + flaw + "; ")) << lines;
        EXPECT_THAT(warning, testing::EndsWith("left out"));
        EXPECT_EQ(areaOf(scene), 31.0 * 31.0) << lines;
    }
    const Scene several = importText(model + "f 1 2 x\nf 1 2 0\nf 1 2\n");
    EXPECT_THAT(onlyWarning(several), testing::EndsWith("; the element is left out (and 2 more)"));
}

TEST_F(ObjRepairs, badTextureCoordinatesAndNormalsAreTakenOffTheirCorners) {
    for (const char* face : {"f 1/2 2/1 3/1\n", "f 1/x 2/1 3/1\n", "f 1/-2 2/1 3/1\n", "f 1/0 2/1 3/1\n"}) {
        const Scene scene = importText(std::string(kThreeVertices) + "vt 0.5 0.5\n" + face);
        EXPECT_EQ(areaOf(scene), 0.5);
        ASSERT_EQ(scene.warnings.size(), 2u) << "and that others have one";
        EXPECT_THAT(scene.warnings[0], testing::EndsWith("; the corner is drawn without it"));
    }
    EXPECT_EQ(onlyWarning(importText(std::string(kThreeVertices) + "f 1//1 2//1 3//1\n")),
              "model.obj:4: the normal 1 is used, but 0 are defined in the file; the corner is drawn without it (and 2 "
              "more)");
    EXPECT_EQ(onlyWarning(importText("s blue\n" + std::string(kOneTriangle))),
              "model.obj:1: the smoothing group 'blue' is neither a number from 0 nor on or off; its faces are flat");
}

TEST_F(ObjRepairs, aFileOfWhichNothingIsLeftIsRefusedWithItsFirstFlaw) {
    const auto errorOf = [&](std::string_view text) {
        const std::filesystem::path file = folder.write("model.obj", text);
        return inputErrorOf([&] { underLedger(importObj, file); }).substr(folder.path().string().size() + 1);
    };
    EXPECT_EQ(errorOf("v -0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "model.obj:1: 'v' needs a number, not '-0,5'");
    EXPECT_EQ(errorOf("v 0 0 0\nf 1 2 9\n"), "model.obj:2: the position 2 is used, but 1 is defined in the file");
    EXPECT_EQ(errorOf("v nan 0 0\n"),
              "model.obj: has nothing to draw ('f', 'l', 'p' or 'v' statements); export the model with its polygons");
}

/// A face whose every other corner is at the radius `inner`: a disc for 1, else a star.
std::string polygon(int corners, double inner) {
    std::string text, face = "f";
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners, radius = i % 2 == 0 ? 1.0 : inner;
        text += fmt::format("v {:.9f} {:.9f} 0\n", radius * std::cos(angle), radius * std::sin(angle));
        face += fmt::format(" {}", i + 1);
    }
    return text + face + "\n";
}

TEST_F(ObjRepairs, polygonsOfAnyNumberOfCornersKeepTheirArea) {
    for (const int corners : {4, 1000, 2000, 20'000})
        for (const double inner : {1.0, 0.25}) {
            const Scene scene = importText(polygon(corners, inner), strictly());
            const double area = 0.5 * corners * inner * std::sin(2.0 * std::numbers::pi / corners);
            EXPECT_EQ(scene.meshes.at(0).indices.size(), 3 * std::size_t(corners - 2));
            EXPECT_NEAR(areaOf(scene), area, 1e-5 * area) << corners << ' ' << inner; // rounding of positions
            EXPECT_THAT(scene.warnings, IsEmpty());
        }
}

TEST_F(ObjRepairs, farModelsAreAsNearOnesAtANode) {
    // A frame of bars 0.25 m wide; single precision has steps of 0.5 m there.
    const auto framedAt = [&](const glm::dvec3& place) {
        std::string text;
        for (const glm::dvec4& bar : {glm::dvec4(-5, -5, 0.25, 10), glm::dvec4(4.75, -5, 0.25, 10),
                                      glm::dvec4(-5, -5, 10, 0.25), glm::dvec4(-5, 4.75, 10, 0.25)})
            for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
                text += fmt::format("v {:.3f} {:.3f} {:.3f}\n", place.x + bar.x + corner.x * bar.z,
                                    place.y + bar.y + corner.y * bar.w, place.z);
        return importText(text + "v 1 2 3\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\nf 13 14 15 16\n", strictly());
    };
    const Scene near = framedAt(glm::dvec3(0.0));
    EXPECT_EQ(near.nodes.at(0).parentFromNode, glm::dmat4(1.0));
    for (const glm::dvec3& place : {glm::dvec3(500'000, 5'400'000, 300), glm::dvec3(0, 0, -1e9), glm::dvec3(170)}) {
        const Scene far = framedAt(place);
        EXPECT_THAT(far.warnings, IsEmpty());
        const glm::dvec3 origin(far.nodes.at(0).parentFromNode[3]);
        EXPECT_LT(glm::distance(origin, place), 10.0);
        ASSERT_EQ(far.meshes[0].positionsOS.size(), near.meshes[0].positionsOS.size());
        for (std::size_t i = 0; i < near.meshes[0].positionsOS.size(); ++i)
            EXPECT_EQ(origin + glm::dvec3(far.meshes[0].positionsOS[i]),
                      place + glm::dvec3(near.meshes[0].positionsOS[i]));
    }
}

TEST_F(ObjRepairs, linesAndPointsAreThinSolids) {
    const Scene lines = importText(std::string(kThreeVertices) + "usemtl a\nl 1 2 3 1\nl 1 1\n");
    ASSERT_EQ(lines.meshes.size(), 1u);
    EXPECT_EQ(lines.meshes[0].indices.size(), 3u * 24u);
    EXPECT_EQ(lines.materials.at(0).model, MaterialModel::SingleColor);
    EXPECT_EQ(lines.materials[0].name, "a, unlit");
    EXPECT_THAT(lines.notes, ElementsAre(HasSubstr("its lines are drawn as thin solids")));
    const Scene all = importText(std::string(kThreeVertices) + "l 1 2\nf 1 2 3\np 1 2 3\n", strictly());
    EXPECT_THAT(all.warnings, IsEmpty());
    ASSERT_EQ(all.nodes.size(), 1u);
    ASSERT_EQ(all.nodes[0].instances.size(), 3u);
    EXPECT_EQ(all.meshes[0].indices.size(), 3u);
    EXPECT_EQ(all.materials.size(), 2u) << "faces are lit";
}

TEST_F(ObjRepairs, verticesAloneAreACloudOfPoints) {
    const Scene scene = importText(std::string(kThreeVertices) + "v nan 0 0\n");
    EXPECT_EQ(onlyWarning(scene), "model.obj: has no faces, lines or points ('f', 'l' or 'p' statements); its "
                                  "vertices are drawn as points");
    EXPECT_EQ(scene.meshes.at(0).indices.size(), 3u * 24u);
}

TEST_F(ObjRepairs, utf16IsRead) {
    const auto utf16 = [](std::u16string_view text, bool isBigEndian, bool hasMark) {
        std::string bytes = !hasMark ? "" : isBigEndian ? "\xfe\xff" : "\xff\xfe";
        for (const char16_t c : text) {
            const char high = char(c >> 8), low = char(c & 0xff);
            bytes += isBigEndian ? std::string{high, low} : std::string{low, high};
        }
        return bytes;
    };
    // An umlaut and a pair of surrogates.
    const std::u16string name = u"\u00fc\U0001f600";
    for (const bool isBigEndian : {false, true})
        for (const bool hasMark : {false, true}) {
            folder.write("m.mtl", utf16(u"newmtl " + name + u"\nKd 1 0 0\n", isBigEndian, hasMark));
            const std::u16string model = u"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " + name + u"\nf 1 2 3\n";
            const Scene scene = importText(utf16(model, isBigEndian, hasMark), strictly());
            EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1));
            EXPECT_EQ(scene.materials[0].name, "\xc3\xbc\xf0\x9f\x98\x80");
        }
}

} // namespace
} // namespace tessera::scenes
