// Flawed MTL files: the rest is imported, one warning names place and value, and a strict load fails.
#include <cmath>

#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class MtlRepairs : public ObjFiles {
protected:
    std::string warningOf(const std::string& mtl) const { return onlyWarning(painted(mtl)); }
};

TEST_F(MtlRepairs, numbersOutOfRangeAreClamped) {
    EXPECT_EQ(warningOf("Kd 1 0 0\nd 1.0001\n"),
              "paint.mtl:3: 'd' is 1.0001; it must not exceed 1; that bound is taken");
    EXPECT_EQ(paint("d 1.0001\n").alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(warningOf("Tr -0.00001\n"), "paint.mtl:2: 'Tr' is -0.00001; it must not be negative; 0 is taken");
    EXPECT_EQ(paint("Tr -0.00001\n").baseColor.w, 1.0f);
    EXPECT_EQ(warningOf("Kd -0.0001 1 1\n"), "paint.mtl:2: 'Kd' is -0.0001; it must not be negative; 0 is taken");
    EXPECT_EQ(paint("Kd -0.0001 1 1\n").baseColor, glm::vec4(0, 1, 1, 1));
    for (const auto& [mtl, roughness] : {std::pair("Pr 1.5\n", 1.0f), {"Pr -1\n", 0.0f}, {"Ns -1\n", 1.0f}}) {
        EXPECT_THAT(warningOf(mtl), testing::EndsWith(" is taken")) << mtl;
        EXPECT_FLOAT_EQ(paint(mtl).perceptualRoughness, roughness) << mtl;
    }
    EXPECT_LT(paint("Ns 1e40\n").perceptualRoughness, 1e-6f);
    EXPECT_EQ(paint("Ni -1\n").ior, 1.5f);
    EXPECT_EQ(paint("Pm 2\n").metallic, 1.0f);
    EXPECT_THAT(warningOf("Ke 1e40 0 0\n"), HasSubstr("it must not exceed 6.33825e+29"));
}

TEST_F(MtlRepairs, statementsThatGiveNoNumberAreLeftOut) {
    constexpr const char* kInfinite = ", which is not a finite number in single precision; the statement is left out";
    for (const auto& [mtl, warning] :
         {std::pair<std::string, std::string>("Kd 1 red 1\n", "'Kd' needs a number, not 'red'"),
          {"Kd 1 0\n", "'Kd' needs 3 numbers"},
          {"Kd\n", "'Kd' needs 3 numbers"},
          {"d\n", "'d' needs a number"},
          {"illum 2.5\n", "'illum' is 2.5; it must be a whole number from 0 to 10"},
          {"illum -1\n", "'illum' is -1; it must be a whole number from 0 to 10"},
          {"map_Kd\n", "'map_Kd' names no picture"},
          {"map_Bump \n", "'map_bump' names no picture"},
          {"map_Kd -s 1 1 1\n", "'map_Kd' names no picture"}}) {
        EXPECT_EQ(warningOf("Kd 1 0 0\n" + mtl), "paint.mtl:3: " + warning + "; the statement is left out");
        EXPECT_EQ(paint("Kd 1 0 0\n" + mtl).baseColor, glm::vec4(1, 0, 0, 1)) << mtl;
        EXPECT_THAT(painted("Kd 1 0 0\n" + mtl).images, IsEmpty());
    }
    EXPECT_EQ(warningOf("Ns nan\n"), std::string("paint.mtl:2: 'Ns' is given nan") + kInfinite);
    EXPECT_EQ(warningOf("Ke inf 0 0\n"), std::string("paint.mtl:2: 'Ke' is given inf") + kInfinite);
    EXPECT_EQ(paint("Ns nan\nKe inf 0 0\n").emissive, glm::vec3(0.0f));
}

TEST_F(MtlRepairs, materialsThatNothingIsDrawnWithHaveNoFlaws) {
    EXPECT_THAT(painted("Kd 1 0 0\nnewmtl unused\nKd nan 0 0\nd 7\nmap_Kd\nhuh 1\nTr 1\nmap_Ks gone.png\n", strictly())
                    .warnings,
                IsEmpty());
}

TEST_F(MtlRepairs, optionsMayStandBehindTheName) {
    folder.writePicture("n.tga", 1, 1, {{128, 128, 255, 255}});
    const Scene bump = painted("map_Bump n.tga -bm 0.5\n");
    EXPECT_EQ(bump.materials.at(0).normalScale, 0.5f);
    EXPECT_THAT(bump.warnings, ElementsAre(HasSubstr("taken for a tangent-space normal map")));
    const Scene both = painted("map_Kd -s 2 4 n.tga -o 0.25 -clamp on # picture\n", strictly());
    const TextureUse& use = both.materials.at(0).texture(TextureSlot::BaseColor);
    EXPECT_EQ(use.transform.scale, glm::vec2(2, 4));
    EXPECT_EQ(use.transform.offset.x, 0.25f);
    EXPECT_EQ(use.sampler.wrapU, Wrap::ClampToEdge);
    EXPECT_THAT(both.warnings, IsEmpty());
    EXPECT_EQ(both.images.at(0).width, 1);
    // A name with a space is one name.
    EXPECT_THAT(painted("map_Kd my picture.tga -bm 1\n").warnings, ElementsAre(HasSubstr("/my picture.tga: there is")));
    EXPECT_EQ(warningOf("map_Kd -s n.tga\n"), "paint.mtl:2: the option '-s' needs a number; the option is left out");
    EXPECT_THAT(painted("map_Kd -z 1 n.tga\n").warnings, ElementsAre(HasSubstr("are left out: the option -z")));
}

TEST_F(MtlRepairs, invisibleMaterialsAndPicturesAreExplained) {
    folder.writePicture("red.tga", 1, 1, {{255, 0, 0, 255}});
    for (const auto& [mtl, warning] :
         {std::pair("Tr 1.000000\n",
                    "'Tr' is 1, which makes it invisible; if it should be opaque, write 'Tr 0' or 'd 1'"),
          {"d 0\n", "'d' is 0, which makes it invisible; 1 is opaque"},
          {"d 1.0\nTr 1.0\n", "'d' is 1 and 'Tr' is 1, which contradict each other; 'd' counts"},
          {"Kd 0 0 0\nmap_Kd red.tga\n",
           "'Kd' is 0 and is multiplied by the picture of map_Kd, which is not seen; write 1 to see it"},
          {"Ke 0 0 0\nmap_Ke red.tga\n",
           "'Ke' is 0 and is multiplied by the picture of map_Ke, which is not seen; write 1 to see it"},
          {"Pm 0\nmap_Pm red.tga\n",
           "'Pm' is 0 and is multiplied by the picture of map_Pm, which is not seen; write 1 to see it"}})
        EXPECT_THAT(painted(mtl, strictly()).warnings,
                    ElementsAre(testing::EndsWith(std::string("'paint': ") + warning)));
    for (const char* mtl : {"d 1\nTr 0\n", "Tr 0\nd 1\n", "d 0.3\nTr 0.7\n", "Kd 0 0 0\n",
                            "Kd 0 0.1 0\nmap_Kd red.tga\n", "illum 0\nKe 0 0 0\nmap_Ke red.tga\n"})
        EXPECT_THAT(painted(mtl).warnings, IsEmpty()) << mtl;
    EXPECT_EQ(paint("d 1\nTr 1\n").baseColor.w, 1.0f);
}

TEST_F(MtlRepairs, namesThatAreMissingAreReported) {
    const auto sceneOf = [&](const std::string& mtl, const std::string& usemtl) {
        folder.write("m.mtl", mtl);
        return importText("mtllib m.mtl\n" + std::string(kThreeVertices) + usemtl + "\nf 1 2 3\n");
    };
    const Scene before = sceneOf("Kd 1 1 1\nnewmtl t\nKd 1 0 0\n", "usemtl t");
    EXPECT_EQ(onlyWarning(before), "m.mtl:1: 'Kd' stands before the first newmtl; the statement is left out");
    EXPECT_EQ(before.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    const Scene unnamed = sceneOf("newmtl\nKd 1 0 0\n", "usemtl");
    EXPECT_EQ(onlyWarning(unnamed), "m.mtl:1: 'newmtl' gives no name; it is drawn where 'usemtl' gives none either");
    EXPECT_EQ(unnamed.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(onlyWarning(sceneOf("newmtl t\nKd 1 0 0\n", "usemtl")),
              "model.obj: 'usemtl' gives no name; a default material is used");
    const Scene twice = sceneOf("newmtl t\nKd 1 0 0\nnewmtl t\nKd 0 1 0\n", "usemtl t");
    EXPECT_EQ(onlyWarning(twice), "m.mtl:3: 't' is defined again; the first definition counts");
    EXPECT_EQ(twice.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    const Scene empty = sceneOf("", "usemtl t");
    EXPECT_THAT(empty.warnings,
                ElementsAre(HasSubstr("m.mtl: the file is empty; export the model again; default materials"),
                            HasSubstr("no material library defines 't'")));
    folder.write("m.mtl", "newmtl t\nKd 1 0 0\n");
    const Scene nothing = importText("mtllib\nmtllib m.mtl\n" + std::string(kThreeVertices) + "usemtl t\nf 1 2 3\n");
    EXPECT_EQ(onlyWarning(nothing), "model.obj: 'mtllib' names no file; the statement is left out");
}

} // namespace
} // namespace tessera::scenes
