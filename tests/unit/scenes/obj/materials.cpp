#include <cmath>

#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/obj/ObjFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using ObjMaterials = ObjFiles;
using Texels = std::vector<std::array<std::uint8_t, 4>>;

Texels texelsOf(const Image& image) {
    EXPECT_EQ(image.format, TexelFormat::Rgba8Unorm);
    Texels texels;
    for (std::size_t i = 0; i + 3 < image.texels.size(); i += 4) {
        const auto at = [&](std::size_t channel) { return std::to_integer<std::uint8_t>(image.texels[i + channel]); };
        texels.push_back({at(0), at(1), at(2), at(3)});
    }
    return texels;
}

const Image& imageOf(const Scene& scene, TextureSlot slot) {
    return scene.images.at(std::size_t(scene.materials.at(0).texture(slot).image));
}

TEST_F(ObjMaterials, facesWithoutAMaterialGetTheDefaultOne) {
    const Scene scene = importText(kOneTriangle);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "default");
    expectMembers(scene.materials[0], "baseColor 0.8 0.8 0.8 1, metallic 0");
}

TEST_F(ObjMaterials, statementsSetMembers) {
    EXPECT_EQ(paint("Kd 1 1 1\n").name, "paint");
    for (const auto& [mtl, members] :
         {std::pair("Kd 0.25 0.5 0.75\n", "baseColor 0.25 0.5 0.75 1, metallic 0"),
          {"Kd 0.25\n", "baseColor 0.25 0.25 0.25 1"},
          {"Ns 1\n", "baseColor 1 1 1 1"},
          {"Kd 1 1 1\n", "perceptualRoughness 0.5"},
          // The PBR extension overrides the exponent.
          {"Pr 0.3\nPm 0.7\nNs 30\n", "perceptualRoughness 0.3, metallic 0.7"},
          {"Ks 0.5 0.25 2\nNi 1.8\n", "specularColor 0.5 0.25 1, ior 1.8, specularFactor 1"},
          {"Ni 1.0\n", "ior 1.5"},
          {"illum 1\n", "specularFactor 0"},
          {"illum 2\n", "specularFactor 1"},
          {"Ke 1 2 3\n", "emissive 1 2 3"}}) {
        SCOPED_TRACE(mtl);
        expectMembers(paint(mtl), members);
        EXPECT_EQ(paint(mtl).model, MaterialModel::MetallicRoughness);
    }
    EXPECT_EQ(paint("illum 0\n").model, MaterialModel::SingleColor);
}

TEST_F(ObjMaterials, theSpecularExponentSetsTheRoughness) {
    // alpha = sqrt(2 / (p + 2)), perceptual roughness its root; 1e-6: rounding of single precision.
    EXPECT_NEAR(paint("Ns 0\n").perceptualRoughness, 1.0f, 1e-6f);
    EXPECT_NEAR(paint("Ns 30\n").perceptualRoughness, 0.5f, 1e-6f);
}

TEST_F(ObjMaterials, picturesOfEmissionAreKept) {
    folder.writePicture("glow.tga", 1, 1, {{255, 0, 0, 255}});
    const Scene scene = painted("map_Ke glow.tga\n");
    EXPECT_EQ(scene.materials[0].emissive, glm::vec3(1.0f));
    EXPECT_EQ(texelsOf(imageOf(scene, TextureSlot::Emissive)), (Texels{{255, 0, 0, 255}}));
}

TEST_F(ObjMaterials, opacityBlends) {
    EXPECT_EQ(paint("d 1\n").alphaMode, AlphaMode::Opaque);
    for (const char* text : {"d 0.25\n", "Tr 0.75\n", "d 0.25\nTr 0.5\n", "d -halo 0.25\n"}) {
        const Material material = paint(text);
        EXPECT_EQ(material.alphaMode, AlphaMode::Blend) << text;
        EXPECT_EQ(material.baseColor.w, 0.25f) << text;
    }
}

TEST_F(ObjMaterials, picturesFillTheirSlots) {
    folder.writePicture("colour.tga", 1, 1, {{10, 20, 30, 255}});
    folder.writePicture("maps/normal map.tga", 1, 1, {{128, 128, 255, 255}});
    folder.writePicture("shine.tga", 1, 1, {{50, 60, 70, 255}});
    const Scene scene = painted("map_Kd colour.tga\nnorm maps\\normal map.tga\nmap_Ks shine.tga\nmap_kd colour.tga\n");
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(texelsOf(imageOf(scene, TextureSlot::BaseColor)), (Texels{{10, 20, 30, 255}}));
    EXPECT_EQ(texelsOf(imageOf(scene, TextureSlot::Normal)), (Texels{{128, 128, 255, 255}}));
    EXPECT_EQ(texelsOf(imageOf(scene, TextureSlot::SpecularColor)), (Texels{{50, 60, 70, 255}}));
    EXPECT_EQ(scene.materials[0].normalMapSpace, NormalMapSpace::Tangent);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1.0f));
}

TEST_F(ObjMaterials, bumpMapsServeAsNormalMapsWithAWarning) {
    folder.writePicture("bump.tga", 1, 1, {{128, 128, 255, 255}});
    for (const std::string keyword : {"map_bump", "bump", "map_Bump"}) {
        const Scene scene = painted(keyword + " -bm 0.5 bump.tga\n");
        EXPECT_EQ(texelsOf(imageOf(scene, TextureSlot::Normal)), (Texels{{128, 128, 255, 255}}));
        EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
        EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("taken for a tangent-space normal map")));
    }
}

TEST_F(ObjMaterials, opacityMapsBecomeTheColorsAlpha) {
    folder.writePicture("colour.tga", 2, 1, {{10, 20, 30, 255}, {40, 50, 60, 255}});
    folder.writePicture("mask.tga", 1, 1, {{77, 77, 77, 255}});
    folder.writePicture("matte.tga", 1, 1, {{1, 2, 3, 88}});
    const Scene grey = painted("map_Kd colour.tga\nmap_d mask.tga\n");
    EXPECT_EQ(grey.materials[0].alphaMode, AlphaMode::Mask);
    EXPECT_EQ(texelsOf(imageOf(grey, TextureSlot::BaseColor)), (Texels{{10, 20, 30, 77}, {40, 50, 60, 77}}));
    const Scene matte = painted("map_d matte.tga\nmap_Kd colour.tga\n");
    EXPECT_EQ(texelsOf(imageOf(matte, TextureSlot::BaseColor)), (Texels{{10, 20, 30, 88}, {40, 50, 60, 88}}));
    const Scene alone = painted("Kd 0.5 0.5 0.5\nmap_d -s 2 3 mask.tga\n");
    EXPECT_NE(alone.materials.at(0).texture(TextureSlot::BaseColor).transform, TextureUse().transform);
    EXPECT_EQ(texelsOf(imageOf(alone, TextureSlot::BaseColor)), (Texels{{255, 255, 255, 77}}));
    const Scene same = painted("map_Kd matte.tga\nmap_d matte.tga\n");
    EXPECT_EQ(same.images.size(), 1u);
    EXPECT_EQ(texelsOf(imageOf(same, TextureSlot::BaseColor)), (Texels{{1, 2, 3, 88}}));
}

TEST_F(ObjMaterials, roughnessAndMetalnessMapsArePackedAsGreenAndBlue) {
    folder.writePicture("rough.tga", 2, 1, {{11, 0, 0, 255}, {22, 0, 0, 255}});
    folder.writePicture("metal.tga", 1, 1, {{33, 0, 0, 255}});
    folder.writePicture("both.tga", 1, 1, {{1, 2, 3, 255}});
    const Scene both = painted("map_Pr rough.tga\nmap_Pm metal.tga\n");
    EXPECT_EQ(texelsOf(imageOf(both, TextureSlot::MetallicRoughness)),
              (Texels{{255, 11, 33, 255}, {255, 22, 33, 255}}));
    EXPECT_EQ(both.materials[0].perceptualRoughness, 1.0f);
    EXPECT_EQ(both.materials[0].metallic, 1.0f);
    const Scene rough = painted("map_Pr rough.tga\nPr 0.5\n");
    EXPECT_EQ(texelsOf(imageOf(rough, TextureSlot::MetallicRoughness)),
              (Texels{{255, 11, 255, 255}, {255, 22, 255, 255}}));
    EXPECT_EQ(rough.materials[0].perceptualRoughness, 0.5f);
    EXPECT_EQ(rough.materials[0].metallic, 0.0f);
    const Scene packed = painted("map_Pr both.tga\nmap_Pm both.tga\n");
    EXPECT_EQ(texelsOf(imageOf(packed, TextureSlot::MetallicRoughness)), (Texels{{1, 2, 3, 255}}));
}

TEST_F(ObjMaterials, textureOptionsPlaceThePicture) {
    folder.writePicture("colour.tga", 1, 1, {{10, 20, 30, 255}});
    const Scene scene = painted("map_Kd -s 2 4 -o 0.25 0.5 0 -clamp on colour.tga\n");
    const TextureUse& use = scene.materials[0].texture(TextureSlot::BaseColor);
    // From the bottom: v' = 4 v + 0.5; from the top: 1 - v' = 4 (1 - v) + (1 - 4 - 0.5).
    EXPECT_EQ(use.transform.scale, glm::vec2(2, 4));
    EXPECT_EQ(use.transform.offset, glm::vec2(0.25f, -3.5f));
    EXPECT_EQ(use.sampler.wrapU, Wrap::ClampToEdge);
    EXPECT_EQ(use.sampler.wrapV, Wrap::ClampToEdge);
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_THAT(painted("map_Kd -mm 0 2 -blendu off colour.tga\n").warnings,
                ElementsAre(HasSubstr("are left out: the option -blendu, the option -mm")));
}

TEST_F(ObjMaterials, textureOptionsMayGiveFewerNumbersAndHoldUntilTheyAreGivenAgain) {
    folder.writePicture("first.tga", 1, 1, {{10, 20, 30, 255}});
    folder.writePicture("second.tga", 1, 1, {{40, 50, 60, 255}});
    const auto useOf = [&](const char* mtl) {
        const Scene scene = painted(mtl);
        EXPECT_EQ(scene.images.size(), 1u);
        return scene.materials[0].texture(TextureSlot::BaseColor);
    };
    const TextureUse fewer = useOf("map_Kd -s 2 -o 0.25 -clamp off first.tga\n");
    EXPECT_EQ(fewer.transform.scale, glm::vec2(2, 1));
    EXPECT_EQ(fewer.transform.offset, glm::vec2(0.25f, 0));
    EXPECT_EQ(fewer.sampler.wrapU, Wrap::Repeat);
    const TextureUse again = useOf("map_Kd -s 2 4 -clamp on first.tga\nmap_Kd -s 3 second.tga\n");
    EXPECT_EQ(again.transform.scale, glm::vec2(3, 1));
    EXPECT_EQ(again.sampler.wrapU, Wrap::ClampToEdge);
    const Scene bump = painted("map_bump -bm 0.5 first.tga\nbump second.tga\n");
    EXPECT_EQ(texelsOf(imageOf(bump, TextureSlot::Normal)), (Texels{{40, 50, 60, 255}}));
    EXPECT_EQ(bump.materials[0].normalScale, 0.5f);
}

TEST_F(ObjMaterials, eachMaterialOfAShapeHasItsOwnMesh) {
    folder.write("a.mtl", "newmtl warm red\nKd 1 0 0\nnewmtl unused\nmap_Kd none.png\n");
    folder.write("b.mtl", "newmtl warm blue\nKd 0 0 1\nnewmtl warm red\nKd 0 1 0\n");
    const Scene scene = underLedger(
        importObj,
        folder.write("model.obj",
                     "mtllib a.mtl b.mtl\n" + std::string(kThreeVertices) +
                         "o box\nusemtl warm red\nf 1 2 3\nusemtl warm blue\nf 1 3 2\nusemtl warm red\nf 1 2 3\n"));
    ASSERT_EQ(scene.nodes.size(), 1u);
    ASSERT_EQ(scene.nodes[0].instances.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "box, warm red");
    EXPECT_EQ(scene.meshes[0].indices.size(), 6u);
    EXPECT_EQ(scene.meshes[1].name, "box, warm blue");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(scene.materials[1].baseColor, glm::vec4(0, 0, 1, 1));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(ObjMaterials, oneStatementNamesSeveralLibrariesInQuotes) {
    folder.write("my a.mtl", "newmtl red\nKd 1 0 0\n");
    const Scene scene =
        importText("mtllib \"my a.mtl\" gone.mtl\n" + std::string(kThreeVertices) + "usemtl red\nf 1 2 3\n");
    EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_THAT(onlyWarning(scene), HasSubstr("material library 'gone.mtl' is missing"));
}

TEST_F(ObjMaterials, withoutTextureCoordinatesPicturesAreProjected) {
    folder.writePicture("a.tga", 1, 1, {{255, 0, 0, 255}});
    folder.write("m.mtl", "newmtl red\nmap_Kd a.tga\n");
    const Scene scene = importText("mtllib m.mtl\n" + std::string(kThreeVertices) + "usemtl red\nf 1 2 3\n");
    EXPECT_EQ(scene.meshes.at(0).texCoords[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_THAT(onlyWarning(scene), HasSubstr("has no texture coordinates; its pictures are projected along the axes"));
}

TEST_F(ObjMaterials, aMissingLibraryWarnsAndKeepsTheMaterialsNames) {
    const std::filesystem::path file =
        folder.write("model.obj", "mtllib no such.mtl\n" + std::string(kThreeVertices) + "usemtl skin\nf 1 2 3\n");
    const Scene scene = underLedger(importObj, file);
    EXPECT_EQ(scene.materials.at(0).name, "skin");
    EXPECT_EQ(scene.materials.at(0).baseColor, glm::vec4(0.8f, 0.8f, 0.8f, 1.0f));
    EXPECT_THAT(
        scene.warnings,
        ElementsAre(file.string() + ": its material library 'no such.mtl' is missing; default materials are used",
                    file.string() + ": no material library defines 'skin'; a default material of that name is used"));
}

TEST_F(ObjMaterials, aMissingPictureIsACheckerboardOfColoursAndNothingElse) {
    const std::string text = (folder.path() / "paint.mtl").string() +
                             ": material 'paint', map_Kd: " + (folder.path() / "no picture.png").string() +
                             ": there is no such file; check the name and the folder";
    const Scene scene = painted("d 0.5\nmap_Kd no picture.png\nmap_d no picture.png\nnorm no picture.png\n"
                                "map_Pr no picture.png\nmap_Pm no picture.png\nmap_Ks no picture.png\n");
    EXPECT_THAT(scene.warnings,
                ElementsAre(text + "; its colours are a checkerboard, and what else it holds is left out"));
    ASSERT_EQ(scene.images.size(), 1u);
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::SpecularColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::Normal).image, kNone);
    EXPECT_EQ(material.texture(TextureSlot::MetallicRoughness).image, kNone);
    EXPECT_EQ(material.alphaMode, AlphaMode::Blend) << "as without the picture of opacity";

    EXPECT_EQ(strictError(), text);
}

TEST_F(ObjMaterials, aMissingPictureBesideOneThatIsThereLeavesThatOne) {
    folder.writePicture("grey.tga", 1, 1, {{100, 100, 100, 255}});
    for (const char* lines : {"map_Pr grey.tga\nmap_Pm none.png\n", "map_Pr none.png\nmap_Pm grey.tga\n"}) {
        const Scene scene = painted(lines);
        EXPECT_NE(scene.materials.at(0).texture(TextureSlot::MetallicRoughness).image, kNone) << lines;
        EXPECT_EQ(scene.warnings.size(), 1u) << lines;
    }
}

TEST_F(ObjMaterials, unsupportedStatementsWarn) {
    EXPECT_THAT(painted("Ka 1 1 1\nKd 1 1 1\ndisp a.png\nfoo 1\nKs spectral x.rfl\n").warnings,
                ElementsAre((folder.path() / "paint.mtl").string() +
                            ": statements that are not supported are left out: Ks spectral, disp, foo"));
}

} // namespace
} // namespace tessera::scenes
