// Names of libraries and images whose spelling differs from their files.
#include "scenes/import/Files.h"
#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

/// A name in the forms NFC, NFD and Latin-1.
const std::string kComposed = "Gr\xc3\xbcn.tga", kDecomposed = "Gru\xcc\x88n.tga", kLatin = "Gr\xfcn.tga";

TEST(NamedFile, namesThatDifferInCaseOrUnicodeFormAreTheSame) {
    for (const auto& [a, b] : {std::pair<std::string, std::string>("Red.PNG", "red.png"),
                               {kComposed, kDecomposed},
                               {kLatin, kComposed},
                               {kLatin, kDecomposed},
                               {"GR\xc3\x9cN.TGA", kDecomposed},
                               {"\xd0\x99", "\xd0\xb8\xcc\x86"},                         // Cyrillic short i
                               {"\xea\xb0\x81", "\xe1\x84\x80\xe1\x85\xa1\xe1\x86\xa8"}, // Hangul
                               {"\xe3\x81\x8c", "\xe3\x81\x8b\xe3\x82\x99"}}) {          // kana
        EXPECT_TRUE(isSameName(a, b)) << a << ' ' << b;
        EXPECT_TRUE(isSameName(b, a)) << a << ' ' << b;
    }
    for (const auto& [a, b] : {std::pair<std::string, std::string>("red.png", "reds.png"),
                               {"Grun.tga", kComposed},
                               {"Grun.tga", kDecomposed},
                               {"", "a"},
                               {"a1", "a2"}})
        EXPECT_FALSE(isSameName(a, b)) << a << ' ' << b;
}

class ObjNames : public ObjFiles {
protected:
    /// Expects a statement's image to be found, and a warning where the spelling differs.
    void expectPicture(const std::string& name, bool isAsNamed) {
        const Scene scene = painted("map_Kd " + name + "\n");
        ASSERT_EQ(scene.images.size(), 1u) << name;
        EXPECT_EQ(scene.images[0].width, 1) << name << " is no checkerboard";
        if (isAsNamed) {
            EXPECT_THAT(scene.warnings, IsEmpty()) << name;
        } else {
            EXPECT_THAT(onlyWarning(scene),
                        AllOf(HasSubstr("paint.mtl:2: 'map_Kd' names '" + name + "', which is there as '"),
                              HasSubstr("; that one is read")));
        }
    }
    void expectLibrary(const std::string& name, bool isAsNamed) {
        const Scene scene = importText("mtllib " + name + "\n" + std::string(kThreeVertices) + "usemtl red\nf 1 2 3\n");
        EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1)) << name;
        if (isAsNamed)
            EXPECT_THAT(scene.warnings, IsEmpty()) << name;
        else
            EXPECT_THAT(onlyWarning(scene), HasSubstr("' is there as '")) << name;
    }
};

TEST_F(ObjNames, picturesAreFound) {
    folder.writePicture("tex/red.tga", 1, 1, {{255, 0, 0, 255}});
    folder.writePicture(kDecomposed, 1, 1, {{255, 0, 0, 255}});
    folder.writePicture("base.tga", 1, 1, {{255, 0, 0, 255}});
    folder.writePicture("a #1 -s b.tga", 1, 1, {{255, 0, 0, 255}});
    for (const char* name :
         {"tex/red.tga", "tex\\red.tga", ".\\tex\\red.tga", "\"tex/red.tga\"", "'tex\\red.tga'", "a #1 -s b.tga"})
        expectPicture(name, true);
    for (const char* name :
         {"Tex/Red.TGA", "TEX\\RED.tga", "tex/red.tga?v=3", "C:\\Users\\me\\base.tga", "/home/me/Base.tga"})
        expectPicture(name, false);
    expectPicture(kComposed, false);
    expectPicture(kLatin, false);
}

TEST_F(ObjNames, librariesAreFound) {
    folder.write("lib/red.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write("my red.mtl", "newmtl red\nKd 1 0 0\n");
    for (const char* name : {"lib/red.mtl", "lib\\red.mtl", ".\\lib\\red.mtl", "\"lib\\red.mtl\"", "my red.mtl",
                             "\"my red.mtl\"", "lib/red.mtl # library"})
        expectLibrary(name, true);
    for (const char* name : {"LIB/Red.mtl", "C:\\me\\My Red.mtl", "my red.MTL"}) expectLibrary(name, false);
}

TEST_F(ObjNames, aPictureOfTwoSpellingsIsReadOnce) {
    folder.writePicture("red.tga", 1, 1, {{255, 0, 0, 255}});
    EXPECT_EQ(painted("map_Kd Red.tga\nmap_Ks RED.tga\nmap_Ke ./red.tga\n").images.size(), 1u);
}

} // namespace
} // namespace tessera::scenes
