// Textures of glTF files: samplers, transforms, and the sources of their images.

#include "tests/unit/scenes/gltf/GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

TextureUse importedUse(const char* info, const char* sampler = nullptr) {
    Builder builder;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"] = Json::parse(info);
    builder.addTexture();
    if (sampler != nullptr) {
        builder.json["samplers"] = Json::array({Json::parse(sampler)});
        builder.json["textures"][0]["sampler"] = 0;
    }
    return builder.import().materials.at(0).texture(TextureSlot::BaseColor);
}

/// The triangle with texture 0 as its base colour.
Builder textured() {
    return withMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
}

TEST(GltfTextures, samplerSettingsAreImportedExactly) {
    const TextureUse use =
        importedUse(R"({"index": 0})", R"({"magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648})");
    EXPECT_EQ(use.sampler,
              (Sampler{Filter::Nearest, Filter::LinearMipmapNearest, Wrap::ClampToEdge, Wrap::MirroredRepeat}));
    const Filter filters[] = {Filter::NearestMipmapNearest, Filter::LinearMipmapNearest, Filter::NearestMipmapLinear,
                              Filter::LinearMipmapLinear};
    for (int i = 0; i < 4; ++i) {
        const std::string sampler = "{\"minFilter\": " + std::to_string(9984 + i) + "}";
        EXPECT_EQ(importedUse(R"({"index": 0})", sampler.c_str()).sampler.minification, filters[i]);
    }
}

TEST(GltfTextures, samplerDefaultsAreRepeatAndTrilinear) {
    const Sampler trilinear{Filter::Linear, Filter::LinearMipmapLinear, Wrap::Repeat, Wrap::Repeat};
    EXPECT_EQ(importedUse(R"({"index": 0})").sampler, trilinear);
    EXPECT_EQ(importedUse(R"({"index": 0})", "{}").sampler, trilinear);
}

TEST(GltfTextures, transformIsImportedExactly) {
    const TextureUse use = importedUse(R"({"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.5, 0.25], "scale": [2, 3], "rotation": 0.125, "texCoord": 1}}})");
    EXPECT_EQ(use.transform, (TextureTransform{{0.5f, 0.25f}, {2, 3}, 0.125f}));
    EXPECT_EQ(use.texCoordSet, 1);
    EXPECT_EQ(importedUse(R"({"index": 0})").transform, TextureTransform{});
}

TEST(GltfTextures, transformInsideAnExtensionIsImportedExactly) {
    const Material material =
        importedMaterial(R"({"extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0,
        "texCoord": 1, "extensions": {"KHR_texture_transform": {"scale": [4, 5]}}}}}})");
    EXPECT_EQ(material.texture(TextureSlot::SpecularFactor).transform.scale, glm::vec2(4, 5));
    EXPECT_EQ(material.texture(TextureSlot::SpecularFactor).texCoordSet, 1);
}

TEST(GltfTextures, secondTexCoordSetIsImportedAndAThirdIsWarnedOf) {
    EXPECT_EQ(importedUse(R"({"index": 0, "texCoord": 1})").texCoordSet, 1);
    Builder builder;
    builder.material()["normalTexture"] = Json::parse(R"({"index": 0, "texCoord": 2})");
    builder.addTexture();
    const Scene scene = builder.import();
    EXPECT_EQ(scene.materials.at(0).texture(TextureSlot::Normal).image, kNone);
    EXPECT_TRUE(hasWarning(scene, "uses texture coordinate set 2; only 0 and 1 are supported"));
}

TEST(GltfTextures, imageIsReadTheSameFromDataUriFileAndBufferView) {
    Builder builder = textured();
    const Image embedded = builder.import().images.at(0);
    EXPECT_EQ(embedded.name, "image 0");
    EXPECT_EQ(embedded.width, 2);

    builder.folder.write("my pictures/r\xc3\xb6t.png", pngRedBlue());
    builder.json["images"][0] = Json::parse(R"({"uri": "my%20pictures/r%C3%B6t.png"})");
    const Image external = builder.import().images.at(0);
    EXPECT_EQ(external.texels, embedded.texels);
    builder.json["images"][0]["uri"] = "my pictures/r\xc3\xb6t.png";
    EXPECT_EQ(builder.import().images.at(0).texels, embedded.texels);

    const int view = builder.addView(pngRedBlue());
    builder.json["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "in a view"}};
    const Image inView = builder.import().images.at(0);
    EXPECT_EQ(inView.texels, embedded.texels);
    EXPECT_EQ(inView.name, "in a view");
}

TEST(GltfTextures, imageUsedTwiceIsDecodedOnce) {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}})"));
    builder.addTexture();
    builder.json["textures"].push_back(Json::parse(R"({"source": 0})"));
    EXPECT_EQ(builder.import().images.size(), 1u);
}

TEST(GltfTextures, missingOrBrokenImageIsACheckerboardOfColoursAndNothingElse) {
    Builder builder;
    builder.material().merge_patch(Json::parse(
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
            "normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}})"));
    builder.addTexture();
    builder.json["images"] = Json::parse(R"([{"uri": "gone.png"}, {"uri": "data:image/png;base64,QUJD"}])");
    builder.json["textures"].push_back(Json::parse(R"({"source": 1})"));
    const Scene scene = builder.import();
    ASSERT_EQ(scene.images.size(), 1u) << "one stands in for both";
    EXPECT_NE(scene.images[0].texels.front(), scene.images[0].texels[8 * 4]) << "its squares are 8 texels wide";
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::Emissive).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::Normal).image, kNone);
    EXPECT_EQ(material.texture(TextureSlot::MetallicRoughness).image, kNone);
    EXPECT_EQ(scene.warnings.size(), 2u) << "once each, however often they are used";
    EXPECT_TRUE(hasWarning(scene, "gone.png: there is no such file"));
    EXPECT_TRUE(hasWarning(scene, "model.gltf: /images/1: is in no known picture format"));
    EXPECT_TRUE(hasWarning(scene, "; its colours are a checkerboard, and what else it holds is left out"));

    builder.json["textures"][0] = Json::object();
    EXPECT_TRUE(hasWarning(builder.import(), "/textures/0: has no source in a supported format"));
    builder.json["extensionsUsed"] = {"KHR_texture_basisu"};
    EXPECT_TRUE(hasWarning(builder.import(), "/textures/0: has a source in KTX2 alone; 'ktx extract"));
}

TEST(GltfTextures, webpGoesBeforeTheOtherPictureAndThatStandsInForIt) {
    Builder builder = textured();
    std::filesystem::copy_file(std::filesystem::path(TESSERA_SOURCE_DIR) / "tests/fuzz/corpus/picture/small.webp",
                               builder.folder.write("a.webp", std::string()),
                               std::filesystem::copy_options::overwrite_existing);
    builder.json["images"].push_back(Json::parse(R"({"uri": "a.webp", "mimeType": "image/webp"})"));
    builder.json["textures"][0] = Json::parse(R"({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}})");
    const Scene both = builder.import();
    ASSERT_EQ(both.images.size(), 1u);
    EXPECT_EQ(both.images[0].name, "a.webp");
    EXPECT_TRUE(both.warnings.empty());

    builder.json["textures"][0].erase("source");
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_EQ(builder.import().images.at(0).name, "a.webp");

    builder.json["textures"][0]["source"] = 0;
    builder.json["images"][1]["uri"] = "gone.webp";
    const Scene other = builder.import();
    ASSERT_EQ(other.images.size(), 1u);
    EXPECT_EQ(other.images[0].width, 2) << "the PNG";
    EXPECT_EQ(other.warnings.size(), 1u);
    EXPECT_TRUE(hasWarning(other, "; the texture's other picture is used instead"));
}

TEST(GltfTextures, noStandInIsDrawnForWantOfMemory) {
    Builder builder = textured();
    // A TGA of one grey, whose runs of 128 texels take two bytes each.
    std::vector<std::uint8_t> tga{0, 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 8, 8, 0x20};
    for (int run = 0; run < 4096 * 2048 / 128; ++run) tga.insert(tga.end(), {0xff, 7});
    builder.folder.write("grey.tga", bytesOf(tga));
    builder.json["images"][0] = Json::parse(R"({"uri": "grey.tga"})");
    const std::filesystem::path file = builder.folder.write("model.gltf", builder.json.dump());
    EXPECT_EQ(underLedger(importGltf, file).images.at(0).width, 4096);
    EXPECT_THROW(underLedger(importGltf, file, 8 * kMiB), MemoryRefused);
}

TEST(GltfTextures, missingOrBrokenImageIsRefusedByNameWhereTheLoadIsStrict) {
    Builder builder = textured();
    builder.importOptions.isStrict = true;
    for (const auto& [image, error] :
         {std::pair(R"({"uri": "gone.png"})", "gone.png: there is no such file"),
          {R"({"uri": "gone.png"})", "model.gltf: /images/0: "},
          {R"({"uri": "https://example.org/a.png"})",
           "/images/0: its uri 'https://example.org/a.png' is not a relative path"},
          {R"({"uri": "data:image/png;base64,QUJD"})", "/images/0: is in no known picture format"},
          {R"({"uri": "data:image/png;base64,*"})", "/images/0: its base64 has an invalid character at position 0"},
          {"{}", "/images/0: has neither a uri nor a bufferView"}}) {
        builder.json["images"][0] = Json::parse(image);
        EXPECT_THAT(builder.error(), HasSubstr(error));
    }
    builder.json["textures"][0] = Json::object();
    EXPECT_THAT(builder.error(), HasSubstr("/textures/0: has no source in a supported format"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
